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

/// A segment that is looked for.
struct Wanted {
    goal: Goal,
    effort: Effort,
    /// The edges that could not be removed since the last flip.
    firm: Vec<[u32; 2]>,
}

impl Work {
    /// Flips until the segment `a`, `b` is an edge; each step takes away at least one of the faces that
    /// it meets, so that it ends.
    pub(crate) fn recover_segment(&mut self, a: u32, b: u32, effort: Effort) -> Attempt {
        let mut wanted = Wanted { goal: Goal::Segment([a, b]), effort, firm: Vec::new() };
        for _ in 0..MOST_STEPS {
            let mut nearer = false;
            for [from, to] in [[a, b], [b, a]] {
                match self.mesh.first_met(from, to) {
                    First::Present(_) => return Attempt::Done,
                    First::Lost => return Attempt::Stuck,
                    First::Vertex(v) => return Attempt::Blocked(v),
                    First::Face(t, f) => nearer = self.clear_face(t, f, &mut wanted),
                    First::Edge(t, u, v) => nearer = self.clear_edge(t, [u, v], &mut wanted),
                }
                if nearer {
                    break;
                }
            }
            if !nearer && !self.clear_way(a, b, &mut wanted) {
                return Attempt::Stuck;
            }
            wanted.firm.clear();
        }
        Attempt::Stuck
    }

    /// Removes an edge of tetrahedron `t`, unless that was tried since the last flip.
    fn clear_edge(&mut self, t: u32, [u, v]: [u32; 2], wanted: &mut Wanted) -> bool {
        let edge = [u.min(v), u.max(v)];
        if wanted.firm.contains(&edge) {
            return false;
        }
        let done = self.remove_edge(t, edge, wanted.goal, 1, wanted.effort).is_some();
        if !done {
            wanted.firm.push(edge);
        }
        done
    }

    /// Takes a face that is in the way away, by a flip of it or by removing one of its edges.
    fn clear_face(&mut self, t: u32, f: usize, wanted: &mut Wanted) -> bool {
        let [x, y, z] = self.mesh.tet(t).face(f);
        let (goal, flattest) = (wanted.goal, wanted.effort.flattest);
        self.flip_face(t, f, goal, 1, flattest.max(FLAT)).is_some()
            || [[x, y], [y, z], [z, x]].into_iter().any(|edge| self.clear_edge(t, edge, wanted))
            || (flattest < FLAT && self.flip_face(t, f, goal, 1, flattest).is_some())
    }

    /// Tries all that the segment meets, from one end to the other.
    fn clear_way(&mut self, a: u32, b: u32, wanted: &mut Wanted) -> bool {
        let way = self.mesh.way(a, b);
        way.edges.iter().any(|&(t, u, v)| self.clear_edge(t, [u, v], wanted))
            || way.faces.iter().any(|&(t, f)| self.clear_face(t, f, wanted))
    }
}
