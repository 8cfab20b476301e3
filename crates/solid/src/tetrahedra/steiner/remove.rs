//! Being rid of free points again.

use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::NONE;
use crate::tetrahedra::reconnect::Region;

/// How many steps a search takes to fill the hole of a point without it, first and when it is hard.
const STEPS: [u32; 2] = [400, 2000];
/// The largest region that is searched.
const MOST: [usize; 2] = [20, 30];

impl Work {
    /// Removes a free point, on no constraint, by filling its hole, made larger where need be, from a
    /// neighbour, or anew in any way; `hard` with more effort. False where neither works.
    pub(crate) fn remove_free(&mut self, s: u32, hard: bool) -> bool {
        self.shed_edges(s, hard);
        let star = self.mesh.star(s);
        if star.iter().any(|&t| self.mesh.tet(t).is_ghost()) {
            return false;
        }
        let around = self.around(s);
        for &to in &around {
            if self.star_in(to, &star, false, Some(s)) {
                self.mesh.at[s as usize] = NONE;
                return true;
            }
        }
        let mut region = Region::of(&self.mesh, &star);
        for _ in 0..if hard { 12 } else { 6 } {
            if region.vertices.len() > MOST[usize::from(hard)] {
                return false;
            }
            if self.reconnect(&region, &[], &[], Some(s), STEPS[usize::from(hard)]) {
                self.mesh.at[s as usize] = NONE;
                return true;
            }
            let blamed = std::mem::take(&mut self.blamed);
            if blamed.is_empty() {
                return false;
            }
            for t in blamed {
                region.add(&self.mesh, t);
            }
        }
        false
    }
}
