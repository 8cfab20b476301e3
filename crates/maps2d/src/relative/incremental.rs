//! Which pairs have to be compared after a change, and no others ([ISRR19] 4.3).

use posegraph::{PoseGraph, Scope};
use probe::{EdgeId, VertexId};

use super::{RelativeMap, VolumeState};
use crate::MapProbe;

impl RelativeMap {
    /// A volume is new or has grown: only pairs with itself can have changed.
    ///
    /// All paths between other vertices are what they were, because a new vertex hangs on one edge,
    /// and place edges are dealt with when they come.
    pub(super) fn compare_with_scope(&mut self, root: VertexId, probe: &mut dyn MapProbe) {
        self.take_scope(root, probe);
        let mut pairs = std::mem::take(&mut self.work.pairs);
        pairs.clear();
        for row in 0..self.scope.placed().len() as u32 {
            if !self.is_active(row) {
                continue;
            }
            if self.may_touch(0, row) {
                pairs.push((0, row));
            }
            if row != 0 && self.row_has_open(row) && self.may_touch(row, 0) {
                pairs.push((row, 0));
            }
        }
        self.work.pairs = pairs;
        self.consolidate(probe);
    }

    /// Edges were added at one vertex: only pairs whose shortest path they changed are compared.
    ///
    /// Seen from that vertex, the root, these are pairs of which at least one came nearer, and whose
    /// ways from the root part at the root itself: where two ways share their first link, the path
    /// between the two does not pass the root, and no new edge is on it.
    pub(super) fn take_edges(
        &mut self,
        graph: &PoseGraph,
        edges: &[EdgeId],
        probe: &mut dyn MapProbe,
    ) {
        let Some(&first) = edges.first() else { return };
        let first = graph.edge(first);
        let shared =
            |v: VertexId| edges.iter().all(|&e| [graph.edge(e).a, graph.edge(e).b].contains(&v));
        let newer = first.a.max(first.b);
        let vertex = if shared(newer) { newer } else { first.a.min(first.b) };
        for &id in edges {
            let edge = graph.edge(id);
            self.book.learn(id, edge.kind);
            self.cover(edge.a.max(edge.b));
        }
        let root = self.skeleton.resolve(vertex).0;
        self.take_scope(root, &mut probe::Off);
        let before = std::mem::take(&mut self.scope);
        for &id in edges {
            self.skeleton.add_edge(id, graph.edge(id));
        }
        self.scope_is_fresh = false;
        self.take_scope(root, probe);
        self.compare_across(&before, probe);
    }

    /// Compares the pairs of which at least one is not as far from the root as it was in `before`,
    /// and whose ways part at the root.
    pub(super) fn compare_across(&mut self, before: &Scope, probe: &mut dyn MapProbe) {
        let mut old: Vec<(VertexId, f64)> =
            before.placed().iter().map(|row| (row.vertex, row.distance_m)).collect();
        old.sort_unstable_by_key(|row| row.0);
        let rows = self.scope.placed();
        // The row right after the root on the way to each row; the root is its own.
        let mut branch: Vec<u32> = Vec::with_capacity(rows.len());
        let (mut moved, mut active): (Vec<bool>, Vec<u32>) = (Vec::new(), Vec::new());
        for (i, row) in rows.iter().enumerate() {
            branch.push(match row.parent {
                None | Some(0) => i as u32,
                Some(parent) => branch[parent as usize],
            });
            let was = old.binary_search_by_key(&row.vertex, |o| o.0).ok().map(|k| old[k].1);
            moved.push(was != Some(row.distance_m));
            if self.is_active(i as u32) {
                active.push(i as u32);
            }
        }
        let mut pairs = std::mem::take(&mut self.work.pairs);
        pairs.clear();
        for &a in &active {
            if !self.row_has_open(a) {
                continue;
            }
            for &b in &active {
                let parted = branch[a as usize] != branch[b as usize];
                let changed = moved[a as usize] || moved[b as usize];
                if parted && changed && self.may_touch(a, b) {
                    pairs.push((a, b));
                }
            }
        }
        self.work.pairs = pairs;
        self.consolidate(probe);
    }

    /// Whether the open frontier of row `a` comes near the volume of row `b` at all.
    fn may_touch(&self, a: u32, b: u32) -> bool {
        let rows = self.scope.placed();
        let (a, b) = (&rows[a as usize], &rows[b as usize]);
        let (Some(of_a), Some(of_b)) = (self.volume(a.vertex), self.volume(b.vertex)) else {
            return false;
        };
        let (centre, radius_m) = of_a.open_disc;
        let apart = a.root_from_vertex.transform(&centre) - b.root_from_vertex.translation;
        let reach_m = radius_m + of_b.volume.radius_m() + self.params.wall_closing_m;
        apart.coords.norm_squared() <= reach_m * reach_m
    }

    fn is_active(&self, row: u32) -> bool {
        let vertex = self.scope.placed()[row as usize].vertex;
        self.volumes[vertex].as_deref().is_some_and(|state| !state.retired)
    }

    fn row_has_open(&self, row: u32) -> bool {
        let vertex = self.scope.placed()[row as usize].vertex;
        self.volumes[vertex].as_deref().is_some_and(VolumeState::has_open)
    }
}
