//! Taking a point off a segment before there are facets: walls are chosen in their place.

use super::room::Hole;
use super::suppress::{MOST_SEARCHED, STEPS, same_turn};
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::{Mesh, NONE};
use crate::tetrahedra::reconnect::Region;

impl Work {
    /// Takes `s`, between `a` and `b`, which it has edges with, off the way from one to the other, which
    /// becomes an edge: without a new point, or with one in each space between walls that have the edge
    /// and a corner beside it. False, with nothing changed, where that cannot be.
    pub(crate) fn bypass(&mut self, s: u32, a: u32, b: u32) -> bool {
        let star = self.mesh.star(s);
        if star.iter().any(|&t| self.mesh.tet(t).is_ghost()) {
            return false;
        }
        let region = Region::of(&self.mesh, &star);
        let done = (region.vertices.len() <= MOST_SEARCHED
            && self.reconnect(&region, &[[a, b]], &[], Some(s), STEPS)
            && self.mesh.find_edge(a, b).is_some())
            || self.put_points_round(s, a, b, &star);
        if done {
            self.mesh.at[s as usize] = NONE;
        }
        done
    }

    /// Fills the spaces round `s` between walls through the edge `a`, `b`.
    fn put_points_round(&mut self, s: u32, a: u32, b: u32, star: &[u32]) -> bool {
        let beside = |mesh: &Mesh, end: u32| -> Vec<u32> {
            let mut all: Vec<u32> = star
                .iter()
                .filter(|&&t| mesh.tet(t).v.contains(&end))
                .flat_map(|&t| mesh.tet(t).v)
                .filter(|&v| v != s && v != end)
                .collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let (of_a, of_b) = (beside(&self.mesh, a), beside(&self.mesh, b));
        let sides: Vec<u32> =
            of_a.into_iter().filter(|v| *v != b && of_b.binary_search(v).is_ok()).collect();
        if sides.len() < 2 {
            return false;
        }
        let sectors = self.sectors_between(s, star, [a, b], &sides);
        sectors.len() >= 2 && self.put_points_beside(s, star, &sectors)
    }

    /// The spaces round `s` between the walls through `ends` and each of `sides`.
    fn sectors_between(&self, s: u32, star: &[u32], ends: [u32; 2], sides: &[u32]) -> Vec<Hole> {
        let [a, b] = ends;
        let mut of = vec![usize::MAX; star.len()];
        let mut sectors = Vec::new();
        for first in 0..star.len() {
            if of[first] != usize::MAX {
                continue;
            }
            let id = sectors.len();
            let mut sector = Hole::default();
            let mut stack = vec![first];
            of[first] = id;
            while let Some(i) = stack.pop() {
                let tet = self.mesh.tet(star[i]);
                sector.own.push(star[i]);
                for f in 0..4 {
                    let corners = tet.face(f);
                    if tet.v[f] == s {
                        sector.far.push((corners, tet.n[f]));
                        continue;
                    }
                    let side = corners.iter().copied().find(|v| sides.contains(v));
                    let end = corners.iter().copied().find(|v| ends.contains(v));
                    if let (Some(side), Some(end)) = (side, end) {
                        // The part of the wall at one end, seen from inside; the whole has both ends.
                        let part = [s, end, side];
                        let other = if end == a { b } else { a };
                        let whole = if same_turn(corners, part) {
                            [other, end, side]
                        } else {
                            [end, other, side]
                        };
                        if !sector.near.iter().any(|wall| same_turn(*wall, whole)) {
                            sector.near.push(whole);
                        }
                        continue;
                    }
                    if let Some(j) = star.iter().position(|&t| t == tet.n[f] >> 2)
                        && of[j] == usize::MAX
                    {
                        of[j] = id;
                        stack.push(j);
                    }
                }
            }
            sectors.push(sector);
        }
        sectors
    }
}
