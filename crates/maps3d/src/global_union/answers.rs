//! What others ask of the map ([`Map3d`]), by the stages that answer.

use pose::Se3;
use posegraph::{Manifold, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use solid::Point3;

use super::ask::{clearance, in_sight, knows};
use super::view::View;
use super::volumes::Volumes;
use super::ways::{Wanted, to_frontier};
use super::{UnionEvent, UnionMap};
use crate::events::Relay;
use crate::relative::LocalVolume;
use crate::{
    FlightClearance, FlightRoute, FrontierPatch, Hovering, Known, Look, Map3d, Map3dProbe,
    MapTally, MapWork, Maps3dError, polyhedron_with,
};

impl Map3d for UnionMap {
    fn kind(&self) -> &'static str {
        if self.params.correction.is_some() { "global_union_corrected" } else { "global_union" }
    }

    /// Places new vertices; with a correction optimises where a place was recognised, and unites all views
    /// again where that moved them.
    fn edges_added(
        &mut self,
        graph: &PoseGraph<Se3>,
        edges: &[EdgeId],
        probe: &mut dyn Map3dProbe,
    ) {
        let places = self.poses.extend(graph, edges);
        if let Some(correction) = self.params.correction
            && places > 0
            && self.poses.correct(graph, &correction, places, probe)
        {
            self.counts.corrections += 1;
            self.follow(probe);
        }
    }

    fn edge_withdrawn(
        &mut self,
        graph: &PoseGraph<Se3>,
        _edge: EdgeId,
        probe: &mut dyn Map3dProbe,
    ) {
        if let Some(correction) = self.params.correction
            && self.poses.correct(graph, &correction, 0, probe)
        {
            self.counts.corrections += 1;
            self.follow(probe);
        }
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se3], probe: &mut dyn Map3dProbe) {
        self.poses.set(map_from_vertex);
        self.follow(probe);
    }

    fn looked(&mut self, look: &Look<'_>, probe: &mut dyn Map3dProbe) -> Result<(), Maps3dError> {
        if !look.vertex_from_camera.is_finite() {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        let options = self.params.view_through(&look.image.camera);
        let made = polyhedron_with(look.image, &options, &mut Relay(&mut *probe))?;
        self.poses.cover(look.vertex);
        let map_from_camera = self.poses.of(look.vertex) * look.vertex_from_camera;
        let view = View {
            vertex: look.vertex,
            vertex_from_camera: look.vertex_from_camera,
            // Without it, as for a view of very many vertices, it closes nothing along its walls.
            volume: LocalVolume::new(&made).ok(),
            in_camera: made.polyhedron,
            map_from_camera,
            aside: false,
        };
        if !view.stays_itself() {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        self.views.push(view);
        self.volumes = None;
        self.unite_one(self.views.len() - 1, probe);
        self.sort(probe);
        self.give_up_in_vain(self.views.len() - 1, probe);
        Ok(())
    }

    fn tally(&self) -> MapTally {
        let frontier = &self.frontier;
        MapTally {
            open_m2: frontier.open_m2(),
            sliver_m2: frontier.sliver_m2,
            largest_sliver_m2: frontier.largest_sliver_m2,
            given_up_m2: frontier.given_up_m2,
            patches: frontier.patches.len(),
            faces: self.surfaces().iter().map(|surface| surface.mesh.faces().len()).sum(),
            volumes: self.views.len(),
        }
    }

    /// What a straight line through free space leads to; the rest is for [`route`](Self::route).
    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        let map_from_body = self.map_from_body(hovering);
        let from = Point3::from(map_from_body.translation);
        let reach_m = self.params.reach_m;
        *out = in_sight(&self.surfaces(), &self.frontier.patches, &from, reach_m);
        let body_from_map = map_from_body.inverse();
        for patch in out {
            patch.owner = hovering.vertex;
            for point in &mut patch.points {
                point.in_body = body_from_map.transform(&point.in_body);
                point.normal_in_body = body_from_map.rotation * point.normal_in_body;
            }
        }
    }

    fn frontier_at(&self, _vertex: VertexId) -> f64 {
        self.frontier.open_m2()
    }

    fn route(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute> {
        self.route_with(hovering, clearance_m, comes_now, &mut Off)
    }

    fn route_with(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        _comes_now: &dyn Fn(VertexId) -> bool,
        probe: &mut dyn Map3dProbe,
    ) -> Option<FlightRoute> {
        if self.frontier.patches.is_empty() {
            return None;
        }
        self.fill(probe);
        let map_from_body = self.map_from_body(hovering);
        let from = Point3::from(map_from_body.translation);
        let given_up = self.given_up.in_map(&self.poses);
        let mut volumes = self.volumes.take()?;
        let surfaces = self.surfaces();
        let wanted = Wanted {
            surfaces: &surfaces,
            faces: &self.frontier.faces,
            given_up: &given_up,
            clearance_m,
            stop_short_m: self.params.stop_short_m,
        };
        let found = to_frontier(&mut volumes, &from, &wanted, &mut Relay(&mut *probe));
        self.volumes = Some(volumes);
        if let Some((plan, given)) = found {
            self.counts.ways += 1;
            self.work.paths_m += plan.cost_m;
            self.work.shortened_m += plan.path_m;
            probe.emit(UnionEvent::Planned { plan: &plan, given: &given });
            let body_from_map = map_from_body.inverse();
            let points = given.iter().map(|point| body_from_map.transform(point));
            return Some(FlightRoute::Fly(points.collect()));
        }
        self.counts.no_ways += 1;
        let patches = std::mem::take(&mut self.frontier.patches);
        for point in patches.iter().flat_map(|patch| &patch.points) {
            // A cube's pieces are no farther from its point than its diagonal.
            let radius_m = 3.0_f64.sqrt() * self.params.point_m;
            self.give_up_in_map(hovering.vertex, point.in_body, radius_m, true, probe);
        }
        self.sort(probe);
        None
    }

    fn clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3,
        leaving_m: f64,
    ) -> FlightClearance {
        let map_from_body = self.map_from_body(hovering);
        let from = Point3::from(map_from_body.translation);
        let to = map_from_body.transform(to_in_body);
        clearance(&self.surfaces(), &from, &to, leaving_m)
    }

    /// Frontier belongs to no vertex: what is given up is given up for all.
    fn give_up(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3],
        radius_m: f64,
        _everywhere: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        for place_in_body in places_in_body {
            let place = self.map_from_body(hovering).transform(place_in_body);
            self.give_up_in_map(hovering.vertex, place, radius_m, false, probe);
        }
        self.sort(probe);
    }

    fn knows(&self, hovering: &Hovering, point_in_body: &Point3) -> Known {
        let point = self.map_from_body(hovering).transform(point_in_body);
        knows(&self.surfaces(), &point, self.params.solid_m)
    }

    fn work(&self) -> MapWork {
        MapWork {
            corrections: self.counts.rebuilds,
            refused: self.counts.refused + self.counts.refused_fillings,
            paths: self.counts.ways,
            ..self.work
        }
    }

    fn bytes(&self) -> usize {
        let views: usize = self.views.iter().map(View::heap_bytes).sum();
        let surfaces: usize = self.surfaces().iter().map(|surface| surface.heap_bytes()).sum();
        size_of::<Self>()
            + views
            + size_of_val(&self.views[..])
            + surfaces
            + self.poses.heap_bytes()
            + self.frontier.heap_bytes()
            + self.given_up.heap_bytes()
            + self.in_vain.heap_bytes()
            + self.volumes.as_ref().map_or(0, Volumes::heap_bytes)
    }
}
