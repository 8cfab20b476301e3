//! A place edge is taken back: exactly what relied on it opens again.

use std::collections::BTreeSet;

use pose::Se3;
use posegraph::{PoseGraph, RelativePose};
use probe::{EdgeId, VertexId};

use super::RelativeMap;
use super::book::ClosingId;
use super::events::ConsolidationEvent;
use super::ledger::OpenPart;
use super::map::empty_skeleton;
use super::pair::{Pair, USUAL, shape_of};
use crate::Map3dProbe;

impl RelativeMap {
    /// Steps: every closing whose path walks the edge is struck out; each face that it took part of is
    /// opened, and closed again by what else was written down for it, each along the path that it was
    /// closed along; the skeleton is built anew without the edge; views that were opened are held
    /// against their scope.
    ///
    /// Cost: linear in the size of the graph, and for the faces that are opened, that of closing them.
    pub(super) fn withdraw(
        &mut self,
        graph: &PoseGraph<Se3>,
        edge: EdgeId,
        probe: &mut dyn Map3dProbe,
    ) {
        let relying: BTreeSet<ClosingId> = self.book.relying_on(edge).iter().copied().collect();
        let opened: BTreeSet<u32> = relying.iter().map(|&id| self.book.closing(id).view).collect();
        for &view in &opened {
            self.reopen(graph, view, edge, &relying, probe);
        }
        self.restore_all(probe);
        self.rebuild_skeleton(graph);
        self.hear_again(edge, probe);
        let vertices: BTreeSet<VertexId> =
            opened.iter().map(|&view| self.views[view as usize].vertex).collect();
        for vertex in vertices {
            self.take_scope(vertex, probe);
            let placed = self.placed_views();
            self.work.touched.clear();
            for of in placed.iter().filter(|of| of.row == 0 && opened.contains(&of.view)) {
                for against in &placed {
                    self.compare_rows(of, against, &USUAL, probe);
                }
            }
            self.measure_touched();
        }
    }

    /// Strikes closings of a view out, and computes what is open of the faces that they took part of.
    fn reopen(
        &mut self,
        graph: &PoseGraph<Se3>,
        view: u32,
        edge: EdgeId,
        relying: &BTreeSet<ClosingId>,
        probe: &mut dyn Map3dProbe,
    ) {
        let state = &mut self.views[view as usize];
        let struck = state.closings.iter().filter(|(_, id)| relying.contains(id));
        let faces: BTreeSet<u16> = struck.map(|&(face, _)| face).collect();
        state.closings.retain(|(_, id)| !relying.contains(id));
        let before: Vec<(u16, OpenPart)> = faces
            .iter()
            .map(|&face| (face, std::mem::take(&mut state.open[face as usize])))
            .collect();
        let mut rest: Vec<(ClosingId, u16)> = state
            .closings
            .iter()
            .filter(|(face, _)| faces.contains(face))
            .map(|&(f, id)| (id, f))
            .collect();
        rest.sort_unstable();
        let mut work = std::mem::take(&mut self.work);
        for of_one in rest.chunk_by(|a, b| a.0 == b.0) {
            let closing = *self.book.closing(of_one[0].0);
            let (state, other) = (&self.views[view as usize], &self.views[closing.by as usize]);
            let walked = walk(graph, state.vertex, self.book.edges(closing.path));
            let vertex_from_other = walked * other.vertex_from_camera;
            let camera_from_against = state.vertex_from_camera.inverse_mul(&vertex_from_other);
            let pair = Pair { view, against: closing.by, camera_from_against, odometry_m: 0.0 };
            let wanted = |face: usize| of_one.iter().any(|(_, f)| usize::from(*f) == face);
            let shape = shape_of(closing.cause, closing.behind_m, &self.params);
            work.close(state, &other.volume, &pair, (closing.cause, shape), wanted);
            for (face, after) in work.changed.drain(..) {
                self.views[view as usize].open[face] = after;
            }
        }
        self.work = work;
        self.views[view as usize].measure(self.params.sliver_m2);
        for (face, before) in &before {
            let state = &self.views[view as usize];
            let face = usize::from(*face);
            let after = &state.open[face];
            if after != before {
                probe.emit(ConsolidationEvent::Reopened { view, state, face, before, after, edge });
            }
        }
    }

    /// What was given up, and told to views along an edge, is told along other ways.
    fn hear_again(&mut self, edge: EdgeId, probe: &mut dyn Map3dProbe) {
        let mut relying: Vec<(u32, u32)> = Vec::new();
        for (view, state) in self.views.iter_mut().enumerate() {
            state.given_up.retain(|ball| {
                let over = ball.over.filter(|(path, _)| self.book.edges(*path).contains(&edge));
                relying.extend(over.map(|(_, number)| (view as u32, number)));
                over.is_none()
            });
        }
        for of_one in relying.chunk_by(|a, b| a.0 == b.0) {
            let view = of_one[0].0;
            self.take_scope(self.views[view as usize].vertex, probe);
            for &(_, number) in of_one {
                self.hear_of(view, number);
            }
            self.views[view as usize].measure(self.params.sliver_m2);
        }
    }

    /// No view is retired any more.
    fn restore_all(&mut self, probe: &mut dyn Map3dProbe) {
        for (view, state) in self.views.iter_mut().enumerate() {
            if std::mem::take(&mut state.retired) {
                probe.emit(ConsolidationEvent::Restored { view: view as u32 });
            }
        }
    }

    /// The skeleton from the record, without what was withdrawn.
    fn rebuild_skeleton(&mut self, graph: &PoseGraph<Se3>) {
        let mut skeleton = empty_skeleton(&self.params);
        if let Some(last) = self.views_of.ids().next_back() {
            skeleton.cover(last);
        }
        for (id, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
            skeleton.cover(edge.a.max(edge.b));
            skeleton.add_edge(id, edge, &mut self.scratch);
        }
        self.skeleton = skeleton;
        self.scope_is_fresh = false;
    }
}

/// The frame at the end of a path in the frame of the vertex where it starts.
fn walk(graph: &PoseGraph<Se3>, from: VertexId, path: &[EdgeId]) -> Se3 {
    let start = (from, <Se3 as RelativePose>::identity());
    let step = |(at, from_at): (VertexId, Se3), edge: &EdgeId| {
        let (next, at_from_next) = graph.edge(*edge).from_end(at);
        (next, from_at * at_from_next)
    };
    path.iter().fold(start, step).1
}
