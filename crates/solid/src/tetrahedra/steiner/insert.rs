//! Putting a point into a mesh that is not Delaunay.

use crate::tetrahedra::flips::{FLAT, Work, evenness};
use crate::tetrahedra::mesh::FACE;
use crate::tetrahedra::predicates::{P3, orient};

/// A hole larger than this is not made.
const MOST_TETS: usize = 400;

impl Work {
    /// Inserts a new vertex at `p`, which lies in or near one of the tetrahedra `start`: the hole grows
    /// from them until all its faces see the point strictly from inside, and well if that can be.
    /// `None`, with nothing changed, where that would tear out what must stay, or where the point is a
    /// vertex.
    pub(crate) fn insert_steiner(&mut self, p: P3, start: &[u32]) -> Option<u32> {
        let first = start.iter().copied().find(|&t| {
            let tet = self.mesh.tet(t);
            !tet.is_ghost()
                && (0..4).all(|f| {
                    let [a, b, c] = FACE[f].map(|i| self.mesh.point(tet.v[i]));
                    orient(a, b, c, &p) >= 0.0
                })
        })?;
        let vertex = self.mesh.add_point(p);
        if [true, false].into_iter().any(|well| self.star_in(vertex, &[first], well, None)) {
            return Some(vertex);
        }
        self.drop_points(vertex as usize);
        None
    }

    /// Makes a hole of the tetrahedra `start` and what has to go with them, and fills it from `vertex`, which
    /// lies in one of them or is a corner of one; `well` where faces that would make nearly flat tetrahedra
    /// are to go too. No vertex but `lost` goes. False, with nothing changed, where that cannot be.
    pub(super) fn star_in(
        &mut self,
        vertex: u32,
        start: &[u32],
        well: bool,
        lost: Option<u32>,
    ) -> bool {
        let mut hole = start.to_vec();
        let mut next = 0;
        while next < hole.len() {
            let t = hole[next];
            next += 1;
            let tet = *self.mesh.tet(t);
            for f in 0..4 {
                let other = tet.n[f] >> 2;
                if hole.contains(&other) {
                    continue;
                }
                let [x, y, z] = tet.face(f);
                if [x, y, z].contains(&vertex) {
                    continue;
                }
                let volume = self.mesh.orient(x, y, z, vertex);
                if volume > 0.0 && !(well && evenness(&self.mesh, volume, [x, y, z, vertex]) < FLAT)
                {
                    continue;
                }
                if self.must.holds_face(x, y, z)
                    || self.mesh.tet(other).is_ghost()
                    || hole.len() >= MOST_TETS
                {
                    if volume > 0.0 {
                        continue;
                    }
                    return false;
                }
                hole.push(other);
            }
        }
        let mut new = Vec::new();
        for &t in &hole {
            let tet = *self.mesh.tet(t);
            for f in 0..4 {
                let [x, y, z] = tet.face(f);
                if !hole.contains(&(tet.n[f] >> 2)) {
                    if ![x, y, z].contains(&vertex) {
                        new.push([x, y, z, vertex]);
                    }
                } else if self.must.holds_face(x, y, z) {
                    // The hole went round its edge.
                    return false;
                }
            }
        }
        !self.tears(&hole, &new, lost)
            && new.iter().all(|&[x, y, z, _]| self.mesh.orient(x, y, z, vertex) > 0.0)
            && self.exchange(&hole, &new)
    }

    /// Whether exchanging `old` for `new` would lose an edge that must stay, or a vertex other than
    /// `lost`.
    pub(super) fn tears(&self, old: &[u32], new: &[[u32; 4]], lost: Option<u32>) -> bool {
        let mut seen: Vec<u32> = lost.into_iter().collect();
        old.iter().any(|&t| {
            let v = self.mesh.tet(t).v;
            (0..4).any(|i| {
                let fresh = !seen.contains(&v[i]);
                if fresh {
                    seen.push(v[i]);
                }
                (fresh && !new.iter().any(|tet| tet.contains(&v[i])))
                    || (i + 1..4).any(|j| {
                        self.must.holds_edge(v[i], v[j])
                            && !new.iter().any(|tet| tet.contains(&v[i]) && tet.contains(&v[j]))
                    })
            })
        })
    }
}
