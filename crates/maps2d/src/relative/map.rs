//! The relative map and its answers to the map trait.

use geometry::Point2;
use pose::Se2;
use posegraph::{PoseGraph, Scope, ScopeScratch, Skeleton};
use probe::{EdgeId, IdVec, VertexId};
use sensing::Scan;

use super::{ConsolidationEvent, PathBook, RelativeParams, VolumeState};
use crate::{Candidate, Clearance, ExplorationMap, Frontier, MapProbe, Route, Standing, Vantage};

/// Local volumes on a pose graph, with consolidated frontiers (\[ISRR19\] 4).
///
/// Volumes are kept in the frames of their own vertices; no global frame exists.
#[derive(Clone, Debug)]
pub struct RelativeMap {
    pub(super) params: RelativeParams,
    pub(super) volumes: IdVec<VertexId, Option<Box<VolumeState>>>,
    pub(super) skeleton: Skeleton,
    /// The same graph with nothing retired: for asking retired volumes.
    pub(super) full: Skeleton,
    pub(super) book: PathBook,
    /// The scope taken last; valid while its root and the skeleton are what they were.
    pub(super) scope: Scope,
    pub(super) scope_is_fresh: bool,
    /// Whether the scope at hand was taken from the full graph.
    pub(super) scope_is_full: bool,
    pub(super) scratch: ScopeScratch,
    pub(super) totals: Totals,
    /// How many scans were taken.
    pub(super) scans: u32,
    /// Where the robot stood when it took the last one.
    pub(super) stood: Option<VertexId>,
    pub(super) work: super::pair::Work,
}

/// Sums over all volumes, kept up to date as ledgers change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Totals {
    pub open_m: f64,
    pub sliver_m: f64,
    pub unreachable_m: f64,
    pub places: usize,
}

impl Totals {
    pub fn add(&mut self, state: &VolumeState) {
        self.open_m += state.open_m;
        self.sliver_m += state.sliver_m;
        self.unreachable_m += state.unreachable_m;
        self.places += usize::from(state.counts());
    }

    pub fn remove(&mut self, state: &VolumeState) {
        self.open_m -= state.open_m;
        self.sliver_m -= state.sliver_m;
        self.unreachable_m -= state.unreachable_m;
        self.places -= usize::from(state.counts());
    }
}

impl RelativeMap {
    /// A map of nothing.
    pub fn new(params: RelativeParams) -> Self {
        Self {
            params,
            volumes: IdVec::new(),
            skeleton: empty_skeleton(&params),
            full: Skeleton::new(2.0 * params.consolidation_radius_m)
                .weigh_places(params.place_weight),
            book: PathBook::default(),
            scope: Scope::default(),
            scope_is_fresh: false,
            scope_is_full: false,
            scratch: ScopeScratch::default(),
            totals: Totals::default(),
            scans: 0,
            stood: None,
            work: super::pair::Work::default(),
        }
    }

    /// What was chosen for this map.
    pub fn params(&self) -> &RelativeParams {
        &self.params
    }

    /// The volume on a vertex, with its ledgers; `None` where no scan was taken.
    pub fn volume(&self, vertex: VertexId) -> Option<&VolumeState> {
        self.volumes.get(vertex)?.as_deref()
    }

    /// All volumes with their vertices, retired ones included.
    pub fn volumes(&self) -> impl Iterator<Item = (VertexId, &VolumeState)> {
        self.volumes.iter_ids().filter_map(|(vertex, state)| Some((vertex, state.as_deref()?)))
    }

    /// Number of volumes that take part in comparisons.
    pub fn active_count(&self) -> usize {
        self.volumes().filter(|(_, state)| !state.retired).count()
    }

    /// The scope taken last (\[ISRR19\] 4.3).
    pub fn scope(&self) -> &Scope {
        &self.scope
    }

    /// The graph that placement walks.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The paths that closings relied on.
    pub fn book(&self) -> &PathBook {
        &self.book
    }

    /// The graph that the paths of the scope at hand walk.
    pub(super) fn walked(&self) -> &Skeleton {
        if self.scope_is_full { &self.full } else { &self.skeleton }
    }

