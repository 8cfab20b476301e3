//! A stuck segment by a detour: over a point on it, which then gives way to free points beside it.

use super::segments::Attempt;
use crate::tetrahedra::flips::{Effort, Work};

/// How often a half is divided again.
const MOST_DEPTH: u32 = 5;

impl Work {
    /// Makes the segment `a`, `b` an edge where flips alone do not: a point on it, its halves by flips or
    /// by detours of their own, and the point taken off again. Only free points stay. False, with nothing
    /// changed, where some step fails.
    pub(crate) fn recover_by_detour(
        &mut self,
        a: u32,
        b: u32,
        effort: Effort,
        turn: usize,
    ) -> bool {
        let (mark, points) = (self.log.len(), self.mesh.points.len());
        let done = self.detour(a, b, effort, turn, MOST_DEPTH);
        if !done {
            self.undo_to(mark);
            self.drop_points(points);
        }
        done
    }

    /// One level; each halves the number of things in the way, about. Where it fails, the caller undoes.
    fn detour(&mut self, a: u32, b: u32, effort: Effort, turn: usize, depth: u32) -> bool {
        let Some(s) = self.place_on(a, b, turn) else { return false };
        let halves = [[a, s], [s, b]];
        for [p, q] in halves {
            self.must.hold_bare(p, q, false);
        }
        let mut done = true;
        for [p, q] in halves {
            done = done
                && (self.recover_segment(p, q, effort) == Attempt::Done
                    || (depth > 0 && self.detour(p, q, effort, turn, depth - 1)));
            self.must.hold_bare(p, q, done);
        }
        if done {
            self.shed_edges(s, false);
        }
        for [p, q] in halves {
            self.must.drop_bare(p, q);
        }
        done && self.bypass(s, a, b)
    }
}
