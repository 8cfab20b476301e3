//! Which vertices are joined to which, and in what order around each.

use crate::image::{FilledImage, Pixel};
use crate::triangulate::ImageMesh;

/// The neighbours of every vertex of a triangulation of the image, in order of positive turns.
///
/// The ring of a vertex inside is closed; that of one on the border of the image runs from its next
/// neighbour along the border to the one before. Faces are not stored: two neighbours in a row make
/// one. What a removal looks at is waited for, not computed: so all that is known of a vertex fills
/// one line of the cache, and vertices are numbered tile by tile, a page of memory each. Rings longer
/// than [`INLINE`] lie in a pool, in blocks of 16, 32, ... places that are used again.
#[derive(Clone, Debug)]
pub(in crate::reduce) struct Rings {
    vertices: Vec<Vertex>,
    columns: usize,
    rows: usize,
    pool: Vec<u32>,
    /// Blocks that are free, by the power of two of their size.
    free: Vec<Vec<u32>>,
    alive: usize,
}

/// The longest ring that lies with its vertex.
const INLINE: usize = 10;

/// Columns and rows of a tile of vertices with numbers in a row.
const TILE: usize = 8;

#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Vertex {
    /// The ring; a longer one than fits starts in the pool where the first number says.
    ring: [u32; INLINE],
    point_in_camera: [f32; 3],
    pixel: Pixel,
    length: u32,
    border: bool,
}

impl Vertex {
    /// A vertex of which nothing is known yet.
    const BLANK: Self = Self {
        ring: [0; INLINE],
        point_in_camera: [0.0; 3],
        pixel: [0; 2],
        length: 0,
        border: false,
    };
}

fn class_of(length: usize) -> usize {
    length.next_power_of_two().trailing_zeros() as usize
}

/// The number of a pixel's vertex: tiles row by row, and each row by row.
fn number_of(columns: usize, rows: usize, column: usize, row: usize) -> usize {
    let (left, top) = (column / TILE * TILE, row / TILE * TILE);
    let (width, height) = (TILE.min(columns - left), TILE.min(rows - top));
    top * columns + left * height + (row - top) * width + column - left
}

