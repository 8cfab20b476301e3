//! A removed vertex: its hole, and the edges that close it.

use super::Rings;
use crate::image::Pixel;
use crate::reduce::hole::{self, HoleMethod, Scratch};

/// Takes a vertex out and closes the hole; the room is used again.
#[derive(Default)]
pub(in crate::reduce) struct Mend {
    /// The vertices around the hole.
    pub ring: Vec<u32>,
    /// Their pixels.
    pub polygon: Vec<Pixel>,
    scratch: Scratch,
    /// New edges by their first end, as places in the hole.
    edges: Vec<(u16, u16)>,
    by: Vec<u32>,
}

impl Mend {
    /// Triangles of the last hole.
    pub fn pieces(&self) -> &[[u16; 3]] {
        &self.scratch.pieces
    }

    /// Removes a vertex and triangulates its hole.
    pub fn take_out(&mut self, rings: &mut Rings, vertex: u32, method: HoleMethod) {
        self.open(rings, vertex);
        hole::triangulate(method, &self.polygon, &mut self.scratch);
        self.link(rings, vertex);
    }

    /// Removes a vertex and joins all others around the hole to the one at `place`.
    pub fn collapse(&mut self, rings: &mut Rings, vertex: u32, place: usize) {
        self.open(rings, vertex);
        let n = self.ring.len();
        self.scratch.pieces.clear();
        self.scratch.pieces.extend((1..n - 1).map(|step| {
            [place as u16, ((place + step) % n) as u16, ((place + step + 1) % n) as u16]
        }));
        self.link(rings, vertex);
    }

    fn open(&mut self, rings: &Rings, vertex: u32) {
        self.ring.clear();
        self.ring.extend_from_slice(rings.of(vertex));
        self.polygon.clear();
        self.polygon.extend(self.ring.iter().map(|&v| rings.pixel(v)));
    }

    /// Puts the new edges into the rings of the vertices around the hole.
    fn link(&mut self, rings: &mut Rings, gone: u32) {
        let n = self.ring.len() as u16;
        self.edges.clear();
        for piece in &self.scratch.pieces {
            for side in 0..3 {
                let (i, j) = (piece[side], piece[(side + 1) % 3]);
                // The sides of the hole are there already.
                if j != i + 1 && (i != n - 1 || j != 0) {
                    self.edges.push((i, j));
                }
            }
        }
        if rings.is_on_border(gone) {
            // The neighbours along the border become neighbours of each other.
            self.edges.extend([(0, n - 1), (n - 1, 0)]);
        }
        rings.remove(gone);
        for place in 0..n {
            self.by.clear();
            self.by.extend(
                self.edges.iter().filter(|&&(i, _)| i == place).map(|&(_, j)| u32::from(j)),
            );
            // In order of positive turns from the next corner of the hole.
            let (n, from) = (u32::from(n), u32::from(place));
            self.by.sort_unstable_by_key(|&j| (j + n - from) % n);
            for j in &mut self.by {
                *j = self.ring[*j as usize];
            }
            rings.replace(self.ring[usize::from(place)], gone, &self.by);
        }
    }
}
