//! Letting go of what is held, so that something stuck gets through.

use super::segments::Attempt;
use crate::tetrahedra::flips::{Effort, Work};
use crate::tetrahedra::mesh::Ring;

/// How many held segments are let go of, one after the other.
const MOST: usize = 24;

impl Work {
    /// Brings in the stuck segment `a`, `b` after letting go of one held segment that stands in the
    /// way, and then that one again. False, with nothing changed, where this works for none.
    pub(crate) fn detour(&mut self, a: u32, b: u32, effort: Effort) -> bool {
        let Some(wanted) = self.must.segment(a, b) else { return false };
        for other in self.held_in_the_way(a, b) {
            let [c, d] = self.must.segments[other as usize].ends;
            let mark = self.log.len();
            self.must.segments[other as usize].held = false;
            if self.recover_segment(a, b, effort) == Attempt::Done {
                self.must.segments[wanted as usize].held = true;
                if self.recover_segment(c, d, effort) == Attempt::Done {
                    self.must.segments[other as usize].held = true;
                    return true;
                }
                self.must.segments[wanted as usize].held = false;
            }
            self.undo_to(mark);
            self.must.segments[other as usize].held = true;
        }
        false
    }

    /// Held segments without held facets among the edges of what the segment passes.
    fn held_in_the_way(&mut self, a: u32, b: u32) -> Vec<u32> {
        let way = self.mesh.way(a, b);
        let mut ring = Ring::default();
        let mut found = Vec::new();
        let mut note = |work: &Self, u: u32, v: u32| {
            if let Some(id) = work.must.segment(u, v)
                && work.must.segments[id as usize].held
                && !found.contains(&id)
                && !work.must.segments[id as usize]
                    .faces
                    .iter()
                    .any(|&f| work.must.guard_facets && work.must.facets[f as usize].held)
            {
                found.push(id);
            }
        };
        for &(t, f) in &way.faces {
            let [x, y, z] = self.mesh.tet(t).face(f);
            for (u, v) in [(x, y), (y, z), (z, x)] {
                note(self, u, v);
            }
        }
        for &(t, f) in &way.faces {
            let [x, y, z] = self.mesh.tet(t).face(f);
            for (u, v) in [(x, y), (y, z), (z, x)] {
                if !self.must.holds_edge(u, v) && self.mesh.ring(t, u, v, 40, &mut ring) {
                    for &p in &ring.vertices {
                        note(self, u, p);
                        note(self, v, p);
                    }
                }
            }
        }
        found.truncate(MOST);
        found
    }
}
