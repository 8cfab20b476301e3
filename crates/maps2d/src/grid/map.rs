//! The grid and its answers to the map trait.

use std::collections::BTreeSet;
use std::sync::Arc;

use geometry::Point2;
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, IdVec, VertexId};
use sensing::Scan;

use super::{Cell, CellState, Cells, GridEvent};
use crate::correction::GivenPoses;
use crate::volume::{LocalVolume, Samples, VolumeParams, build};
use crate::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, MapProbe, Route, Standing,
    Vantage,
};

/// Parameters of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridParams {
    /// Side of a cell, metres.
    pub cell_m: f64,
    /// A cell counts as fully inside a scan polygon when the cell shrunk by this share of its side
    /// on every side is. Without it a cell in a corner, which no polygon of rays ever fills, would
    /// stay unknown for ever.
    pub cell_margin: f64,
    /// How scans become polygons.
    pub volume: VolumeParams,
}

impl Default for GridParams {
    fn default() -> Self {
        Self { cell_m: 1.0, cell_margin: 0.05, volume: VolumeParams::default() }
    }
}

/// The plain grid in the odometry frame: estimates are taken as they are (\[ISRR19\] 6.2).
#[derive(Clone, Debug)]
pub struct GridMap {
    pub(super) params: GridParams,
    pub(super) cells: Cells,
    /// Odometry estimate of every vertex, by vertex.
    pub(super) odom_from_vertex: IdVec<VertexId, Se2>,
    /// Where vertices are, if that is given from outside.
    pub(super) given: Option<Arc<dyn GivenPoses>>,
    /// Every scan with where it was taken, for rebuilding.
    pub(super) scans: Vec<(VertexId, Se2, Scan)>,
    /// Frontier cells that count, in order.
    pub(super) frontier: BTreeSet<Cell>,
    /// Frontier cells that do not count, because they were given up.
    pub(super) ignored: BTreeSet<Cell>,
    /// What is seen from where the robot stands, for clearance.
    pub(super) view: LocalVolume,
    pub(super) view_samples: Samples,
    pub(super) view_at: Option<VertexId>,
    pub(super) search: search::Scratch<VertexId>,
}

impl GridMap {
    /// A grid of nothing.
    pub fn new(params: GridParams) -> Self {
        Self {
            params,
            cells: Cells::new(params.cell_m),
            odom_from_vertex: IdVec::new(),
            given: None,
            scans: Vec::new(),
            frontier: BTreeSet::new(),
            ignored: BTreeSet::new(),
            view: LocalVolume::empty(),
            view_samples: Samples::new(),
            view_at: None,
            search: search::Scratch::default(),
        }
    }

    /// A grid of nothing whose poses are given from outside: its frame is theirs.
    pub fn with_poses(params: GridParams, given: Arc<dyn GivenPoses>) -> Self {
        Self { given: Some(given), ..Self::new(params) }
    }

    /// The cells and what is believed of them.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// The frontier cells that count, in order.
    pub fn frontier_cells(&self) -> impl Iterator<Item = Cell> + '_ {
        self.frontier.iter().copied()
    }

    /// Where the body is in the odometry frame, as the grid believes.
    pub fn odom_from_body(&self, standing: &Standing) -> Se2 {
        let odom_from_vertex =
            self.odom_from_vertex.get(standing.vertex).copied().unwrap_or_default();
        odom_from_vertex * standing.vertex_from_body
    }

    pub(super) fn cover(&mut self, vertex: VertexId) {
        while self.odom_from_vertex.next_id() <= vertex {
            self.odom_from_vertex.push(Se2::identity());
        }
    }

    /// Takes the pose of a vertex from outside, where it is given.
    fn take_given(&mut self, vertex: VertexId) {
        let given = self.given.as_ref().and_then(|given| given.map_from_vertex(vertex));
        if let Some(map_from_vertex) = given {
            self.odom_from_vertex[vertex] = map_from_vertex;
        }
    }
}

