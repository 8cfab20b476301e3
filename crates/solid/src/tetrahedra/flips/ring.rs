//! Removing an edge by triangulating the ring round it.

use super::goal::Goal;
use super::state::Work;
use crate::tetrahedra::mesh::{Mesh, Ring};

/// More than anything costs.
const NEVER: i32 = i32::MAX / 4;

/// Buffers of the triangulation of a ring.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    cost: Vec<i32>,
    split: Vec<u32>,
    stack: Vec<(usize, usize)>,
    new: Vec<[u32; 4]>,
}

/// How much one thing in the way weighs against flat tetrahedra.
const WEIGHT: i32 = 1 << 12;

/// How many flat tetrahedra, of the two with the ends of the edge, the triangle of ring vertices `a`,
/// `b`, `c` makes; `None` where one of them is not positive, or flatter than `flattest`.
#[inline]
fn spans(mesh: &Mesh, u: u32, v: u32, [a, b, c]: [u32; 3], flattest: f64) -> Option<i32> {
    let above = mesh.orient(a, b, c, v);
    if above <= 0.0 {
        return None;
    }
    let below = mesh.orient(a, c, b, u);
    if below <= 0.0 {
        return None;
    }
    let (above, below) = (evenness(mesh, above, [a, b, c, v]), evenness(mesh, below, [a, b, c, u]));
    if above < flattest || below < flattest {
        return None;
    }
    Some(i32::from(above < FLAT) + i32::from(below < FLAT))
}

/// A tetrahedron that is less even than this is nearly flat: its corners were meant to lie in one plane.
pub(crate) const FLAT: f64 = 1e-10;

/// The volume of a tetrahedron relative to that of three edges of its lengths at right angles, where
/// `volume` is six times the first: from 1 down to 0 for a flat one.
#[inline]
pub(crate) fn evenness(mesh: &Mesh, volume: f64, [a, b, c, d]: [u32; 4]) -> f64 {
    let from = mesh.point(d);
    let square = |v: u32| {
        let p = mesh.point(v);
        let (x, y, z) = (p[0] - from[0], p[1] - from[1], p[2] - from[2]);
        x * x + y * y + z * z
    };
    volume / (square(a) * square(b) * square(c)).sqrt()
}

impl Work {
    /// Whether the edge `u`, `v` may go, with the faces of its ring.
    fn may_remove(&self, u: u32, v: u32, ring: &Ring) -> bool {
        let held = self.must.holds_edge(u, v)
            || (self.must.guard_facets
                && ring.vertices.iter().any(|&p| self.must.holds_face(u, v, p)));
        !held
    }

    /// Removes the edge of `ring`, between `u` and `v`, where some triangulation of the ring makes only
    /// positive tetrahedra and brings the goal nearer by at least `gain`: of all triangulations the one
    /// that leaves least in the way (\[FO97\] for the dynamic programme, \[Kli80\]). Returns by how much
    /// less is in the way.
    ///
    /// This is the 3-2 and the 4-4 flip, and all n-to-m flips of larger rings at once. O(n^3) exact
    /// tests for a ring of n.
    pub(crate) fn flip_ring(
        &mut self,
        u: u32,
        v: u32,
        ring: &Ring,
        goal: Goal,
        gain: i32,
        flattest: f64,
    ) -> Option<i32> {
        let n = ring.vertices.len();
        if n < 3 || !self.may_remove(u, v, ring) {
            return None;
        }
        let mut table = std::mem::take(&mut self.table);
        let done = self.best_ring(u, v, ring, goal, gain, flattest, &mut table);
        self.table = table;
        done
    }

    #[expect(clippy::too_many_arguments, reason = "one step of a flip, private")]
    fn best_ring(
        &mut self,
        u: u32,
        v: u32,
        ring: &Ring,
        goal: Goal,
        gain: i32,
        flattest: f64,
        table: &mut Table,
    ) -> Option<i32> {
        let mesh = &self.mesh;
        let p = &ring.vertices;
        let n = p.len();
        let before = goal.of_edge(mesh, u, v)
            + p.iter().map(|&w| goal.of_face(mesh, [u, v, w])).sum::<i32>();
        if before < gain {
            return None;
        }
        let most = (before - gain) * WEIGHT + WEIGHT - 1;
        table.cost.clear();
        table.cost.resize(n * n, NEVER);
        table.split.clear();
        table.split.resize(n * n, 0);
        for i in 0..n - 1 {
            table.cost[i * n + i + 1] = 0;
        }
        for width in 2..n {
            for i in 0..n - width {
                let j = i + width;
                let (mut best, mut at) = (NEVER, 0);
                for k in i + 1..j {
                    let below = table.cost[i * n + k] + table.cost[k * n + j];
                    if below >= best || below > most {
                        continue;
                    }
                    let face = [p[i], p[k], p[j]];
                    let Some(flat) = spans(mesh, u, v, face, flattest) else { continue };
                    let cost = below + flat + WEIGHT * goal.of_face(mesh, face);
                    if cost < best {
                        (best, at) = (cost, k);
                    }
                }
                if best < NEVER && width < n - 1 {
                    best += WEIGHT
                        * (goal.of_edge(mesh, p[i], p[j])
                            + goal.of_face(mesh, [u, p[i], p[j]])
                            + goal.of_face(mesh, [v, p[i], p[j]]));
                }
                table.cost[i * n + j] = best;
                table.split[i * n + j] = at as u32;
            }
        }
        let after = table.cost[n - 1];
        if after > most {
            return None;
        }
        table.new.clear();
        table.stack.clear();
        table.stack.push((0, n - 1));
        while let Some((i, j)) = table.stack.pop() {
            if j - i < 2 {
                continue;
            }
            let k = table.split[i * n + j] as usize;
            table.new.push([p[i], p[k], p[j], v]);
            table.new.push([p[i], p[j], p[k], u]);
            table.stack.push((i, k));
            table.stack.push((k, j));
        }
        self.exchange(&ring.tets, &table.new).then_some(before - after / WEIGHT)
    }
}
