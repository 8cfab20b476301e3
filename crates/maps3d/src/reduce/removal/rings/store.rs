//! The rings themselves, and how they change.

use crate::image::Pixel;

/// The neighbours of every vertex of a triangulation of the image, in order of positive turns.
///
/// The ring of a vertex inside is closed; that of one on the border of the image runs from its next
/// neighbour along the border to the one before. Faces are not stored: two neighbours in a row make
/// one. What a removal looks at is waited for, not computed: so all that is known of a vertex fills
/// one line of the cache, and vertices are numbered tile by tile, a page of memory each. Rings longer
/// than [`INLINE`] lie in a pool, in blocks of 16, 32, ... places that are used again.
#[derive(Clone, Debug)]
pub(in crate::reduce) struct Rings {
    pub(super) vertices: Vec<Vertex>,
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) pool: Vec<u32>,
    /// Blocks that are free, by the power of two of their size.
    pub(super) free: Vec<Vec<u32>>,
    pub(super) alive: usize,
}

/// The longest ring that lies with its vertex.
const INLINE: usize = 10;

#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Vertex {
    /// The ring; a longer one than fits starts in the pool where the first number says.
    pub(super) ring: [u32; INLINE],
    pub(super) point_in_camera: [f32; 3],
    pub(super) pixel: Pixel,
    pub(super) length: u32,
    pub(super) border: bool,
}

impl Vertex {
    /// A vertex of which nothing is known yet.
    pub(super) const BLANK: Self = Self {
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

impl Rings {
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
    pub(super) fn put(&mut self, vertex: u32, ring: &[u32]) {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{PrepareOptions, prepare};
    use sensing::{Camera, DepthImage};

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
