//! Making missing segments edges, by flips.

use crate::tetrahedra::constraints::First;
use crate::tetrahedra::flips::{Effort, FLAT, Goal, Work};

/// More flips than this for one segment are not made at one go.
const MOST_STEPS: usize = 100_000;

/// How an attempt ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Attempt {
    /// It is in the mesh.
    Done,
    /// No flip within the effort brings it nearer.
    Stuck,
    /// This vertex lies on it.
    Blocked(u32),
}

impl Work {
    /// Flips until the segment `a`, `b` is an edge; each step takes away at least one of the faces that
    /// it meets, so that it ends.
    pub(crate) fn recover_segment(&mut self, a: u32, b: u32, effort: Effort) -> Attempt {
        let goal = Goal::Segment([a, b]);
        for _ in 0..MOST_STEPS {
            let mut nearer = false;
            for [from, to] in [[a, b], [b, a]] {
                match self.mesh.first_met(from, to) {
                    First::Present(_) => return Attempt::Done,
                    First::Lost => return Attempt::Stuck,
                    First::Vertex(v) => return Attempt::Blocked(v),
                    First::Face(t, f) => nearer = self.clear_face(t, f, goal, effort),
                    First::Edge(_, u, v) => {
                        nearer = self.remove_edge(u, v, goal, 1, effort).is_some();
                    }
                }
                if nearer {
                    break;
                }
            }
            if !nearer && !self.clear_way(a, b, goal, effort) {
                return Attempt::Stuck;
            }
        }
        Attempt::Stuck
    }

    /// Takes a face that is in the way away, by a flip of it or by removing one of its edges.
    fn clear_face(&mut self, t: u32, f: usize, goal: Goal, effort: Effort) -> bool {
        let [x, y, z] = self.mesh.tet(t).face(f);
        self.flip_face(t, f, goal, 1, effort.flattest.max(FLAT)).is_some()
            || [(x, y), (y, z), (z, x)]
                .into_iter()
                .any(|(u, v)| self.remove_edge(u, v, goal, 1, effort).is_some())
            || (effort.flattest < FLAT && self.flip_face(t, f, goal, 1, effort.flattest).is_some())
    }

    /// Tries all that the segment meets, from one end to the other.
    fn clear_way(&mut self, a: u32, b: u32, goal: Goal, effort: Effort) -> bool {
        let way = self.mesh.way(a, b);
        way.edges.iter().any(|&(_, u, v)| self.remove_edge(u, v, goal, 1, effort).is_some())
            || way.faces.iter().any(|&(t, f)| self.clear_face(t, f, goal, effort))
    }
}
