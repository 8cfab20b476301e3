//! The maps of one robot, and poses that are given.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use formats::log::Decision;
use geometry::Point2;
use maps2d::active::ActiveArea;
use maps2d::correction::GivenPoses;
use maps2d::extended::ExtendedMap;
use maps2d::grid::{CorrectedGrid, GridMap};
use maps2d::polygons::CorrectedPolygons;
use maps2d::relative::RelativeMap;
use maps2d::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, MapProbe, Route, Standing,
    Vantage,
};
use metrics::Witness;
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, VertexId};
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};

use super::AtWork;
use super::timed::TimedProbe;
use crate::config::{Config, Poses};
use crate::export::{Feed, gave_up};

/// The map of a kind, if the config builds it.
pub(crate) fn map_of(
    config: &Config,
    kind: &str,
    truth: &TruePoses,
) -> Option<Box<dyn ExplorationMap + Send>> {
    match kind {
        "relative" => Some(Box::new(RelativeMap::new(config.relative_params()?))),
        "grid" => {
            let map = config.map.grid.as_ref()?;
            Some(Box::new(match map.poses {
                Poses::Odometry => GridMap::new(map.into()),
                Poses::True => GridMap::with_poses(map.into(), Arc::new(truth.clone())),
            }))
        }
        "grid_corrected" => {
            let (grid, correction) = config.grid_corrected_params()?;
            Some(Box::new(CorrectedGrid::new(grid, correction)))
        }
        "corrected_polygons" => {
            Some(Box::new(CorrectedPolygons::new(config.corrected_polygons_params()?)))
        }
        "active_area" => Some(Box::new(ActiveArea::new(config.active_area_params()?))),
        "extended" => Some(Box::new(ExtendedMap::new(config.extended_params()?))),
        _ => None,
    }
}

/// The true poses of vertices from the start, for the baselines that are given them.
#[derive(Clone, Debug, Default)]
pub(crate) struct TruePoses(Arc<Mutex<IdVec<VertexId, Se2>>>);

impl GivenPoses for TruePoses {
    fn map_from_vertex(&self, vertex: VertexId) -> Option<Se2> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(vertex).copied()
    }
}

/// A robot that tells the true pose of every vertex that is marked; to nobody but baselines.
pub(super) struct Telling<'a> {
    pub(super) witness: &'a mut Witness,
    pub(super) truth: &'a TruePoses,
}

impl Robot for Telling<'_> {
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        self.witness.turn(angle_rad)
    }

    fn forward(&mut self, distance_m: f64) -> Odometry {
        self.witness.forward(distance_m)
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        self.witness.repeat(to, length_m)
    }

    fn scan(&mut self) -> Scan {
        self.witness.scan()
    }

    fn mark(&mut self, vertex: VertexId) {
        self.witness.mark(vertex);
        let world_from_start = self.witness.robot().world().world_from_start();
        let start_from_vertex = world_from_start.inverse_mul(&self.witness.world_from_body());
        let mut known = self.truth.0.lock().unwrap_or_else(PoisonError::into_inner);
        while known.next_id() < vertex {
            known.push(Se2::identity());
        }
        if known.next_id() == vertex {
            known.push(start_from_vertex);
        }
    }

    fn recognize(&mut self) -> Vec<PlaceMatch> {
        self.witness.recognize()
    }
}

/// A map that says when it is at work, takes the time of it, and notes what it is fed.
pub(super) struct Side {
    inner: Box<dyn ExplorationMap + Send>,
    index: usize,
    at_work: AtWork,
    feed: Feed,
}

/// About the robot within this distance is everywhere, metres.
const EVERYWHERE_M: f64 = 1e9;

impl Side {
    pub(super) fn new(
        inner: Box<dyn ExplorationMap + Send>,
        index: usize,
        at_work: &AtWork,
        feed: Feed,
    ) -> Self {
        Self { inner, index, at_work: at_work.clone(), feed }
    }

    fn timed<T>(&mut self, work: impl FnOnce(&mut dyn ExplorationMap) -> T) -> T {
        self.at_work.timed(self.index, || work(self.inner.as_mut()))
    }

