//! Removing an edge by triangulating the ring round it.

use super::goal::Goal;
use super::known::Known;
use super::state::Work;
use crate::tetrahedra::mesh::{Mesh, Ring};

/// More than anything costs.
const NEVER: i32 = i32::MAX / 4;

/// Buffers of the triangulation of a ring.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// For each triangle of ring vertices, 0 where it was not looked at, 1 where it makes no positive
    /// tetrahedra, else 2 and how many of its two tetrahedra are flat.
    spans: Vec<u8>,
    /// The same for the corners that can be cut off.
    ears: Vec<u8>,
    /// For each two ring vertices what the best triangulation between them costs, and the vertex at its
    /// edge.
    cost: Vec<(i32, u32)>,
    stack: Vec<(usize, usize)>,
    new: Vec<[u32; 4]>,
}

/// How much one thing in the way weighs against flat tetrahedra.
const WEIGHT: i32 = 1 << 12;
/// The triangle makes a tetrahedron that is not positive, or too flat.
const NO: u8 = 1;
/// It makes good ones; plus how many of them are flat.
const YES: u8 = 2;

/// A tetrahedron that is less even than this is nearly flat: its corners were meant to lie in one plane.
pub(crate) const FLAT: f64 = 1e-10;

/// The squares of the lengths of three edges at corner `d`, multiplied.
#[inline]
fn squares(mesh: &Mesh, [a, b, c, d]: [u32; 4]) -> f64 {
    let from = mesh.point(d);
    let square = |v: u32| {
        let p = mesh.point(v);
        let (x, y, z) = (p[0] - from[0], p[1] - from[1], p[2] - from[2]);
        x * x + y * y + z * z
    };
    square(a) * square(b) * square(c)
}

/// The volume of a tetrahedron relative to that of three edges of its lengths at right angles, where
/// `volume` is six times the first: from 1 down to 0 for a flat one.
#[inline]
pub(crate) fn evenness(mesh: &Mesh, volume: f64, tet: [u32; 4]) -> f64 {
    volume / squares(mesh, tet).sqrt()
}

/// Whether the [`evenness`] is less than `bound`.
#[inline]
pub(super) fn is_flatter(mesh: &Mesh, volume: f64, tet: [u32; 4], bound: f64) -> bool {
    volume * volume < bound * bound * squares(mesh, tet)
}

/// A ring with the ends of its edge.
#[derive(Clone, Copy)]
struct Around<'a> {
    mesh: &'a Mesh,
    ends: [u32; 2],
    ring: &'a [u32],
    flattest: f64,
}

