//! Making missing facets faces, by flips.

use super::segments::Attempt;
use crate::tetrahedra::constraints::{Meets, meets};
use crate::tetrahedra::flips::{Effort, Goal, Work};
use crate::tetrahedra::mesh::Ring;

/// More flips than this for one facet are not made at one go.
const MOST_STEPS: usize = 100_000;

impl Work {
    /// Flips until the facet `corners`, whose edges are all in the mesh, is a face; each step takes
    /// away at least one of the edges that pass it.
    pub(crate) fn recover_facet(&mut self, corners: [u32; 3], effort: Effort) -> Attempt {
        let goal = Goal::Facet(corners);
        for _ in 0..MOST_STEPS {
            let mut nearer = false;
            for i in 0..3 {
                let [a, b, c] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
                match self.passing_at(a, b, c) {
                    Beside::Present => return Attempt::Done,
                    Beside::Unknown => {}
                    Beside::Passed(t, u, v) => {
                        nearer = self.remove_edge(t, [u, v], goal, 1, effort).is_some();
                    }
                }
                if nearer {
                    break;
                }
            }
            if !nearer {
                let passing = self.passing(corners);
                nearer = passing
                    .into_iter()
                    .any(|(t, u, v)| self.remove_edge(t, [u, v], goal, 1, effort).is_some());
            }
            if !nearer {
                return Attempt::Stuck;
            }
        }
        Attempt::Stuck
    }

    /// What the facet meets beside its edge `a`, `b`.
    fn passing_at(&mut self, a: u32, b: u32, c: u32) -> Beside {
        let Some(start) = self.mesh.find_edge(a, b) else { return Beside::Unknown };
        let mut ring = Ring::default();
        if !self.mesh.ring(start, a, b, usize::MAX, &mut ring) {
            return Beside::Unknown;
        }
        if ring.vertices.contains(&c) {
            return Beside::Present;
        }
        let n = ring.vertices.len();
        for i in 0..n {
            let (p, q) = (ring.vertices[i], ring.vertices[(i + 1) % n]);
            if meets(&self.mesh, [p, q], [a, b, c]) != Meets::Not {
                return Beside::Passed(ring.tets[i], p, q);
            }
        }
        Beside::Unknown
    }

    /// All edges that pass the facet, each with a tetrahedron, spreading from those beside its edges.
    pub(crate) fn passing(&mut self, corners: [u32; 3]) -> Vec<(u32, u32, u32)> {
        let mut found: Vec<(u32, u32, u32)> = Vec::new();
        let mut ring = Ring::default();
        for i in 0..3 {
            let [a, b] = [corners[i], corners[(i + 1) % 3]];
            let Some(start) = self.mesh.find_edge(a, b) else { continue };
            if !self.mesh.ring(start, a, b, usize::MAX, &mut ring) {
                continue;
            }
            let n = ring.vertices.len();
            for i in 0..n {
                let (p, q) = (ring.vertices[i], ring.vertices[(i + 1) % n]);
                self.note_passing(ring.tets[i], p, q, corners, &mut found);
            }
        }
        let mut next = 0;
        while next < found.len() {
            let (t, u, v) = found[next];
            next += 1;
            if !self.mesh.ring(t, u, v, usize::MAX, &mut ring) {
                continue;
            }
            let n = ring.vertices.len();
            for i in 0..n {
                let (p, q) = (ring.vertices[i], ring.vertices[(i + 1) % n]);
                for (x, y) in [(p, q), (u, p), (v, p)] {
                    self.note_passing(ring.tets[i], x, y, corners, &mut found);
                }
            }
        }
        found
    }

    fn note_passing(
        &self,
        t: u32,
        u: u32,
        v: u32,
        corners: [u32; 3],
        found: &mut Vec<(u32, u32, u32)>,
    ) {
        if meets(&self.mesh, [u, v], corners) != Meets::Not
            && !found.iter().any(|&(_, x, y)| (x, y) == (u, v) || (y, x) == (u, v))
        {
            found.push((t, u, v));
        }
    }
}

/// What a facet meets beside one of its edges.
enum Beside {
    /// Its third corner: it is a face.
    Present,
    /// An edge of a tetrahedron, which passes it.
    Passed(u32, u32, u32),
    /// Nothing that could be told.
    Unknown,
}
