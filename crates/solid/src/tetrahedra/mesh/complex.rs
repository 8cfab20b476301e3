//! The tetrahedra, compactly.

use super::replace::Exchange;
use super::tet::{NONE, Tet};
use crate::tetrahedra::predicates::{P3, orient};

/// Tetrahedra over points, each knowing its neighbours.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    /// The points.
    pub(crate) points: Vec<P3>,
    /// The tetrahedra; some slots may be free.
    pub(crate) tets: Vec<Tet>,
    /// A tetrahedron at each vertex, or [`NONE`].
    pub(crate) at: Vec<u32>,
    /// The free slots, last in, first out.
    pub(crate) free: Vec<u32>,
    /// A mark per slot; a slot is marked when it holds the current [`epoch`](Self::next_epoch).
    pub(crate) stamp: Vec<u32>,
    /// Scratch of searches.
    pub(crate) queue: Vec<u32>,
    /// Scratch of exchanges.
    pub(super) halves: Vec<u128>,
    /// Buffers of exchanges that are done with.
    pub(super) spare: Vec<Exchange>,
    /// The newest epoch.
    pub(crate) epoch: u32,
}

impl Mesh {
    /// No tetrahedra over these points.
    pub(crate) fn over(points: Vec<P3>) -> Self {
        let at = vec![NONE; points.len()];
        Self { points, at, ..Self::default() }
    }

    /// A point by its vertex.
    #[inline]
    pub(crate) fn point(&self, vertex: u32) -> &P3 {
        &self.points[vertex as usize]
    }

    /// A tetrahedron by its slot.
    #[inline]
    pub(crate) fn tet(&self, tet: u32) -> &Tet {
        &self.tets[tet as usize]
    }

    /// The orientation of four vertices, none of them the ghost.
    #[inline]
    pub(crate) fn orient(&self, a: u32, b: u32, c: u32, d: u32) -> f64 {
        orient(self.point(a), self.point(b), self.point(c), self.point(d))
    }

    /// A slot to write to.
    #[inline]
    pub(crate) fn take_slot(&mut self) -> u32 {
        if let Some(slot) = self.free.pop() {
            return slot;
        }
        self.tets.push(Tet::FREE);
        self.stamp.push(0);
        (self.tets.len() - 1) as u32
    }

    /// A number that no slot is marked with, nor with its successor.
    #[inline]
    pub(crate) fn next_epoch(&mut self) -> u32 {
        if self.epoch > u32::MAX - 4 {
            self.stamp.fill(0);
            self.epoch = 0;
        }
        self.epoch += 2;
        self.epoch
    }

    /// Makes two faces, given as four times the tetrahedron plus the face, neighbours.
    #[inline]
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        self.tets[(a >> 2) as usize].n[(a & 3) as usize] = b;
        self.tets[(b >> 2) as usize].n[(b & 3) as usize] = a;
    }

    /// A new vertex without tetrahedra.
    pub(crate) fn add_point(&mut self, point: P3) -> u32 {
        self.points.push(point);
        self.at.push(NONE);
        (self.points.len() - 1) as u32
    }

    /// All slots that hold a tetrahedron without the ghost, ascending.
    pub(crate) fn finite(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.tets.len() as u32).filter(|&t| {
            let tet = self.tet(t);
            tet.is_live() && !tet.is_ghost()
        })
    }

    /// The first thing that is wrong with the structure, in words.
    ///
    /// Neighbours are mutual and share their face, finite tetrahedra are positive, every vertex that
    /// has a tetrahedron is a corner of it. O(n).
    #[cfg(test)]
    pub(crate) fn flaw(&self) -> Option<String> {
        for (t, tet) in self.tets.iter().enumerate().filter(|(_, tet)| tet.is_live()) {
            for f in 0..4 {
                let code = tet.n[f];
                let Some(other) = self.tets.get((code >> 2) as usize).filter(|o| o.is_live())
                else {
                    return Some(format!("tetrahedron {t} has no neighbour across face {f}"));
                };
                if other.n[(code & 3) as usize] != 4 * t as u32 + f as u32 {
                    return Some(format!("tetrahedra {t} and {} are not mutual", code >> 2));
                }
                let mut ours = tet.face(f);
                let mut theirs = other.face((code & 3) as usize);
                ours.sort_unstable();
                theirs.sort_unstable();
                if ours != theirs {
                    return Some(format!("tetrahedra {t} and {} do not share a face", code >> 2));
                }
            }
            let [a, b, c, d] = tet.v;
            if !tet.is_ghost() && self.orient(a, b, c, d) <= 0.0 {
                return Some(format!("tetrahedron {t} {:?} is not positive", tet.v));
            }
        }
        for (v, &t) in self.at.iter().enumerate() {
            if t != NONE && !self.tet(t).v.contains(&(v as u32)) {
                return Some(format!("vertex {v} is no corner of its tetrahedron {t}"));
            }
        }
        None
    }
}
