//! The maps of one flying robot, each with a stopwatch around it.

use std::time::Instant;

use geometry::Point3;
use maps3d::global_union::UnionMap;
use maps3d::relative::{RelativeMap, RelativeParams};
use maps3d::{
    FlightClearance, FlightRoute, FrontierPatch, Hovering, Known, Look, Map3d, Map3dProbe,
    MapTally, MapWork, Maps3dError, Sights, VoxelMap, VoxelParams,
};
use pose::Se3;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use worlds::CameraParams;

use super::stages::Stages;
use crate::config::Config;
use crate::run::{AtWork, TimedProbe};

/// The map of a kind, if the config builds it.
///
/// Maps are told how far the camera reads: where it read nothing, it read nothing up to there.
///
/// # Errors
/// Where its parameters do not go together.
pub(super) fn map_of(
    config: &Config,
    kind: &str,
) -> Result<Option<Box<dyn Map3d + Send>>, Maps3dError> {
    let Some(maps) = &config.map3d else { return Ok(None) };
    let far_m = CameraParams::from(&config.camera.clone().unwrap_or_default()).far_m;
    let made: Option<Box<dyn Map3d + Send>> = match kind {
        "relative" => match &maps.relative {
            Some(map) => {
                let mut params = RelativeParams::from(map);
                params.view.prepare.far_m = far_m;
                Some(Box::new(RelativeMap::new(params)?))
            }
            None => None,
        },
        "global_union" => match &maps.global_union {
            Some(map) => {
                let mut params = map.params(&config.odometry);
                params.view.prepare.far_m = far_m;
                Some(Box::new(UnionMap::new(params)?))
            }
            None => None,
        },
        "voxels" => match &maps.voxels {
            Some(map) => {
                let params = VoxelParams::from(map);
                let range_m = params.range_m.min(far_m);
                Some(Box::new(VoxelMap::new(VoxelParams { range_m, ..params })?))
            }
            None => None,
        },
        _ => None,
    };
    Ok(made)
}

/// A map that says when it is at work, and takes the time of it.
pub(super) struct Side {
    inner: Box<dyn Map3d + Send>,
    index: usize,
    at_work: AtWork,
    stages: Stages,
}

impl Side {
    pub(super) fn new(
        inner: Box<dyn Map3d + Send>,
        index: usize,
        at_work: &AtWork,
        stages: &Stages,
    ) -> Self {
        Self { inner, index, at_work: at_work.clone(), stages: stages.clone() }
    }

    fn timed<T>(&mut self, work: impl FnOnce(&mut dyn Map3d) -> T) -> T {
        self.at_work.timed(self.index, || work(self.inner.as_mut()))
    }

    /// As [`timed`](Self::timed), of work that is one stage.
    fn stage<T>(&mut self, name: &'static str, work: impl FnOnce(&mut dyn Map3d) -> T) -> T {
        let stages = self.stages.clone();
        self.timed(|map| stages.timed(name, || work(map)))
    }

    /// As [`timed`](Self::timed); a correction that comes of it is noted with its own time, without
    /// what listening took.
    fn correcting(
        &mut self,
        probe: &mut dyn Map3dProbe,
        work: impl FnOnce(&mut dyn Map3d, &mut dyn Map3dProbe),
    ) {
        let before = self.inner.work().corrections;
        let start = Instant::now();
        let at_work = self.at_work.clone();
        let mut heard = TimedProbe::new(probe, &at_work, 0);
        let stages = self.stages.clone();
        self.timed(|map| stages.by_events("graph", &mut heard, |heard| work(map, heard)));
        let spent = start.elapsed().saturating_sub(heard.spent);
        if self.inner.work().corrections > before {
            self.at_work.note_correction(self.index, spent);
        }
    }
}

