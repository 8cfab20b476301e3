//! Inside and outside, by flood fill.

use super::flips::Work;
use super::gate::Inside;
use super::predicates::orient;

impl Work {
    /// For each slot whether its tetrahedron is inside. O(n).
    pub(super) fn classify(&mut self, inside: &Inside) -> Vec<bool> {
        const UNKNOWN: u8 = 2;
        let tets = self.mesh.tets.len();
        let mut side = vec![UNKNOWN; tets];
        let mut queue: Vec<u32> = (0..tets as u32)
            .filter(|&t| self.mesh.tet(t).is_live() && self.mesh.tet(t).is_ghost())
            .collect();
        if let Inside::Enclosed(holes) = inside {
            for hole in holes {
                let p = [hole.x, hole.y, hole.z];
                let found = self.mesh.finite().find(|&t| {
                    (0..4).all(|f| {
                        let [a, b, c] = self.mesh.tet(t).face(f).map(|v| self.mesh.point(v));
                        orient(a, b, c, &p) >= 0.0
                    })
                });
                queue.extend(found);
            }
        }
        for &t in &queue {
            side[t as usize] = 0;
        }
        while let Some(t) = queue.pop() {
            let tet = *self.mesh.tet(t);
            for f in 0..4 {
                let other = (tet.n[f] >> 2) as usize;
                if side[other] != UNKNOWN {
                    continue;
                }
                let [a, b, c] = tet.face(f);
                let copies =
                    self.must.facet(a, b, c).map_or(0, |id| self.must.facets[id as usize].copies);
                if copies > 0 && *inside != Inside::Odd {
                    continue;
                }
                side[other] = side[t as usize] ^ (copies % 2) as u8;
                queue.push(other as u32);
            }
        }
        (0..tets)
            .map(|t| {
                let tet = &self.mesh.tets[t];
                tet.is_live() && !tet.is_ghost() && side[t] != 0
            })
            .collect()
    }
}