impl ExplorationMap for GridMap {
    fn kind(&self) -> &'static str {
        "grid"
    }

    /// Only odometry moves the estimate; recognised places are not used by the plain grid.
    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], _probe: &mut dyn MapProbe) {
        for &edge in edges {
            let edge = *graph.edge(edge);
            self.cover(edge.a.max(edge.b));
            if edge.kind == EdgeKind::Odometry {
                self.odom_from_vertex[edge.b] = self.odom_from_vertex[edge.a] * edge.a_from_b;
            }
            self.take_given(edge.b);
        }
    }

    fn edge_withdrawn(&mut self, _graph: &PoseGraph, _edge: EdgeId, _probe: &mut dyn MapProbe) {}

    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe) {
        for (i, pose) in map_from_vertex.iter().enumerate() {
            let vertex = VertexId(i as u32);
            self.cover(vertex);
            self.odom_from_vertex[vertex] = *pose;
        }
        self.rebuild();
        if probe::Probe::<GridEvent<'_>>::on(probe) {
            probe.emit(GridEvent::Rebuilt { scans: self.scans.len(), grid: self });
        }
    }

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        if self.odom_from_vertex.next_id() <= standing.vertex {
            self.cover(standing.vertex);
            self.take_given(standing.vertex);
        }
        self.scans.push((standing.vertex, standing.vertex_from_body, scan.clone()));
        if self.view_at != Some(standing.vertex) {
            self.view_samples = Samples::new();
            self.view_at = Some(standing.vertex);
        }
        self.view_samples.add(scan, &standing.vertex_from_body);
        self.view =
            build(&self.view_samples, &self.params.volume).unwrap_or_else(|_| LocalVolume::empty());
        let odom_from_sensor = self.odom_from_body(standing);
        let changed = self.apply(scan, &odom_from_sensor);
        if probe::Probe::<GridEvent<'_>>::on(probe) {
            probe.emit(GridEvent::ScanApplied { changed: &changed, grid: self });
        }
    }

    fn frontier(&self) -> Frontier {
        Frontier {
            open_m: self.frontier.len() as f64 * self.params.cell_m,
            ignored_m: self.ignored.len() as f64 * self.params.cell_m,
            places: self.frontier.len(),
        }
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.cells_in_view(standing, out);
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.cells_around(standing, out);
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        if self.view_at != Some(standing.vertex) {
            return Clearance::NONE;
        }
        self.view.motion_clearance(&standing.vertex_from_body.transform(to_in_body))
    }

    /// Ways over cells lead round corners already.
    fn vantage(&mut self, _: &Standing, _: &Point2, _: f64) -> Option<Vantage> {
        None
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        let goal = standing.vertex_from_body.transform(goal_in_body);
        let stop = self.view.detour(&goal, clearance_m)?;
        Some(standing.vertex_from_body.inverse_transform(&stop))
    }

    fn route(&mut self, standing: &Standing, clearance_m: f64) -> Option<Route> {
        self.way_over_free_cells(standing, clearance_m)
    }

    /// The grid leads to cells, not to vertices.
    fn frontier_at(&self, _vertex: VertexId) -> f64 {
        0.0
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        _everywhere: bool,
        _probe: &mut dyn MapProbe,
    ) {
        self.give_up_near(standing, goal_in_body, radius_m);
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        let cell = self.cells.at(&self.odom_from_body(standing).transform(point_in_body));
        self.cells.state(cell) != CellState::Unknown
    }

    fn global(&self) -> Option<GlobalBelief> {
        let solid = (0..self.cells.slots())
            .map(|slot| self.cells.cell(slot))
            .filter(|cell| self.cells.state(*cell) == CellState::Occupied)
            .map(|cell| self.cells.centre(cell));
        Some(GlobalBelief {
            walls: solid.map(|centre| (centre, centre)).collect(),
            cells: self.cells.clone(),
            map_from_vertex: self.odom_from_vertex.as_slice().to_vec(),
        })
    }

    fn bytes(&self) -> usize {
        let scans: usize = self
            .scans
            .iter()
            .map(|(_, _, scan)| size_of::<(VertexId, Se2, Scan)>() + scan.len() * size_of::<f64>())
            .sum();
        self.cells.heap_bytes() + scans + self.odom_from_vertex.len() * size_of::<Se2>()
    }
}
