//! Which pairs have to be compared after edges came, and no others (\[ISRR19\] 4.3).

use pose::Se3;
use posegraph::{PoseGraph, Scope, Skeleton};
use probe::{EdgeId, VertexId};

use super::RelativeMap;
use super::pair::USUAL;
use crate::Map3dProbe;

impl RelativeMap {
    /// Edges were added at one vertex: only pairs whose shortest path they changed are compared. Returns
    /// that vertex.
    ///
    /// Seen from that vertex, the root, these are pairs of which at least one came nearer, and whose
    /// ways from the root part at the root itself: where two ways share their first edge, the path
    /// between the two does not pass the root, and no new edge is on it.
    pub(super) fn take_edges(
        &mut self,
        graph: &PoseGraph<Se3>,
        edges: &[EdgeId],
        probe: &mut dyn Map3dProbe,
    ) -> Option<VertexId> {
        let first = graph.edge(*edges.first()?);
        let shared =
            |v: VertexId| edges.iter().all(|&e| [graph.edge(e).a, graph.edge(e).b].contains(&v));
        let newer = first.a.max(first.b);
        let root = if shared(newer) { newer } else { first.a.min(first.b) };
        for &id in edges {
            let edge = graph.edge(id);
            self.book.learn(id, edge.kind);
            self.cover(edge.a.max(edge.b));
        }
        self.hear_of_drift(graph, root, edges);
        self.take_scope(root, &mut probe::Off);
        let before = std::mem::take(&mut self.scope);
        for &id in edges {
            self.skeleton.add_edge(id, graph.edge(id), &mut self.scratch);
        }
        self.scope_is_fresh = false;
        // A new vertex on one edge brings no two others nearer.
        let is_leaf =
            self.views_of(root).is_empty() && before.placed().len() == 1 && edges.len() == 1;
        self.take_scope(root, probe);
        if !is_leaf {
            self.compare_across(&before, probe);
        }
        Some(root)
    }

    /// Compares the pairs of which at least one is not as far from the root as it was in `before`,
    /// and whose ways part at the root.
    pub(super) fn compare_across(&mut self, before: &Scope<Se3>, probe: &mut dyn Map3dProbe) {
        let changed = Changed::new(before, &self.scope, &self.skeleton);
        let placed = self.placed_views();
        self.work.touched.clear();
        for of in &placed {
            if !self.views[of.view as usize].counts() {
                continue;
            }
            for against in &placed {
                if changed.is_path_of(of.row, against.row) {
                    self.compare_rows(of, against, &USUAL, probe);
                }
            }
        }
        self.measure_touched();
    }
}

/// Distances that differ by less are the same, metres.
const SAME_M: f64 = 1e-9;

/// Which paths between the rows of a scope were changed by new edges at its root.
struct Changed {
    /// The first measured edge on the way to each row; none at the root.
    first: Vec<Option<EdgeId>>,
    moved: Vec<bool>,
}

impl Changed {
    fn new(before: &Scope<Se3>, now: &Scope<Se3>, skeleton: &Skeleton<Se3>) -> Self {
        let mut old: Vec<(VertexId, f64)> =
            before.placed().iter().map(|row| (row.vertex, row.distance_m)).collect();
        old.sort_unstable_by_key(|row| row.0);
        let mut first: Vec<Option<EdgeId>> = Vec::with_capacity(now.placed().len());
        let mut moved: Vec<bool> = Vec::with_capacity(now.placed().len());
        for (i, row) in now.placed().iter().enumerate() {
            first.push(match row.parent {
                None => None,
                Some(0) => now.path_between(skeleton, 0, i).first().copied(),
                Some(parent) => first[parent as usize],
            });
            let was = old.binary_search_by_key(&row.vertex, |o| o.0).ok().map(|k| old[k].1);
            moved.push(was.is_none_or(|was| (was - row.distance_m).abs() > SAME_M));
        }
        Self { first, moved }
    }

    /// Whether the path between two rows leads through the root and is new.
    fn is_path_of(&self, a: u32, b: u32) -> bool {
        let (a, b) = (a as usize, b as usize);
        a != b && self.first[a] != self.first[b] && (self.moved[a] || self.moved[b])
    }
}
