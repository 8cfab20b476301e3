//! Removing an edge after removing what blocks it.

use super::goal::Goal;
use super::ring::is_flatter;
use super::state::Work;
use crate::tetrahedra::mesh::{NONE, Ring};

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

/// A search: for what, and what is left of its effort.
struct Search {
    goal: Goal,
    effort: Effort,
    tries: u32,
}

impl Work {
    /// The ends of the edge whose edges with ring vertex `i` keep the corner of the ring there from being
    /// cut off.
    fn blocking(
        &self,
        [u, v]: [u32; 2],
        ring: &Ring,
        i: usize,
        flattest: f64,
    ) -> impl Iterator<Item = u32> + use<> {
        let p = &ring.vertices;
        let n = p.len();
        let (a, b, c) = (p[(i + n - 1) % n], p[i], p[(i + 1) % n]);
        let blocks = |tet: [u32; 4]| {
            let [x, y, z, w] = tet;
            let volume = self.mesh.orient(x, y, z, w);
            volume <= 0.0 || is_flatter(&self.mesh, volume, tet, flattest)
        };
        let found = [blocks([a, c, b, u]).then_some(u), blocks([a, b, c, v]).then_some(v)];
        found.into_iter().flatten()
    }

    /// Removes the edge `u`, `v`, likely one of tetrahedron `guess`, if need be after removing edges between
    /// its ends and its ring, which shrinks the ring or clears the view. The sum of all must bring the goal
    /// nearer by at least `gain`; else everything is undone and nothing is returned.
    pub(crate) fn remove_edge(
        &mut self,
        guess: u32,
        [u, v]: [u32; 2],
        goal: Goal,
        gain: i32,
        effort: Effort,
    ) -> Option<i32> {
        let mut search = Search { goal, effort, tries: effort.tries };
        self.remove_below(guess, [u, v], gain, effort.depth, &mut search)
    }

    fn remove_below(
        &mut self,
        guess: u32,
        [u, v]: [u32; 2],
        gain: i32,
        depth: u32,
        search: &mut Search,
    ) -> Option<i32> {
        if self.must.holds_edge(u, v) {
            return None;
        }
        let mark = self.log.len();
        let mut ring = self.rings.pop().unwrap_or_default();
        let Search { goal, effort, .. } = *search;
        let mut guess = guess;
        let mut sum = 0;
        let mut done = None;
        for _ in 0..effort.ring {
            let Some(t) = self.mesh.edge_near(guess, u, v) else {
                // It went with something else.
                done = (sum >= gain).then_some(sum);
                break;
            };
            if !self.mesh.ring(t, u, v, effort.ring, &mut ring)
                || ring.vertices.iter().any(|&p| self.must.holds_face(u, v, p))
            {
                break;
            }
            if let Some(less) = self.flip_ring([u, v], &ring, goal, gain - sum, effort.flattest) {
                done = Some(sum + less);
                break;
            }
            if depth == 0 {
                break;
            }
            let mut shrunk = false;
            'spokes: for (i, (&p, &t)) in ring.vertices.iter().zip(&ring.tets).enumerate() {
                for end in self.blocking([u, v], &ring, i, effort.flattest) {
                    if search.tries == 0 {
                        break 'spokes;
                    }
                    search.tries -= 1;
                    if let Some(less) = self.remove_below(t, [end, p], 0, depth - 1, search) {
                        sum += less;
                        shrunk = true;
                        break 'spokes;
                    }
                }
            }
            if !shrunk {
                break;
            }
            let still = |t: &&u32| {
                self.mesh
                    .tets
                    .get(**t as usize)
                    .is_some_and(|t| t.v.contains(&u) && t.v.contains(&v))
            };
            guess = ring.tets.iter().find(still).copied().unwrap_or(NONE);
        }
        self.rings.push(ring);
        if done.is_none() {
            self.undo_to(mark);
        }
        done
    }
}
