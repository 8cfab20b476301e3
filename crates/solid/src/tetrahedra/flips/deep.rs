//! Removing an edge after removing what blocks it.

use super::goal::Goal;
use super::state::Work;

/// How far a search for flips goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Effort {
    /// How many edges may be removed for the sake of the removal of another.
    pub(crate) depth: u32,
    /// The largest ring that is looked at.
    pub(crate) ring: usize,
    /// How many removals are tried in one search.
    pub(crate) tries: u32,
    /// Flatter tetrahedra than this are not made; see [`evenness`](super::evenness).
    pub(crate) flattest: f64,
}

impl Work {
    /// Removes the edge `u`, `v`, if need be after removing edges between its ends and its ring, which
    /// shrinks the ring or clears the view. The sum of all must bring the goal nearer by at least
    /// `gain`; else everything is undone and nothing is returned.
    pub(crate) fn remove_edge(
        &mut self,
        u: u32,
        v: u32,
        goal: Goal,
        gain: i32,
        effort: Effort,
    ) -> Option<i32> {
        let mut tries = effort.tries;
        self.remove_below(u, v, goal, gain, effort, effort.depth, &mut tries)
    }

    #[expect(clippy::too_many_arguments, reason = "one step of a bounded search, private")]
    fn remove_below(
        &mut self,
        u: u32,
        v: u32,
        goal: Goal,
        gain: i32,
        effort: Effort,
        depth: u32,
        tries: &mut u32,
    ) -> Option<i32> {
        if self.must.holds_edge(u, v) {
            return None;
        }
        let mark = self.log.len();
        let mut ring = self.rings.pop().unwrap_or_default();
        let mut sum = 0;
        let mut done = None;
        for _ in 0..effort.ring {
            let Some(t) = self.mesh.find_edge(u, v) else {
                // It went with something else.
                done = (sum >= gain).then_some(sum);
                break;
            };
            if !self.mesh.ring(t, u, v, effort.ring, &mut ring) {
                break;
            }
            if let Some(less) = self.flip_ring(u, v, &ring, goal, gain - sum, effort.flattest) {
                done = Some(sum + less);
                break;
            }
            if depth == 0 {
                break;
            }
            let mut shrunk = false;
            'spokes: for i in 0..ring.vertices.len() {
                let p = ring.vertices[i];
                if self.must.holds_face(u, v, p) {
                    break;
                }
                for end in [u, v] {
                    if *tries == 0 {
                        break 'spokes;
                    }
                    *tries -= 1;
                    if let Some(less) = self.remove_below(end, p, goal, 0, effort, depth - 1, tries)
                    {
                        sum += less;
                        shrunk = true;
                        break 'spokes;
                    }
                }
            }
            if !shrunk {
                break;
            }
        }
        self.rings.push(ring);
        if done.is_none() {
            self.undo_to(mark);
        }
        done
    }
}
