//! A place edge is taken back: exactly what relied on it opens again.

use std::collections::BTreeSet;

use geometry::planar::Interval;
use posegraph::{PoseGraph, Scope};
use probe::{EdgeId, PathId, VertexId};

use super::map::empty_skeleton;
use super::{Closing, ConsolidationEvent, RelativeMap, ReopenCause};
use crate::MapProbe;

impl RelativeMap {
    /// Steps: every closing whose path walks the edge is opened; the skeleton is built anew without
    /// the edge, and without anything retired; what other paths account for is closed again, by the
    /// volumes around each volume that was opened and around both ends of the edge; and what was
    /// retired before and is still spent is retired again.
    ///
    /// Cost: linear in the size of the graph; withdrawals are rare.
    pub(super) fn withdraw(&mut self, graph: &PoseGraph, id: EdgeId, probe: &mut dyn MapProbe) {
        let relying = self.book.relying_on(id);
        let paths: BTreeSet<PathId> = relying.iter().map(|&(path, _)| path).collect();
        let opened: BTreeSet<VertexId> = relying.iter().map(|&(_, volume)| volume).collect();
        let mut reopened: BTreeSet<VertexId> = BTreeSet::new();
        for &vertex in &opened {
            if self.reopen(vertex, id, &paths, probe) {
                reopened.insert(vertex);
            }
        }
        let edge = *graph.edge(id);
        let ends = [edge.a, edge.b];
        self.skeleton = self.full.clone();
        let before = ends.map(|end| self.scope_around(end));
        let retired = self.take_all_in();
        self.rebuild_skeleton(graph);
        for &vertex in &reopened {
            self.compare_with_scope(vertex, probe);
        }
        for (end, before) in ends.into_iter().zip(before) {
            self.take_scope(end, probe);
            self.compare_across(&before, probe);
        }
        self.retire_again(&retired, probe);
    }

    /// Opens what relied on the paths; returns whether there was any.
    fn reopen(
        &mut self,
        vertex: VertexId,
        id: EdgeId,
        paths: &BTreeSet<PathId>,
        probe: &mut dyn MapProbe,
    ) -> bool {
        let Some(state) = self.volumes[vertex].as_deref_mut() else { return false };
        let mut any = false;
        let mut parts: Vec<Interval> = Vec::new();
        for (edge, ledger) in state.volume.frontier.iter().zip(&mut state.ledgers) {
            parts.clear();
            ledger.reopen(|closing: &Closing| paths.contains(&closing.path), &mut parts);
            for &span in &parts {
                any = true;
                probe.emit(ConsolidationEvent::Reopened {
                    volume: vertex,
                    edge,
                    span,
                    cause: ReopenCause::EdgeWithdrawn(id),
                });
            }
        }
        if any {
            self.remeasure(vertex);
        }
        any
    }

    /// No volume is retired any more; returns which were.
    fn take_all_in(&mut self) -> Vec<VertexId> {
        let mut retired: Vec<VertexId> = Vec::new();
        for vertex in self.volumes.ids() {
            if let Some(state) = self.volumes[vertex].as_deref_mut()
                && std::mem::take(&mut state.retired)
            {
                retired.push(vertex);
            }
        }
        retired
    }

    /// Volumes that were retired are so again, unless they are needed now.
    fn retire_again(&mut self, retired: &[VertexId], probe: &mut dyn MapProbe) {
        for &vertex in retired {
            let again = self.is_spent(vertex) && self.skeleton.retire(vertex, &mut self.scratch);
            match self.volumes[vertex].as_deref_mut() {
                Some(state) if again => state.retired = true,
                _ => probe.emit(ConsolidationEvent::Restored { volume: vertex }),
            }
        }
        self.scope_is_fresh = false;
    }

    /// The skeleton from the record, without the edge that was withdrawn.
    fn rebuild_skeleton(&mut self, graph: &PoseGraph) {
        let mut skeleton = empty_skeleton(&self.params);
        if let Some(last) = self.volumes.ids().next_back() {
            skeleton.cover(last);
        }
        for (id, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
            skeleton.cover(edge.a.max(edge.b));
            skeleton.add_edge(id, edge, &mut self.scratch);
        }
        self.full = skeleton.clone();
        self.skeleton = skeleton;
        self.scope_is_fresh = false;
    }

    fn scope_around(&mut self, vertex: VertexId) -> Scope {
        self.scope_is_fresh = false;
        self.take_scope(vertex, &mut probe::Off);
        self.scope.clone()
    }
}
