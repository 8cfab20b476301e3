//! Taking edges away from a vertex by flips.

use crate::tetrahedra::flips::{Effort, FLAT, Goal, Work};
use crate::tetrahedra::mesh::GHOST;

/// Each round takes a look at all edges.
const MOST_ROUNDS: usize = 8;
/// Plain flips, no search.
const EFFORT: Effort = Effort { depth: 0, ring: 16, tries: 0, flattest: FLAT };
/// Flips after flips that clear the way, be their tetrahedra flat.
const HARD: Effort = Effort { depth: 2, ring: 16, tries: 100, flattest: 0.0 };

impl Work {
    /// Removes edges of `s` that need not stay, until no flip removes one more: what is left of the star
    /// is small. `hard` where edges that are in the way may be removed first, and nearly flat
    /// tetrahedra made.
    pub(crate) fn shed_edges(&mut self, s: u32, hard: bool) {
        let effort = if hard { HARD } else { EFFORT };
        for _ in 0..MOST_ROUNDS {
            let mut shed = false;
            for v in self.around(s) {
                let found = self.mesh.find_edge(s, v);
                shed |= found
                    .is_some_and(|t| self.remove_edge(t, [s, v], Goal::Gone, 0, effort).is_some());
            }
            if !shed {
                break;
            }
        }
    }

    /// The vertices that have an edge with `s`, ascending, without the ghost.
    pub(super) fn around(&mut self, s: u32) -> Vec<u32> {
        let mut around: Vec<u32> = Vec::new();
        for t in self.mesh.star(s) {
            around.extend(self.mesh.tet(t).v.iter().filter(|&&v| v != s && v != GHOST));
        }
        around.sort_unstable();
        around.dedup();
        around
    }
}
