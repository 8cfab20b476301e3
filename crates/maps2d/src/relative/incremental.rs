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
            pairs.push((0, row));
            if row != 0 && self.row_has_open(row) {
                pairs.push((row, 0));
            }
        }
        self.work.pairs = pairs;
        self.consolidate(probe);
    }

    /// An edge was added: only pairs whose shortest path it changed are compared.
    ///
    /// Seen from the newer end, these are the pairs of a vertex that came nearer with one that did
    /// not: two that both came nearer share the new edge on their ways from the root, so it is not
    /// on the path between them.
    pub(super) fn take_edge(&mut self, graph: &PoseGraph, id: EdgeId, probe: &mut dyn MapProbe) {
        let edge = *graph.edge(id);
        self.book.learn(id, edge.kind);
        self.cover(edge.a.max(edge.b));
        let root = self.skeleton.resolve(edge.a.max(edge.b)).0;
        let is_leaf = self.skeleton.links(root).is_empty();
        if !is_leaf {
            self.take_scope(root, &mut probe::Off);
        }
        let Some(_) = self.skeleton.add_edge(id, &edge) else { return };
        self.scope_is_fresh = false;
        if is_leaf {
            // The first edge of a vertex: every pair that it brings has the vertex itself in it.
            let has_volume = self.volumes[root].is_some();
            if has_volume {
                self.compare_with_scope(root, probe);
            }
            return;
        }
        let before = std::mem::take(&mut self.scope);
        self.take_scope(root, probe);
        self.compare_across(&before, probe);
    }

    /// Compares every vertex whose distance from the root is not what it was in `before` with every
    /// vertex whose distance is.
    pub(super) fn compare_across(&mut self, before: &Scope, probe: &mut dyn MapProbe) {
        let mut old: Vec<(VertexId, f64)> =
            before.placed().iter().map(|row| (row.vertex, row.distance_m)).collect();
        old.sort_unstable_by_key(|row| row.0);
        let (mut moved, mut stayed): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
        for (i, row) in self.scope.placed().iter().enumerate() {
            let i = i as u32;
            if !self.is_active(i) {
                continue;
            }
            let was = old.binary_search_by_key(&row.vertex, |o| o.0).ok().map(|k| old[k].1);
            if was == Some(row.distance_m) { stayed.push(i) } else { moved.push(i) }
        }
        let mut pairs = std::mem::take(&mut self.work.pairs);
        pairs.clear();
        for &a in &moved {
            for &b in &stayed {
                if self.row_has_open(a) {
                    pairs.push((a, b));
                }
                if self.row_has_open(b) {
                    pairs.push((b, a));
                }
            }
        }
        self.work.pairs = pairs;
        self.consolidate(probe);
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