impl Around<'_> {
    /// What the triangle of three ring vertices makes with the ends of the edge; see [`Table::spans`].
    fn spans(&self, [i, k, j]: [usize; 3]) -> u8 {
        let [u, v] = self.ends;
        let [a, b, c] = [self.ring[i], self.ring[k], self.ring[j]];
        let above = self.mesh.orient(a, b, c, v);
        if above <= 0.0 {
            return NO;
        }
        let below = self.mesh.orient(a, c, b, u);
        if below <= 0.0 {
            return NO;
        }
        let flat = |bound: f64| {
            u8::from(is_flatter(self.mesh, above, [a, b, c, v], bound))
                + u8::from(is_flatter(self.mesh, below, [a, b, c, u], bound))
        };
        if self.flattest >= FLAT {
            return if flat(self.flattest) > 0 { NO } else { YES };
        }
        if flat(self.flattest) > 0 { NO } else { YES + flat(FLAT) }
    }

    /// Whether some triangulation of the ring makes good tetrahedra only; fills in `spans`.
    fn is_fertile(&self, table: &mut Table) -> bool {
        let n = self.ring.len();
        // Of two ears that have no edge in common one is among these.
        table.ears.clear();
        table.ears.extend((0..n - 2).map(|i| self.spans([i, i + 1, i + 2])));
        if table.ears.iter().all(|&ear| ear == NO) {
            return false;
        }
        table.spans.clear();
        table.spans.resize(n * n * n, 0);
        for (i, &ear) in table.ears.iter().enumerate() {
            table.spans[(i * n + i + 1) * n + i + 2] = ear;
        }
        if n == 3 {
            return true;
        }
        table.cost.clear();
        table.cost.resize(n * n, (NEVER, 0));
        for i in 0..n - 1 {
            table.cost[i * n + i + 1].0 = 0;
        }
        for width in 2..n {
            for i in 0..n - width {
                let j = i + width;
                let found = (i + 1..j).any(|k| {
                    if table.cost[i * n + k].0 == NEVER || table.cost[k * n + j].0 == NEVER {
                        return false;
                    }
                    let known = &mut table.spans[(i * n + k) * n + j];
                    if *known == 0 {
                        *known = self.spans([i, k, j]);
                    }
                    *known != NO
                });
                table.cost[i * n + j].0 = if found { 0 } else { NEVER };
            }
        }
        table.cost[n - 1].0 == 0
    }

    /// The least that a triangulation of a fertile ring costs, as far as it is not more than `most`; how it
    /// runs is in the table.
    fn cheapest(&self, goal: Goal, most: i32, known: &mut Known, table: &mut Table) -> i32 {
        let (mesh, p, n) = (self.mesh, self.ring, self.ring.len());
        let [u, v] = self.ends;
        table.cost.clear();
        table.cost.resize(n * n, (NEVER, 0));
        for i in 0..n - 1 {
            table.cost[i * n + i + 1].0 = 0;
        }
        for width in 2..n {
            for i in 0..n - width {
                let j = i + width;
                let (mut best, mut at) = (NEVER, 0);
                for k in i + 1..j {
                    let below = table.cost[i * n + k].0 + table.cost[k * n + j].0;
                    if below >= best || below > most {
                        continue;
                    }
                    let spans = &mut table.spans[(i * n + k) * n + j];
                    if *spans == 0 {
                        *spans = self.spans([i, k, j]);
                    }
                    if *spans == NO {
                        continue;
                    }
                    let flat = i32::from(*spans - YES);
                    let cost =
                        below + flat + WEIGHT * known.of_face(mesh, goal, [p[i], p[k], p[j]]);
                    if cost < best {
                        (best, at) = (cost, k);
                    }
                }
                if best <= most && width < n - 1 {
                    best += WEIGHT
                        * (known.of_edge(mesh, goal, p[i], p[j])
                            + known.of_face(mesh, goal, [u, p[i], p[j]])
                            + known.of_face(mesh, goal, [v, p[i], p[j]]));
                }
                table.cost[i * n + j] = (best, at as u32);
            }
        }
        table.cost[n - 1].0
    }

    /// The tetrahedra of the triangulation found.
    fn fill(&self, table: &mut Table) {
        let (p, n, [u, v]) = (self.ring, self.ring.len(), self.ends);
        table.new.clear();
        table.stack.clear();
        table.stack.push((0, n - 1));
        while let Some((i, j)) = table.stack.pop() {
            if j - i < 2 {
                continue;
            }
            let k = table.cost[i * n + j].1 as usize;
            table.new.push([p[i], p[k], p[j], v]);
            table.new.push([p[i], p[j], p[k], u]);
            table.stack.push((i, k));
            table.stack.push((k, j));
        }
    }
}

impl Work {
    /// Removes the edge of `ring`, which may go with its faces, where some triangulation of the ring makes
    /// only positive tetrahedra and brings the goal nearer by at least `gain`: of all triangulations the one
    /// that leaves least in the way (\[FO97\] for the dynamic programme, \[Kli80\]). Returns by how much
    /// less is in the way.
    ///
    /// This is the 3-2 and the 4-4 flip, and all n-to-m flips of larger rings at once. O(n^3) exact
    /// tests for a ring of n, and O(n) where none of its corners can be cut off, or where the ring was
    /// looked at before.
    pub(super) fn flip_ring(
        &mut self,
        ends: [u32; 2],
        ring: &Ring,
        goal: Goal,
        gain: i32,
        flattest: f64,
    ) -> Option<i32> {
        let [u, v] = ends;
        if ring.vertices.len() < 3 {
            return None;
        }
        let Self { mesh, known, table, .. } = self;
        let crossed: i32 =
            ring.vertices.iter().map(|&w| known.of_face(mesh, goal, [u, v, w])).sum();
        let before = crossed + known.of_edge(mesh, goal, u, v);
        if before < gain {
            return None;
        }
        let name = known.name(u, v, ring, flattest);
        if known.is_barren(name) {
            return None;
        }
        let around = Around { mesh, ends, ring: &ring.vertices, flattest };
        if !around.is_fertile(table) {
            known.note_barren(name);
            return None;
        }
        let most = (before - gain) * WEIGHT + WEIGHT - 1;
        let after = around.cheapest(goal, most, known, table);
        if after > most {
            return None;
        }
        around.fill(table);
        let table = std::mem::take(&mut self.table);
        let done = self.exchange(&ring.tets, &table.new).then_some(before - after / WEIGHT);
        self.table = table;
        done
    }
}
