//! Which pairs have to be compared after a change, and no others (\[ISRR19\] 4.3).

use posegraph::{PoseGraph, Scope, Skeleton};
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
        self.ask_retired_about(root, probe);
    }

    /// Edges were added at one vertex: only pairs whose shortest path they changed are compared.
    ///
    /// Seen from that vertex, the root, these are pairs of which at least one came nearer, and whose
    /// ways from the root part at the root itself: where two ways share their first edge, the path
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
        let root = if shared(newer) { newer } else { first.a.min(first.b) };
        for &id in edges {
            let edge = graph.edge(id);
            self.book.learn(id, edge.kind);
            self.cover(edge.a.max(edge.b));
        }
        let hidden = self.skeleton.restore(root, &mut self.scratch);
        self.scope_is_fresh &= !hidden;
        self.take_scope(root, &mut probe::Off);
        let before = std::mem::take(&mut self.scope);
        // A new vertex on one edge brings no two others nearer.
        let is_leaf = self.volume(root).is_none() && before.placed().len() == 1 && edges.len() == 1;
        let before_in_full = self.full_scope_if(root, !is_leaf);
        for &id in edges {
            self.skeleton.add_edge(id, graph.edge(id), &mut self.scratch);
            self.full.add_edge(id, graph.edge(id), &mut self.scratch);
        }
        self.scope_is_fresh = false;
        self.take_scope(root, probe);
        match before_in_full {
            Some(before) => self.compare_across_in_full(root, &before, probe),
            None => self.compare_across(&before, probe),
        }
        if hidden && self.volume(root).is_some_and(|state| state.retired) {
            self.skeleton.retire(root, &mut self.scratch);
            self.scope_is_fresh = false;
        }
    }

    /// Compares the pairs of which at least one is not as far from the root as it was in `before`,
    /// and whose ways part at the root.
    pub(super) fn compare_across(&mut self, before: &Scope, probe: &mut dyn MapProbe) {
        let changed = Changed::new(before, &self.scope, self.walked());
        let rows = 0..self.scope.placed().len() as u32;
        let active: Vec<u32> = rows.filter(|&row| self.is_active(row)).collect();
        let mut pairs = std::mem::take(&mut self.work.pairs);
        pairs.clear();
        for &a in active.iter().filter(|&&a| self.row_has_open(a)) {
            for &b in &active {
                if changed.is_path_of(a, b) && self.may_touch(a, b) {
                    pairs.push((a, b));
                }
            }
        }
        self.work.pairs = pairs;
        self.consolidate(probe);
    }

    /// Drops the pairs whose way through the scope at hand may not decide, because another is clearly
    /// shorter, unless more certainty is asked of it than at a last look.
    ///
    /// Where both are recognised from a new vertex that is off the way between them, their poses by way
    /// of it are worse than those that they were held against each other with.
    pub(super) fn drop_longer_ways(&mut self, pairs: &mut Vec<(u32, u32)>) {
        // Where more is asked of placement than at a last look, that decides: the longer way may have
        // less odometry, and be the surer one.
        if self.params.certainty.sigmas > self.params.last_look_sigmas {
            return;
        }
        let rows = self.scope.placed();
        let walked = if self.scope_is_full { &self.full } else { &self.skeleton };
        let mut kept: Vec<(u32, u32)> = Vec::with_capacity(pairs.len());
        let (mut others, mut distances_m) = (Vec::new(), Vec::new());
        for of_target in pairs.chunk_by(|one, next| one.0 == next.0) {
            let target = rows[of_target[0].0 as usize];
            let limit_m = |pair: &(u32, u32)| {
                (target.distance_m + rows[pair.1 as usize].distance_m) / NEARLY_SHORTEST
            };
            // The ways from and to the root are the shortest that there are.
            if of_target.iter().all(|pair| pair.0 == 0 || pair.1 == 0) {
                kept.extend_from_slice(of_target);
                continue;
            }
            others.clear();
            others.extend(of_target.iter().map(|pair| rows[pair.1 as usize].vertex));
            let most_m = of_target.iter().map(limit_m).fold(0.0, f64::max);
            let scratch = &mut self.scratch;
            scratch.distances_within(walked, target.vertex, &others, most_m, &mut distances_m);
            let decide = of_target.iter().zip(&distances_m).filter(|(pair, distance_m)| {
                pair.1 == 0 || distance_m.is_none_or(|distance_m| distance_m > limit_m(pair))
            });
            kept.extend(decide.map(|(pair, _)| *pair));
        }
        *pairs = kept;
    }

    /// Whether the open frontier of row `a` comes near the volume of row `b` at all.
    pub(super) fn may_touch(&self, a: u32, b: u32) -> bool {
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

    pub(super) fn is_active(&self, row: u32) -> bool {
        let vertex = self.scope.placed()[row as usize].vertex;
        self.volumes[vertex].as_deref().is_some_and(|state| !state.retired)
    }

    fn row_has_open(&self, row: u32) -> bool {
        let vertex = self.scope.placed()[row as usize].vertex;
        self.volumes[vertex].as_deref().is_some_and(VolumeState::has_open)
    }
}

/// A way between a pair that is so many times as long as the shortest is as good.
const NEARLY_SHORTEST: f64 = 1.2;

/// Distances that differ by less are the same, metres: contraction adds lengths in another order.
const SAME_M: f64 = 1e-9;

/// Which paths between the rows of a scope were changed by new edges at its root.
pub(super) struct Changed {
    /// The first measured edge on the way to each row; none at the root.
    first: Vec<Option<EdgeId>>,
    moved: Vec<bool>,
}

impl Changed {
    pub(super) fn new(before: &Scope, now: &Scope, skeleton: &Skeleton) -> Self {
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
    pub(super) fn is_path_of(&self, a: u32, b: u32) -> bool {
        let (a, b) = (a as usize, b as usize);
        a != b && self.first[a] != self.first[b] && (self.moved[a] || self.moved[b])
    }
}
