//! Which vertices are joined to which, and in what order around each.

use crate::image::{FilledImage, Pixel};
use crate::triangulate::ImageMesh;

/// The neighbours of every vertex of a triangulation of the image, in order of positive turns.
///
/// The ring of a vertex inside is closed; that of one on the border of the image runs from its next
/// neighbour along the border to the one before. Faces are not stored: two neighbours in a row make
/// one. Rings lie in one pool, in blocks of 8, 16, 32, ... places that are used again: 44 bytes per
/// vertex at the start, and hardly more later.
#[derive(Clone, Debug)]
pub(in crate::reduce) struct Rings {
    starts: Vec<u32>,
    lengths: Vec<u32>,
    pool: Vec<u32>,
    /// Blocks that are free, by the power of two of their size.
    free: Vec<Vec<u32>>,
    pub pixels: Vec<Pixel>,
    border: Vec<bool>,
    alive: usize,
}

/// Places of the smallest block.
const SMALLEST: u32 = 8;

fn class_of(length: u32) -> u32 {
    length.max(SMALLEST).next_power_of_two().trailing_zeros()
}

impl Rings {
    /// The grid of all pixels (\[Mos15\] 3.4). O(pixels).
    pub fn grid(image: &FilledImage) -> Self {
        let (columns, rows) = (image.columns() as i64, image.rows() as i64);
        let pixels = image.pixels();
        let mut rings = Self {
            starts: (0..pixels as u32).map(|vertex| vertex * SMALLEST).collect(),
            lengths: vec![0; pixels],
            pool: vec![0; pixels * SMALLEST as usize],
            free: vec![Vec::new(); 32],
            pixels: (0..pixels).map(|index| image.pixel(index)).collect(),
            border: vec![false; pixels],
            alive: pixels,
        };
        const AROUND: [[i64; 2]; 6] = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];
        for vertex in 0..pixels {
            let [column, row] = rings.pixels[vertex].map(i64::from);
            let there = AROUND.map(|[dc, dr]| {
                let (c, r) = (column + dc, row + dr);
                ((0..columns).contains(&c) && (0..rows).contains(&r))
                    .then(|| (r * columns + c) as u32)
            });
            rings.border[vertex] = there.contains(&None);
            // On the border the ring starts after the gap.
            let first = (0..6).find(|&i| there[(i + 5) % 6].is_none() && there[i].is_some());
            let ring = &mut rings.pool[vertex * SMALLEST as usize..];
            let neighbours = (0..6).filter_map(|i| there[(first.unwrap_or(0) + i) % 6]);
            for (place, neighbour) in ring.iter_mut().zip(neighbours) {
                *place = neighbour;
                rings.lengths[vertex] += 1;
            }
        }
        rings
    }

    /// The neighbours of a vertex.
    #[inline]
    pub fn of(&self, vertex: u32) -> &[u32] {
        let start = self.starts[vertex as usize] as usize;
        &self.pool[start..start + self.lengths[vertex as usize] as usize]
    }

    /// Whether the vertex lies on the border of the image.
    #[inline]
    pub fn is_on_border(&self, vertex: u32) -> bool {
        self.border[vertex as usize]
    }

    /// Whether the vertex is still there.
    #[inline]
    pub fn is_alive(&self, vertex: u32) -> bool {
        self.lengths[vertex as usize] > 0
    }

    /// Number of vertices that are still there.
    pub fn alive(&self) -> usize {
        self.alive
    }

    /// Forgets a vertex; its neighbours must forget it through [`replace`](Self::replace).
    pub fn remove(&mut self, vertex: u32) {
        let class = class_of(self.lengths[vertex as usize]);
        self.free[class as usize].push(self.starts[vertex as usize]);
        self.lengths[vertex as usize] = 0;
        self.alive -= 1;
    }

    /// Puts `by` in the place of `gone` in the ring of `vertex`.
    pub fn replace(&mut self, vertex: u32, gone: u32, by: &[u32]) {
        let start = self.starts[vertex as usize] as usize;
        let length = self.lengths[vertex as usize] as usize;
        let Some(at) = self.of(vertex).iter().position(|&other| other == gone) else { return };
        let now = length + by.len() - 1;
        let (class, needed) = (class_of(length as u32), class_of(now as u32));
        self.lengths[vertex as usize] = now as u32;
        if needed == class {
            self.pool.copy_within(start + at + 1..start + length, start + at + by.len());
            self.pool[start + at..start + at + by.len()].copy_from_slice(by);
            return;
        }
        let block = self.free[needed as usize].pop().unwrap_or_else(|| {
            let block = self.pool.len();
            self.pool.resize(block + (1 << needed), 0);
            block as u32
        });
        let to = block as usize;
        self.pool.copy_within(start..start + at, to);
        self.pool.copy_within(start + at + 1..start + length, to + at + by.len());
        self.pool[to + at..to + at + by.len()].copy_from_slice(by);
        self.free[class as usize].push(start as u32);
        self.starts[vertex as usize] = block;
    }

    /// The mesh as it is now, with the image's own depths. O(vertices of the grid).
    pub fn mesh(&self, image: &FilledImage) -> ImageMesh {
        let mut mesh = ImageMesh::default();
        let mut numbers = vec![0; self.lengths.len()];
        for vertex in (0..self.lengths.len() as u32).filter(|&v| self.is_alive(v)) {
            numbers[vertex as usize] = mesh.pixels.len() as u32;
            let pixel = self.pixels[vertex as usize];
            mesh.pixels.push(pixel);
            mesh.depths_m.push(f64::from(image.depth_m(pixel)));
        }
        for vertex in (0..self.lengths.len() as u32).filter(|&v| self.is_alive(v)) {
            let ring = self.of(vertex);
            let closed = usize::from(!self.is_on_border(vertex));
            for i in 0..ring.len() - 1 + closed {
                let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                // Each face once, by its smallest vertex.
                if vertex < a && vertex < b {
                    mesh.triangles.push([vertex, a, b].map(|v| numbers[v as usize]));
                }
            }
        }
        mesh
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
        }
    }
}
