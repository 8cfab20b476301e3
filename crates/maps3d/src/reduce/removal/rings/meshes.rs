//! Rings of a mesh, and the mesh of what is left.

use super::store::{Rings, Vertex};
use crate::image::FilledImage;
use crate::triangulate::ImageMesh;

/// Columns and rows of a tile of vertices with numbers in a row.
const TILE: usize = 8;

/// The number of a pixel's vertex: tiles row by row, and each row by row.
fn number_of(columns: usize, rows: usize, column: usize, row: usize) -> usize {
    let (left, top) = (column / TILE * TILE, row / TILE * TILE);
    let (width, height) = (TILE.min(columns - left), TILE.min(rows - top));
    top * columns + left * height + (row - top) * width + column - left
}

impl Rings {
    /// The number of the vertex at a place of the image's list of pixels.
    pub fn number_at(&self, index: usize) -> u32 {
        let (column, row) = (index % self.columns, index / self.columns);
        number_of(self.columns, self.rows, column, row) as u32
    }

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
    use crate::image::PrepareOptions;
    use crate::image::prepare;
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
}