impl Map3d for Side {
    fn kind(&self) -> &'static str {
        self.inner.kind()
    }

    fn edges_added(
        &mut self,
        graph: &PoseGraph<Se3>,
        edges: &[EdgeId],
        probe: &mut dyn Map3dProbe,
    ) {
        self.correcting(probe, |map, probe| map.edges_added(graph, edges, probe));
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph<Se3>, edge: EdgeId, probe: &mut dyn Map3dProbe) {
        self.correcting(probe, |map, probe| map.edge_withdrawn(graph, edge, probe));
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se3], probe: &mut dyn Map3dProbe) {
        self.correcting(probe, |map, probe| map.poses_reestimated(map_from_vertex, probe));
    }

    fn looked(&mut self, look: &Look<'_>, probe: &mut dyn Map3dProbe) -> Result<(), Maps3dError> {
        let start = Instant::now();
        let at_work = self.at_work.clone();
        let mut heard = TimedProbe::new(probe, &at_work, 0);
        let stages = self.stages.clone();
        // What is left when the view was made and united.
        let rest = if self.inner.is_by_vertex() { "consolidate" } else { "sort" };
        let taken =
            self.timed(|map| stages.by_events(rest, &mut heard, |heard| map.looked(look, heard)));
        self.at_work.note_look(self.index, start.elapsed().saturating_sub(heard.spent));
        taken
    }

    fn tally(&self) -> MapTally {
        self.inner.tally()
    }

    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        self.stage("frontiers", |map| map.frontiers(hovering, out));
    }

    fn is_by_vertex(&self) -> bool {
        self.inner.is_by_vertex()
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.inner.frontier_at(vertex)
    }

    fn route(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute> {
        self.stage("route", |map| map.route(hovering, clearance_m, comes_now))
    }

    fn route_with(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
        probe: &mut dyn Map3dProbe,
    ) -> Option<FlightRoute> {
        let stages = self.stages.clone();
        self.timed(|map| {
            stages.by_events("route", probe, |probe| {
                map.route_with(hovering, clearance_m, comes_now, probe)
            })
        })
    }

    fn clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3,
        leaving_m: f64,
    ) -> FlightClearance {
        self.stage("clearance", |map| map.clearance(hovering, to_in_body, leaving_m))
    }

    fn way_through_views(&mut self, hovering: &Hovering, radius_m: f64) -> Option<Vec<Point3>> {
        self.stage("way_through_views", |map| map.way_through_views(hovering, radius_m))
    }

    fn way_to(
        &mut self,
        hovering: &Hovering,
        vertex: VertexId,
        place_in_vertex: &Point3,
        radius_m: f64,
        probe: &mut dyn Map3dProbe,
    ) -> Option<Vec<Point3>> {
        let stages = self.stages.clone();
        self.timed(|map| {
            stages.by_events("way_to", probe, |probe| {
                map.way_to(hovering, vertex, place_in_vertex, radius_m, probe)
            })
        })
    }

    fn compare_farther(&mut self, vertex: VertexId, is_last: bool, probe: &mut dyn Map3dProbe) {
        self.timed(|map| map.compare_farther(vertex, is_last, probe));
    }

    fn give_up(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3],
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        self.stage("give_up", |map| {
            map.give_up(hovering, places_in_body, radius_m, everywhere, probe)
        });
    }

    fn knows(&self, hovering: &Hovering, point_in_body: &Point3) -> Known {
        self.inner.knows(hovering, point_in_body)
    }

    fn free_lines(
        &mut self,
        hovering: &Hovering,
        lines_in_body: &[[Point3; 2]],
        short_m: f64,
    ) -> Vec<bool> {
        self.stage("free_lines", |map| map.free_lines(hovering, lines_in_body, short_m))
    }

    fn meets_solid(&mut self, hovering: &Hovering, points_in_body: &[Point3]) -> bool {
        self.stage("meets_solid", |map| map.meets_solid(hovering, points_in_body))
    }

    fn sights_of(&mut self, hovering: &Hovering, point_in_body: &Point3) -> Sights {
        self.stage("sights", |map| map.sights_of(hovering, point_in_body))
    }

    fn work(&self) -> MapWork {
        self.inner.work()
    }

    fn bytes(&self) -> usize {
        self.inner.bytes()
    }
}
