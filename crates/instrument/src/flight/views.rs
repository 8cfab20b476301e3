//! The views of the relative map, laid out around the vertex of the last change.

use std::collections::{BTreeMap, BTreeSet};

use geometry::Point3;
use maps3d::relative::{Cause, ConsolidationEvent, RelativeMap, ViewState};
use pose::Se3;
use probe::VertexId;
use solid::mesh::triangulate_facet;

use super::ink::{Faces, Ink, lines, placed};
use super::planner;
use crate::{Family, palette};

/// Faces of one view that were closed in a row by another: there are hundreds, and they are told together.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosedFaces {
    view: u32,
    by: u32,
    cause: Cause,
    faces: usize,
    closed_m2: f64,
    edges: usize,
}

impl ClosedFaces {
    /// What one event says; `None` for events of other kinds.
    pub(super) fn of(event: &ConsolidationEvent<'_>) -> Option<Self> {
        let ConsolidationEvent::Closed { view, state, face, before, after, cause, by, path } =
            event
        else {
            return None;
        };
        let closed_m2 = state.grid(*face).area_m2() * (before.share() - after.share());
        Some(Self { view: *view, by: *by, cause: *cause, faces: 1, closed_m2, edges: path.len() })
    }

    /// Adds what came after; false where it belongs to another pair of views.
    pub(super) fn join(&mut self, next: &Self) -> bool {
        let is_same = (self.view, self.by, self.cause) == (next.view, next.by, next.cause);
        if is_same {
            self.faces += next.faces;
            self.closed_m2 += next.closed_m2;
        }
        is_same
    }

    pub(super) fn line(&self) -> String {
        let Self { view, by, cause, faces, closed_m2, edges } = self;
        format!(
            "{closed_m2:.3} m² of {faces} faces of view {view}: {cause:?}, by view {by} over {edges} edges"
        )
    }
}

/// So many views are drawn, the nearest along the graph first: what is far away hides what is near.
const MOST_DRAWN: usize = 24;

/// What is drawn under `belief/views/`.
#[derive(Default)]
pub(super) struct Views {
    /// Views whose solid faces are in the recording.
    known: BTreeSet<u32>,
    /// Views whose open frontier changed since it was drawn.
    stale: BTreeSet<u32>,
    /// Views that are laid out, each at its entity.
    shown: BTreeSet<u32>,
    /// Vertices of the last scope in the frame of its root.
    scope: BTreeMap<VertexId, Se3>,
}

impl Views {
    /// Notes what changed.
    pub(super) fn note(&mut self, event: &ConsolidationEvent<'_>) {
        match event {
            ConsolidationEvent::ViewAdded { view, .. }
            | ConsolidationEvent::Closed { view, .. }
            | ConsolidationEvent::Reopened { view, .. } => drop(self.stale.insert(*view)),
            // Which of the views near by lost frontier is not told: all that are drawn.
            ConsolidationEvent::GivenUp { .. } => self.stale.extend(self.shown.iter().copied()),
            _ => {}
        }
    }

    /// A vertex of the last scope in the frame in which the belief is drawn.
    pub(super) fn root_from_vertex(&self, vertex: VertexId) -> Option<Se3> {
        self.scope.get(&vertex).copied()
    }

    /// How many views are in the last scope.
    pub(super) fn in_scope(&self) -> usize {
        self.shown.len()
    }

