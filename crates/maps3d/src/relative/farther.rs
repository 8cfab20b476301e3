//! Frontier that was put off, or would be given up, is held against views that are placed along the ways with the least
//! odometry.

use nalgebra::Point3;
use posegraph::Scope;
use probe::{Probe, VertexId};

use super::RelativeMap;
use super::book::Cause;
use super::events::ConsolidationEvent;
use super::insert::PlacedView;
use super::pair::USUAL;
use super::volume::Shape;
use crate::{Hovering, Map3dProbe, Sights};

/// How much more odometry there may be before frontier is given up, as a multiple of the consolidation radius.
const FARTHER: f64 = 2.0;

/// What a metre of a place edge counts as here: placement goes where there is the least odometry.
const PLACE_WEIGHT: f64 = 0.01;

/// A point at this share of its distance lies before everything.
const NEAR_SHARE: f64 = 1e-3;

/// Within so many pixels of the border of its image a view does not say what it saw.
const BORDER_PX: f64 = 1.0;

/// Why frontier is closed that would be given up.
const CAUSES: [Cause; 3] = [Cause::Inside, Cause::Wall, Cause::Behind];

impl RelativeMap {
    /// Compares the frontier of the views of a vertex with all views between which and it there is no more odometry
    /// than the consolidation radius, each placed along the way with the least of it.
    ///
    /// A short way may drift more than a long one: only its odometry does, and place edges are many where the robot
    /// was often. What is seen at the far end of an image is off by metres after one hop. And what was seen from far
    /// round, through a gap that the robot does not fit through, may lie in views that are near in space and far along
    /// the graph. Such scopes reach far, so this is not done for every look; those that drift least come first.
    ///
    /// `is_last`: what is left would be given up. Then what lies up to twice as far behind walls as is closed otherwise
    /// is closed too: reduced surfaces of far views cut through pillars and furniture, where nobody can ever look. Whether
    /// views contradict each other is not asked any more: what is left was looked at from wherever it can be, or from
    /// nowhere.
    pub(super) fn compare_with_farther(
        &mut self,
        vertex: VertexId,
        is_last: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        let causes = if is_last { &CAUSES[..] } else { &USUAL };
        self.cover(vertex);
        let least = self.skeleton.reweighed(PLACE_WEIGHT);
        let usual = std::mem::replace(&mut self.skeleton, least);
        let share = if is_last { FARTHER } else { 1.0 };
        let radius_m = share * self.params.consolidation_radius_m;
        self.scratch.place(&self.skeleton, vertex, radius_m, &mut self.scope);
        // Nobody else asks for a scope of this radius.
        self.scope_is_fresh = false;
        if Probe::<ConsolidationEvent<'_>>::on(probe) {
            let (scope, skeleton) = (&self.scope, &self.skeleton);
            probe.emit(ConsolidationEvent::ScopeTaken { scope, skeleton });
        }
        // A view that was in doubt may have been retired because it closed nothing.
        let placed = self.all_placed_views();
        let own: Vec<PlacedView> = placed.iter().filter(|own| own.row == 0).copied().collect();
        self.work.touched.clear();
        for of in &own {
            for against in placed.iter().filter(|against| against.view != of.view) {
                if self.views[of.view as usize].counts() {
                    self.compare_rows(of, against, causes, probe);
                }
            }
        }
        self.measure_touched();
        self.skeleton = usual;
    }

    /// What views of other vertices that are placed in this way say of a point; retired ones as well.
    pub(super) fn sights(&mut self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Sights {
        self.cover(hovering.vertex);
        let least = self.skeleton.reweighed(PLACE_WEIGHT);
        let mut scope = Scope::default();
        let radius_m = FARTHER * self.params.consolidation_radius_m;
        self.scratch.place(&least, hovering.vertex, radius_m, &mut scope);
        let in_root = hovering.vertex_from_body.transform(point_in_body);
        let mut sights = Sights::default();
        for row in scope.placed().iter().skip(1) {
            let in_vertex = row.root_from_vertex.inverse_transform(&in_root);
            for &view in self.views_of(row.vertex) {
                let state = &self.views[view as usize];
                let point = state.vertex_from_camera.inverse_transform(&in_vertex);
                if !state.volume.shows(&point, BORDER_PX) {
                    continue;
                }
                // Right before the camera every direction of the image is free: that names the face.
                let ends_at = state.volume.holds(&(point * NEAR_SHARE), Shape::PLAIN);
                let is_frontier = ends_at
                    .is_some_and(|face| state.volume.frontier().binary_search(&face).is_ok());
                let of = if state.volume.contains(&point) {
                    &mut sights.free
                } else if ends_at.is_some() && !is_frontier {
                    &mut sights.solid
                } else {
                    &mut sights.unknown
                };
                *of += 1;
            }
        }
        sights
    }
}
