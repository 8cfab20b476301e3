//! A free point beside a knot, so that flips get through.

use crate::tetrahedra::flips::{Effort, Work};
use crate::tetrahedra::mesh::Ring;
use crate::tetrahedra::predicates::P3;
use crate::tetrahedra::recover::Attempt;

/// What flips may try after each point.
const EFFORT: Effort = Effort { depth: 1, ring: 40, tries: 80 };
/// How many places are tried.
const MOST_PLACES: usize = 60;
/// How many are tried where two points are.
const FEW_PLACES: usize = 10;

impl Work {
    /// Makes the stuck segment `a`, `b` an edge with the help of one or two free points off all
    /// constraints. False, with nothing changed, where that does not do.
    pub(crate) fn unlock_segment(&mut self, a: u32, b: u32) -> bool {
        let way = self.mesh.way(a, b);
        let tets = self.with_neighbours(&way.tets);
        let retry = |work: &mut Self| work.recover_segment(a, b, EFFORT) == Attempt::Done;
        if self.unlock(&tets, MOST_PLACES, retry) {
            return true;
        }
        self.unlock(&tets, FEW_PLACES, |work| {
            if work.recover_segment(a, b, EFFORT) == Attempt::Done {
                return true;
            }
            let way = work.mesh.way(a, b);
            let tets = work.with_neighbours(&way.tets);
            work.unlock(&tets, FEW_PLACES, retry)
        })
    }

    /// As [`unlock_segment`](Self::unlock_segment), for a facet.
    pub(crate) fn unlock_facet(&mut self, corners: [u32; 3]) -> bool {
        let mut tets = Vec::new();
        let mut ring = Ring::default();
        for (t, u, v) in self.passing(corners) {
            if self.mesh.ring(t, u, v, usize::MAX, &mut ring) {
                tets.extend_from_slice(&ring.tets);
            }
        }
        let tets = self.with_neighbours(&tets);
        self.unlock(&tets, MOST_PLACES, |work| work.recover_facet(corners, EFFORT) == Attempt::Done)
    }

    fn unlock(
        &mut self,
        tets: &[u32],
        most: usize,
        mut retry: impl FnMut(&mut Self) -> bool,
    ) -> bool {
        let (mark, points) = (self.log.len(), self.mesh.points.len());
        for (place, start) in self.places(tets, most) {
            if self.insert_steiner(place, &[start]).is_some() {
                if retry(self) {
                    return true;
                }
                self.undo_with_points(mark, points);
            }
        }
        false
    }

    /// The middles of the tetrahedra, largest first.
    fn places(&self, tets: &[u32], most: usize) -> Vec<(P3, u32)> {
        let mut sized: Vec<(f64, u32)> = tets
            .iter()
            .map(|&t| {
                let [a, b, c, d] = self.mesh.tet(t).v;
                (self.mesh.orient(a, b, c, d), t)
            })
            .collect();
        sized.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        sized
            .into_iter()
            .take(most)
            .map(|(_, t)| {
                let corners = self.mesh.tet(t).v.map(|v| *self.mesh.point(v));
                ([0, 1, 2].map(|k| corners.iter().map(|p| p[k] / 4.0).sum()), t)
            })
            .collect()
    }

    /// Tetrahedra and their neighbours, ascending.
    pub(super) fn with_neighbours(&self, tets: &[u32]) -> Vec<u32> {
        let mut all = tets.to_vec();
        for &t in tets {
            all.extend(self.mesh.tet(t).n.iter().map(|code| code >> 2));
        }
        all.retain(|&t| !self.mesh.tet(t).is_ghost());
        all.sort_unstable();
        all.dedup();
        all
    }
}