    /// As [`timed`](Self::timed); a correction that comes of it is noted with its own time, without
    /// what listening took.
    fn correcting(
        &mut self,
        probe: &mut dyn MapProbe,
        work: impl FnOnce(&mut dyn ExplorationMap, &mut dyn MapProbe),
    ) {
        let before = self.inner.corrections();
        let start = Instant::now();
        let at_work = self.at_work.clone();
        let mut heard = TimedProbe::new(probe, &at_work, 0);
        self.timed(|map| work(map, &mut heard));
        let spent = start.elapsed().saturating_sub(heard.spent);
        if self.inner.corrections() > before {
            self.at_work.note_correction(self.index, spent);
        }
    }

    /// As [`timed`](Self::timed), for a way to frontier. A grid that finds none gives all frontier up by
    /// itself; a log has that as a decision, or else its replay would end with frontier that the run had not.
    fn routing(
        &mut self,
        standing: &Standing,
        work: impl FnOnce(&mut dyn ExplorationMap) -> Option<Route>,
    ) -> Option<Route> {
        let gives_up = self.feed.is_on() && matches!(self.inner.kind(), "grid" | "grid_corrected");
        let open_m = if gives_up { self.inner.frontier().open_m } else { 0.0 };
        let route = self.timed(work);
        if route.is_none() && open_m > 0.0 {
            let decision = gave_up(standing, &Point2::origin(), EVERYWHERE_M, true);
            self.feed.decided(self.inner.kind(), decision);
        }
        route
    }
}

impl ExplorationMap for Side {
    fn kind(&self) -> &'static str {
        self.inner.kind()
    }

    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe) {
        self.feed.edges(graph, edges);
        self.correcting(probe, |map, probe| map.edges_added(graph, edges, probe));
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph, edge: EdgeId, probe: &mut dyn MapProbe) {
        self.correcting(probe, |map, probe| map.edge_withdrawn(graph, edge, probe));
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe) {
        self.timed(|map| map.poses_reestimated(map_from_vertex, probe));
    }

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        self.feed.scan(standing, scan);
        self.timed(|map| map.scanned(standing, scan, probe));
    }

    fn frontier(&self) -> Frontier {
        self.inner.frontier()
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.timed(|map| map.in_view(standing, out));
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.timed(|map| map.around(standing, out));
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        self.timed(|map| map.clearance(standing, to_in_body))
    }

    fn route(&mut self, standing: &Standing, clearance_m: f64) -> Option<Route> {
        self.routing(standing, |map| map.route(standing, clearance_m))
    }

    fn look_again(&mut self, probe: &mut dyn MapProbe) -> bool {
        self.feed.decided(self.inner.kind(), Decision::LookedAgain);
        self.timed(|map| map.look_again(probe))
    }

    fn has_frontier_by_vertex(&self) -> bool {
        self.inner.has_frontier_by_vertex()
    }

    fn route_to(
        &mut self,
        standing: &Standing,
        clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<Route> {
        self.routing(standing, |map| map.route_to(standing, clearance_m, comes_now))
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.inner.frontier_at(vertex)
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        self.inner.detour(standing, goal_in_body, clearance_m)
    }

    fn vantage(&mut self, standing: &Standing, goal: &Point2, clearance_m: f64) -> Option<Vantage> {
        self.timed(|map| map.vantage(standing, goal, clearance_m))
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn MapProbe,
    ) {
        let decision = gave_up(standing, goal_in_body, radius_m, everywhere);
        self.feed.decided(self.inner.kind(), decision);
        self.timed(|map| map.give_up(standing, goal_in_body, radius_m, everywhere, probe));
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        self.inner.knows(standing, point_in_body)
    }

    fn global(&self) -> Option<GlobalBelief> {
        self.inner.global()
    }

    fn corrections(&self) -> u64 {
        self.inner.corrections()
    }

    fn invalid(&self) -> u64 {
        self.inner.invalid()
    }

    fn bytes(&self) -> usize {
        self.inner.bytes()
    }
}
