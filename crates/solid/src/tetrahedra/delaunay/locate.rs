//! Finding the tetrahedron that holds a point, by walking.

use crate::tetrahedra::mesh::{FACE, GHOST, Mesh};
use crate::tetrahedra::predicates::{P3, orient};

/// Where a walk ended.
pub(super) enum Place {
    /// In this tetrahedron, or on its surface; a ghost stands for outside of its face.
    In(u32),
    /// On this vertex exactly.
    On(u32),
}

impl Mesh {
    /// Walks from tetrahedron `from` to the one that holds `p`.
    ///
    /// Each step leaves through a face that has the point beyond it, tried in an order that a counter
    /// turns, never back. In a Delaunay triangulation such a walk ends (\[DPT02\]); should one not, which
    /// would be a bug of ours, all tetrahedra are looked through.
    pub(super) fn locate(&self, p: &P3, from: u32) -> Place {
        let mut t = from;
        if let Some(ghost) = self.tet(t).index_of(GHOST) {
            t = self.tet(t).n[ghost] >> 2;
        }
        let mut behind = u32::MAX;
        let mut turn = 0x9e37_79b9u32;
        'walk: for _ in 0..self.tets.len() + 100 {
            let tet = self.tet(t);
            turn ^= turn << 13;
            turn ^= turn >> 17;
            turn ^= turn << 5;
            for step in 0..4 {
                let f = ((turn >> 8) as usize + step) & 3;
                let next = tet.n[f] >> 2;
                if next == behind {
                    continue;
                }
                let [a, b, c] = FACE[f].map(|i| self.point(tet.v[i]));
                if orient(a, b, c, p) < 0.0 {
                    if self.tet(next).is_ghost() {
                        return Place::In(next);
                    }
                    behind = t;
                    t = next;
                    continue 'walk;
                }
            }
            return self.place_in(t, p);
        }
        self.look_everywhere(p)
    }

    fn place_in(&self, t: u32, p: &P3) -> Place {
        match self.tet(t).v.iter().find(|&&v| self.point(v) == p) {
            Some(&v) => Place::On(v),
            None => Place::In(t),
        }
    }

    #[cold]
    fn look_everywhere(&self, p: &P3) -> Place {
        let mut outside = 0;
        for t in (0..self.tets.len() as u32).filter(|&t| self.tet(t).is_live()) {
            let tet = self.tet(t);
            if let Some(g) = tet.index_of(GHOST) {
                let [a, b, c] = FACE[g].map(|i| self.point(tet.v[i]));
                if orient(a, b, c, p) > 0.0 {
                    outside = t;
                }
                continue;
            }
            let holds = (0..4).all(|f| {
                let [a, b, c] = FACE[f].map(|i| self.point(tet.v[i]));
                orient(a, b, c, p) >= 0.0
            });
            if holds {
                return self.place_in(t, p);
            }
        }
        Place::In(outside)
    }
}
