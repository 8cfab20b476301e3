//! A place edge is taken back: exactly what relied on it opens again.

use std::collections::BTreeSet;

use geometry::planar::Interval;
use posegraph::{PoseGraph, Scope, Skeleton};
use probe::{EdgeId, PathId, VertexId};

use super::{Closing, ConsolidationEvent, RelativeMap, ReopenCause};
use crate::MapProbe;

impl RelativeMap {
    /// Steps: every closing whose path walks the edge is opened; the skeleton is built anew without
    /// the edge, volumes that lost closings are taken in again; and what other paths account for is
    /// closed again, by the volumes around each volume that was opened and around both ends of the
    /// edge.
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
        let before = ends.map(|end| self.scope_around(end));
        self.rebuild_skeleton(graph, probe);
        for &vertex in &reopened {
            let root = self.skeleton.resolve(vertex).0;
            self.compare_with_scope(root, probe);
        }
        for (end, before) in ends.into_iter().zip(before) {
            let root = self.skeleton.resolve(end).0;
            self.take_scope(root, probe);
            self.compare_across(&before, probe);
        }
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
        if any && state.retired {
            state.retired = false;
            probe.emit(ConsolidationEvent::Restored { volume: vertex });
        }
        if any {
            self.remeasure(vertex);
        }
        any
    }

    /// The skeleton from the record, with the volumes that are still retired contracted again.
    fn rebuild_skeleton(&mut self, graph: &PoseGraph, probe: &mut dyn MapProbe) {
        let mut skeleton = Skeleton::new(2.0 * self.params.consolidation_radius_m);
        if let Some(last) = self.volumes.ids().next_back() {
            skeleton.cover(last);
        }
        for (id, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
            skeleton.cover(edge.a.max(edge.b));
            skeleton.add_edge(id, edge);
        }
        for vertex in self.volumes.ids() {
            let Some(state) = self.volumes[vertex].as_deref_mut() else { continue };
            if state.retired && !skeleton.retire(vertex, &mut self.scratch) {
                state.retired = false;
                probe.emit(ConsolidationEvent::Restored { volume: vertex });
            }
        }
        self.skeleton = skeleton;
        self.scope_is_fresh = false;
    }

    fn scope_around(&mut self, vertex: VertexId) -> Scope {
        let root = self.skeleton.resolve(vertex).0;
        self.take_scope(root, &mut probe::Off);
        self.scope.clone()
    }
}