impl Rings {
    /// The grid of all pixels (\[Mos15\] 3.4). O(pixels).
    pub fn grid(image: &FilledImage) -> Self {
        let (columns, rows) = (image.columns(), image.rows());
        let mut vertices = vec![Vertex::BLANK; image.pixels()];
        const AROUND: [[isize; 2]; 6] = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];
        for row in 0..rows {
            for column in 0..columns {
                let there = AROUND.map(|[dc, dr]| {
                    let c = column.checked_add_signed(dc).filter(|&c| c < columns)?;
                    let r = row.checked_add_signed(dr).filter(|&r| r < rows)?;
                    Some(number_of(columns, rows, c, r) as u32)
                });
                let vertex = &mut vertices[number_of(columns, rows, column, row)];
                vertex.pixel = [column as u16, row as u16];
                let point = image.point_in_camera(vertex.pixel);
                #[expect(clippy::cast_possible_truncation, reason = "fewer digits are measured")]
                let short = [point.x as f32, point.y as f32, point.z as f32];
                vertex.point_in_camera = short;
                vertex.border = there.contains(&None);
                // On the border the ring starts after the gap.
                let first = (0..6).find(|&i| there[(i + 5) % 6].is_none() && there[i].is_some());
                let neighbours = (0..6).filter_map(|i| there[(first.unwrap_or(0) + i) % 6]);
                for (place, neighbour) in vertex.ring.iter_mut().zip(neighbours) {
                    *place = neighbour;
                    vertex.length += 1;
                }
            }
        }
        let alive = vertices.len();
        Self { vertices, columns, rows, pool: Vec::new(), free: vec![Vec::new(); 32], alive }
    }

    /// The rings of any planar triangulation of the image; vertices keep their numbers. O(faces).
    pub fn of_mesh(image: &FilledImage, mesh: &ImageMesh) -> Self {
        let mut rings = Self {
            vertices: vec![Vertex::BLANK; mesh.pixels.len()],
            columns: image.columns(),
            rows: image.rows(),
            pool: Vec::new(),
            free: vec![Vec::new(); 32],
            alive: mesh.pixels.len(),
        };
        // Around each vertex, which neighbour comes after which.
        let mut after: Vec<Vec<(u32, u32)>> = vec![Vec::new(); mesh.pixels.len()];
        for &[a, b, c] in &mesh.triangles {
            for (vertex, from, to) in [(a, b, c), (b, c, a), (c, a, b)] {
                after[vertex as usize].push((from, to));
            }
        }
        for (vertex, pairs) in after.iter().enumerate() {
            let begins = |&(from, _): &(u32, u32)| pairs.iter().all(|&(_, to)| to != from);
            let gap = pairs.iter().copied().find(begins);
            let Some(&(mut at, _)) = gap.as_ref().or(pairs.first()) else { continue };
            let mut ring = Vec::with_capacity(pairs.len() + 1);
            while ring.len() <= pairs.len() {
                ring.push(at);
                let Some(&(_, next)) = pairs.iter().find(|(from, _)| *from == at) else { break };
                at = next;
            }
            ring.truncate(pairs.len() + usize::from(gap.is_some()));
            rings.vertices[vertex].pixel = mesh.pixels[vertex];
            rings.vertices[vertex].border = gap.is_some();
            rings.put(vertex as u32, &ring);
        }
        rings
    }

    /// The part of a mesh that is left of [`of_mesh`](Self::of_mesh), in the order of its vertices.
    pub fn rest_of(&self, mesh: &ImageMesh) -> ImageMesh {
        let alive: Vec<u32> =
            (0..self.vertices.len() as u32).filter(|&v| !self.of(v).is_empty()).collect();
        let mut rest = ImageMesh::default();
        let mut numbers = vec![0_u32; self.vertices.len()];
        for (number, &vertex) in alive.iter().enumerate() {
            numbers[vertex as usize] = number as u32;
            rest.pixels.push(mesh.pixels[vertex as usize]);
            rest.depths_m.push(mesh.depths_m[vertex as usize]);
        }
        self.faces(&alive, &numbers, &mut rest.triangles);
        rest
    }

    /// The neighbours of a vertex.
    #[inline]
    pub fn of(&self, vertex: u32) -> &[u32] {
        self.of_length(vertex, self.vertices[vertex as usize].length as usize)
    }

    #[inline]
    fn of_length(&self, vertex: u32, length: usize) -> &[u32] {
        let vertex = &self.vertices[vertex as usize];
        if length <= INLINE {
            &vertex.ring[..length]
        } else {
            &self.pool[vertex.ring[0] as usize..][..length]
        }
    }

    /// The number of the vertex at a place of the image's list of pixels.
    pub fn number_at(&self, index: usize) -> u32 {
        let (column, row) = (index % self.columns, index / self.columns);
        number_of(self.columns, self.rows, column, row) as u32
    }

    /// The pixel of a vertex.
    #[inline]
    pub fn pixel(&self, vertex: u32) -> Pixel {
        self.vertices[vertex as usize].pixel
    }

    /// The point of a vertex, in the frame `camera`, metres.
    #[inline]
    pub fn point_in_camera(&self, vertex: u32) -> [f32; 3] {
        self.vertices[vertex as usize].point_in_camera
    }

    /// Whether the vertex lies on the border of the image.
    #[inline]
    pub fn is_on_border(&self, vertex: u32) -> bool {
        self.vertices[vertex as usize].border
    }

    /// Whether the vertex is one of the four corners of the image.
    pub fn is_corner(&self, vertex: u32) -> bool {
        let [column, row] = self.pixel(vertex).map(usize::from);
        (column == 0 || column + 1 == self.columns) && (row == 0 || row + 1 == self.rows)
    }

    /// Number of vertices that are still there.
    pub fn alive(&self) -> usize {
        self.alive
    }

    /// Forgets a vertex; its neighbours must forget it through [`replace`](Self::replace).
    pub fn remove(&mut self, vertex: u32) {
        let vertex = &mut self.vertices[vertex as usize];
        let length = vertex.length as usize;
        if length > INLINE {
            self.free[class_of(length)].push(vertex.ring[0]);
        }
        vertex.length = 0;
        self.alive -= 1;
    }

    /// Puts `by` in the place of `gone` in the ring of `vertex`.
    pub fn replace(&mut self, vertex: u32, gone: u32, by: &[u32]) {
        let Some(at) = self.of(vertex).iter().position(|&other| other == gone) else { return };
        let held = &mut self.vertices[vertex as usize];
        let length = held.length as usize;
        let now = length + by.len() - 1;
        let (from, to) = (at + 1, at + by.len());
        if length <= INLINE && now <= INLINE {
            held.length = now as u32;
            held.ring.copy_within(from..length, to);
            held.ring[at..to].copy_from_slice(by);
            return;
        }
        let start = held.ring[0] as usize;
        if length > INLINE && now > INLINE && class_of(length) == class_of(now) {
            held.length = now as u32;
            self.pool.copy_within(start + from..start + length, start + to);
            self.pool[start + at..start + to].copy_from_slice(by);
            return;
        }
        // The ring moves between its vertex and blocks of other sizes.
        let mut ring = self.of_length(vertex, length).to_vec();
        if length > INLINE {
            self.free[class_of(length)].push(start as u32);
        }
        ring.splice(at..=at, by.iter().copied());
        self.put(vertex, &ring);
    }

    /// Gives a vertex a ring; a block that it had is not given back.
    fn put(&mut self, vertex: u32, ring: &[u32]) {
        let held = &mut self.vertices[vertex as usize];
        held.length = ring.len() as u32;
        if ring.len() <= INLINE {
            held.ring[..ring.len()].copy_from_slice(ring);
            return;
        }
        let class = class_of(ring.len());
        let block = self.free[class].pop().unwrap_or_else(|| {
            let block = self.pool.len();
            self.pool.resize(block + (1 << class), 0);
            block as u32
        });
        held.ring[0] = block;
        self.pool[block as usize..][..ring.len()].copy_from_slice(ring);
    }

    /// The mesh as it is now, with the image's own depths; vertices row by row. O(vertices of the
    /// grid).
    pub fn mesh(&self, image: &FilledImage) -> ImageMesh {
        let mut mesh = ImageMesh::default();
        let mut numbers = vec![0_u32; self.vertices.len()];
        let in_rows = (0..self.vertices.len()).map(|index| self.number_at(index));
        let alive: Vec<u32> = in_rows.filter(|&vertex| !self.of(vertex).is_empty()).collect();
        for &vertex in &alive {
            numbers[vertex as usize] = mesh.pixels.len() as u32;
            let pixel = self.pixel(vertex);
            mesh.pixels.push(pixel);
            mesh.depths_m.push(f64::from(image.depth_m(pixel)));
        }
        self.faces(&alive, &numbers, &mut mesh.triangles);
        mesh
    }

    /// The faces of some vertices, by the numbers that these have got.
    fn faces(&self, vertices: &[u32], numbers: &[u32], faces: &mut Vec<[u32; 3]>) {
        for &vertex in vertices {
            let ring = self.of(vertex);
            let closed = usize::from(!self.is_on_border(vertex));
            let least = numbers[vertex as usize];
            for i in 0..ring.len() - 1 + closed {
                let [a, b] = [ring[i], ring[(i + 1) % ring.len()]].map(|v| numbers[v as usize]);
                // Each face once, by its smallest vertex.
                if least < a && least < b {
                    faces.push([least, a, b]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use crate::triangulate::{check_planar, grid};
    use sensing::{Camera, DepthImage};

    #[test]
    fn the_rings_are_those_of_the_grid() {
        for (columns, rows) in [(2, 2), (3, 2), (2, 4), (6, 5)] {
            let image = DepthImage::new(
                columns,
                Camera::new(9.0, 9.0, 1.0, 1.0),
                vec![1.0; columns * rows],
            );
            let image = prepare(&image, &PrepareOptions::default()).expect("valid");
            let mesh = Rings::grid(&image).mesh(&image);
            assert_eq!(check_planar(&mesh, columns, rows), Ok(()));
            let sorted = |triangles: &[[u32; 3]]| {
                let mut faces: Vec<[u32; 3]> = triangles
                    .iter()
                    .map(|&[a, b, c]| match a.min(b).min(c) {
                        least if least == a => [a, b, c],
                        least if least == b => [b, c, a],
                        _ => [c, a, b],
                    })
                    .collect();
                faces.sort_unstable();
                faces
            };
            assert_eq!(sorted(&mesh.triangles), sorted(&grid(&image).triangles));
            let again = Rings::of_mesh(&image, &mesh).rest_of(&mesh);
            assert_eq!(again.pixels, mesh.pixels);
            assert_eq!(sorted(&again.triangles), sorted(&mesh.triangles));
        }
    }

    #[test]
    fn tiles_number_every_pixel_once() {
        for (columns, rows) in [(2, 2), (8, 8), (17, 9), (5, 30)] {
            let mut seen = vec![false; columns * rows];
            for row in 0..rows {
                for column in 0..columns {
                    let number = number_of(columns, rows, column, row);
                    assert!(!std::mem::replace(&mut seen[number], true));
                }
            }
        }
    }

    #[test]
    fn a_ring_grows_and_shrinks_whole() {
        let image = DepthImage::new(9, Camera::new(9.0, 9.0, 1.0, 1.0), vec![1.0; 81]);
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let mut rings = Rings::grid(&image);
        let (vertex, other) = (40, 41);
        let mut expected = rings.of(vertex).to_vec();
        let beside = rings.of(other).to_vec();
        let mut next = 1000;
        // Up past two sizes of blocks, and down again.
        for _ in 0..40 {
            let at = next as usize % expected.len();
            let by = [next, next + 1];
            rings.replace(vertex, expected[at], &by);
            expected.splice(at..=at, by);
            next += 2;
            assert_eq!(rings.of(vertex), expected);
        }
        while expected.len() > 3 {
            let at = expected.len() / 2;
            rings.replace(vertex, expected[at], &[]);
            expected.remove(at);
            assert_eq!(rings.of(vertex), expected);
        }
        assert_eq!(rings.of(other), beside);
        assert_eq!(size_of::<Vertex>(), 64);
    }
}
