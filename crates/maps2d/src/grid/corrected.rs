//! The grid with loop closure: all scans are applied again whenever poses are corrected
//! (\[ISRR19\] 6.2, "gridlc").

use geometry::Point2;
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use sensing::Scan;

use super::{GridMap, GridParams};
use crate::correction::{Correction, CorrectionParams};
use crate::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, MapProbe, Route, Standing,
    Vantage,
};

/// An occupancy grid in a frame that an optimiser keeps consistent.
#[derive(Clone, Debug)]
pub struct CorrectedGrid {
    grid: GridMap,
    correction: Correction,
}

impl CorrectedGrid {
    /// A grid of nothing.
    pub fn new(grid: GridParams, correction: CorrectionParams) -> Self {
        Self { grid: GridMap::new(grid), correction: Correction::new(correction) }
    }

    /// The grid.
    pub fn grid(&self) -> &GridMap {
        &self.grid
    }

    /// The poses.
    pub fn correction(&self) -> &Correction {
        &self.correction
    }
}

impl ExplorationMap for CorrectedGrid {
    fn kind(&self) -> &'static str {
        "grid_corrected"
    }

    /// Optimises where a place was recognised, and applies every scan again.
    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe) {
        self.grid.edges_added(graph, edges, probe);
        if self.correction.edges_added(graph, edges, probe) {
            self.grid.poses_reestimated(self.correction.poses(), probe);
        }
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph, _edge: EdgeId, probe: &mut dyn MapProbe) {
        if self.correction.optimise(graph, 0, probe) {
            self.grid.poses_reestimated(self.correction.poses(), probe);
        }
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe) {
        self.correction.set(map_from_vertex);
        self.grid.poses_reestimated(map_from_vertex, probe);
    }

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        self.correction.cover(standing.vertex);
        self.grid.scanned(standing, scan, probe);
    }

    fn frontier(&self) -> Frontier {
        self.grid.frontier()
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.grid.in_view(standing, out);
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.grid.around(standing, out);
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        self.grid.clearance(standing, to_in_body)
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        self.grid.detour(standing, goal_in_body, clearance_m)
    }

    fn route(&mut self, standing: &Standing, clearance_m: f64) -> Option<Route> {
        self.grid.route(standing, clearance_m)
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.grid.frontier_at(vertex)
    }

    fn vantage(&mut self, standing: &Standing, goal: &Point2, clearance_m: f64) -> Option<Vantage> {
        self.grid.vantage(standing, goal, clearance_m)
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn MapProbe,
    ) {
        self.grid.give_up(standing, goal_in_body, radius_m, everywhere, probe);
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        self.grid.knows(standing, point_in_body)
    }

    fn corrections(&self) -> u64 {
        self.correction.count()
    }

    fn global(&self) -> Option<GlobalBelief> {
        self.grid.global()
    }

    fn bytes(&self) -> usize {
        self.grid.bytes() + self.correction.heap_bytes()
    }
}