    /// Gathers the scope of `root` unless that is the one at hand.
    pub(super) fn take_scope(&mut self, root: VertexId, probe: &mut dyn MapProbe) {
        if self.scope_is_fresh && self.scope.root() == Some(root) {
            return;
        }
        let radius_m = self.params.consolidation_radius_m;
        self.scratch.place(&self.skeleton, root, radius_m, &mut self.scope);
        self.scope_is_fresh = true;
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::ScopeTaken {
                scope: &self.scope,
                skeleton: &self.skeleton,
            });
        }
    }
}

/// The skeleton of a map without vertices: ways within the scope are kept, give or take a tenth.
pub(super) fn empty_skeleton(params: &RelativeParams) -> Skeleton {
    Skeleton::with_stretch(params.consolidation_radius_m, 1.1).weigh_places(params.place_weight)
}

impl ExplorationMap for RelativeMap {
    fn kind(&self) -> &'static str {
        "relative"
    }

    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe) {
        self.take_edges(graph, edges, probe);
        self.hold_slivers(probe);
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph, edge: EdgeId, probe: &mut dyn MapProbe) {
        self.withdraw(graph, edge, probe);
        self.hold_slivers(probe);
    }

    /// Relative placement does not look at global estimates: nothing changes.
    fn poses_reestimated(&mut self, _map_from_vertex: &[Se2], _probe: &mut dyn MapProbe) {}

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        self.insert(standing, scan, probe);
        self.hold_slivers(probe);
        if probe::Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Settled { map: self, standing: standing.vertex });
        }
    }

    fn frontier(&self) -> Frontier {
        // Sums of many additions and subtractions end a hair off zero; the count does not.
        let places = self.totals.places;
        Frontier {
            open_m: if places == 0 { 0.0 } else { self.totals.open_m.max(0.0) },
            ignored_m: (self.totals.sliver_m + self.totals.unreachable_m).max(0.0),
            places,
        }
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.candidates(standing, out);
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        self.candidates_around(standing, out);
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        self.motion_clearance(standing, to_in_body)
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        let here = &self.volume(standing.vertex)?.volume;
        let goal = standing.vertex_from_body.transform(goal_in_body);
        let stop = here.detour(&goal, clearance_m)?;
        Some(standing.vertex_from_body.inverse_transform(&stop))
    }

    fn route(&mut self, standing: &Standing, _clearance_m: f64) -> Option<Route> {
        self.way_to_frontier(standing, &|_| true)
    }

    fn look_again(&mut self, probe: &mut dyn MapProbe) -> bool {
        self.take_last_look(probe)
    }

    fn has_frontier_by_vertex(&self) -> bool {
        true
    }

    fn route_to(
        &mut self,
        standing: &Standing,
        _clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<Route> {
        self.way_to_frontier(standing, comes_now)
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.volume(vertex).map_or(0.0, |state| state.open_m)
    }

    fn vantage(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Vantage> {
        self.nearest_vantage(standing, goal_in_body, clearance_m)
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn MapProbe,
    ) {
        self.give_up_near(standing, goal_in_body, radius_m, everywhere, probe);
        self.hold_slivers(probe);
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        let mut scope = Scope::default();
        let radius_m = self.params.consolidation_radius_m;
        ScopeScratch::default().place(&self.full, standing.vertex, radius_m, &mut scope);
        let point = standing.vertex_from_body.transform(point_in_body);
        scope.placed().iter().any(|row| {
            let at = row.root_from_vertex.inverse_transform(&point);
            self.volume(row.vertex).is_some_and(|state| state.volume.polygon.contains(&at))
        })
    }

    fn bytes(&self) -> usize {
        let volumes: usize =
            self.volumes().map(|(_, state)| size_of::<VolumeState>() + state.heap_bytes()).sum();
        volumes
            + self.volumes.len() * size_of::<usize>()
            + self.book.heap_bytes()
            + self.skeleton.heap_bytes()
            + self.full.heap_bytes()
    }
}