    /// Draws the views nearest to the root of the last scope.
    pub(super) fn settle(&mut self, ink: &mut Ink, map: &RelativeMap) {
        self.scope.clear();
        let mut near: Vec<(f64, u32, Se3)> = Vec::new();
        for row in map.scope().placed() {
            self.scope.insert(row.vertex, row.root_from_vertex);
            near.extend(map.views_of(row.vertex).iter().map(|&view| {
                let state = &map.views()[view as usize];
                (row.distance_m, view, row.root_from_vertex * state.vertex_from_camera)
            }));
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(MOST_DRAWN);
        let now: BTreeSet<u32> = near.iter().map(|(_, view, _)| *view).collect();
        for gone in self.shown.difference(&now) {
            // Drawn as a point, which is nothing: its faces stay for when it comes back.
            let nowhere = placed(&Se3::identity()).with_scale(1e-6);
            ink.draw(&entity(*gone), &nowhere);
        }
        for (_, view, root_from_camera) in &near {
            let state = &map.views()[*view as usize];
            let entity = entity(*view);
            ink.draw(&entity, &placed(root_from_camera));
            if self.known.insert(*view) {
                ink.draw(&format!("{entity}/solid"), &solid(state).mesh());
            }
            if self.stale.remove(view) {
                let (faces, outlines) = open(state);
                ink.draw(&format!("{entity}/open"), &faces.mesh());
                ink.draw(
                    &format!("{entity}/open/outline"),
                    &lines(&outlines, palette::FRONTIER, 0.8),
                );
            }
        }
        self.shown = now;
    }
}

fn entity(view: u32) -> String {
    format!("belief/views/{view}")
}

/// The obstacle faces of a view, seen from inside.
fn solid(state: &ViewState) -> Faces {
    let mut faces = Faces::default();
    for face in state.volume.obstacles() {
        let [a, b, c] = state.volume.points(face);
        faces.push([&a, &c, &b], palette::SURFACE);
    }
    faces
}

/// What of the frontier of a view is open, and the outlines of faces that are open in part.
fn open(state: &ViewState) -> (Faces, Vec<Vec<Point3>>) {
    let (mut faces, mut outlines) = (Faces::default(), Vec::new());
    let counts: BTreeSet<u16> =
        state.parts.iter().flat_map(|part| part.pieces.iter().map(|piece| piece.face)).collect();
    for (index, open) in state.open.iter().enumerate() {
        if open.is_closed() {
            continue;
        }
        let is_counted = u16::try_from(index).is_ok_and(|index| counts.contains(&index));
        let colour = if is_counted { palette::FRONTIER } else { palette::IGNORED };
        let grid = state.grid(index);
        if open.is_whole() {
            let [a, b, c] = grid.corners();
            faces.push([&a, &c, &b], colour);
            continue;
        }
        for ring in open.rings().rings() {
            let points: Vec<Point3> =
                ring.iter().map(|&[x, y]| grid.point([x.into(), y.into()])).collect();
            let all: Vec<u32> = (0..points.len() as u32).collect();
            for [a, b, c] in triangulate_facet(&points, &[all], &[]).unwrap_or_default() {
                let at = |corner: u32| &points[corner as usize];
                faces.push([at(a), at(c), at(b)], colour);
            }
            outlines.push(points.iter().chain(points.first()).copied().collect());
        }
    }
    (faces, outlines)
}

/// What an event is about.
pub(super) fn family_of(event: &ConsolidationEvent<'_>) -> Family {
    match event {
        ConsolidationEvent::Fanned { .. } | ConsolidationEvent::Planned { .. } => Family::Planner,
        _ => Family::Consolidation,
    }
}

/// One line about an event of consolidation.
pub(super) fn line(event: &ConsolidationEvent<'_>) -> String {
    match event {
        ConsolidationEvent::ViewAdded { view, state } => format!(
            "view {view} at vertex {}: {} faces, {} of them frontier",
            state.vertex,
            state.volume.face_count(),
            state.open.len()
        ),
        ConsolidationEvent::ScopeTaken { scope, .. } => {
            format!("{} vertices", scope.placed().len())
        }
        ConsolidationEvent::PairCompared { view, against, cause, closed_m2, .. } => {
            format!("view {view} against {against}: {closed_m2:.3} m², {cause:?}")
        }
        ConsolidationEvent::Closed { .. } => {
            ClosedFaces::of(event).map_or_else(String::new, |closed| closed.line())
        }
        ConsolidationEvent::Reopened { view, face, before, after, edge, .. } => format!(
            "face {face} of view {view}: {:.1} % open before, {:.1} % now; edge {edge} is withdrawn",
            100.0 * before.share(),
            100.0 * after.share()
        ),
        ConsolidationEvent::GivenUp { vertex, radius_m, .. } => {
            format!("within {radius_m:.2} m of a place of vertex {vertex}")
        }
        ConsolidationEvent::Retired { view } | ConsolidationEvent::Restored { view } => {
            format!("view {view}")
        }
        ConsolidationEvent::Fanned { volumes, from, to, .. } => {
            format!("{} views as volumes, {:.2} m apart", volumes.len(), (to - from).norm())
        }
        ConsolidationEvent::Planned { plan, given, .. } => {
            format!("{}, {} points given", planner::lengths(plan), given.len())
        }
        ConsolidationEvent::Settled { map, vertex } => {
            format!(
                "{} views, {} compared with others; vertex {vertex}",
                map.views().len(),
                map.active_count()
            )
        }
    }
}
