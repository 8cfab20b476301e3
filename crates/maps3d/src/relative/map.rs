//! The relative map of space, and its answers to the map trait.

use nalgebra::Point3;
use pose::Se3;
use posegraph::{PoseGraph, Scope, ScopeScratch, Skeleton};
use probe::{EdgeId, IdVec, Probe, VertexId};

use super::book::Book;
use super::clearance::Shell;
use super::drift::Drift;
use super::events::ConsolidationEvent;
use super::pair::Work;
use super::{FanOptions, RelativeParams, ViewState};
use crate::{
    FlightClearance, FlightRoute, FrontierPatch, Hovering, Known, Look, Map3d, Map3dProbe,
    MapTally, MapWork, Maps3dError, Sights,
};

/// Star-shaped polyhedra on a pose graph, with consolidated frontier (\[ISRR19\] 4.4 carried out in space).
///
/// Views are kept in the frames of their own vertices; no global frame exists.
#[derive(Clone, Debug)]
pub struct RelativeMap {
    pub(super) params: RelativeParams,
    pub(super) views: Vec<ViewState>,
    pub(super) views_of: IdVec<VertexId, Vec<u32>>,
    pub(super) skeleton: Skeleton<Se3>,
    pub(super) book: Book,
    pub(super) drift: Drift,
    /// The scope taken last; valid while its root and the skeleton are what they were.
    pub(super) scope: Scope<Se3>,
    pub(super) scope_is_fresh: bool,
    /// Whether whoever listens was told of it: some questions are asked without a listener.
    scope_is_told: bool,
    pub(super) scratch: ScopeScratch,
    /// Places that nothing can be seen at, whatever looks: vertex, place in its frame, radius in metres.
    pub(super) given_up: Vec<(VertexId, Point3<f64>, f64)>,
    /// How many looks were taken.
    pub(super) looks: u32,
    pub(super) work: Work,
    /// What was planned so far.
    pub(super) planned: MapWork,
    /// What bounds the views of vertices that were asked for clearance lately, the last one first.
    pub(super) shells: Vec<Shell>,
}

impl RelativeMap {
    /// A map of nothing.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for a parameter out of its range.
    pub fn new(params: RelativeParams) -> Result<Self, Maps3dError> {
        params.check()?;
        let skeleton = empty_skeleton(&params);
        Ok(Self {
            params,
            views: Vec::new(),
            views_of: IdVec::new(),
            skeleton,
            book: Book::default(),
            drift: Drift::default(),
            scope: Scope::default(),
            scope_is_fresh: false,
            scope_is_told: false,
            scratch: ScopeScratch::default(),
            given_up: Vec::new(),
            looks: 0,
            work: Work::default(),
            planned: MapWork::default(),
            shells: Vec::new(),
        })
    }

    /// What was chosen for this map.
    pub fn params(&self) -> &RelativeParams {
        &self.params
    }

    /// All views in the order of their looks, retired ones included; the place of a view is its number.
    pub fn views(&self) -> &[ViewState] {
        &self.views
    }

    /// The numbers of the views of a vertex, ascending.
    pub fn views_of(&self, vertex: VertexId) -> &[u32] {
        self.views_of.get(vertex).map_or(&[], Vec::as_slice)
    }

    /// Number of views that take part in comparisons.
    pub fn active_count(&self) -> usize {
        self.views.iter().filter(|state| !state.retired).count()
    }

    /// The scope taken last (\[ISRR19\] 4.3).
    pub fn scope(&self) -> &Scope<Se3> {
        &self.scope
    }

    /// The graph that placement walks.
    pub fn skeleton(&self) -> &Skeleton<Se3> {
        &self.skeleton
    }

    /// Who closed what, when, and along which path.
    pub fn book(&self) -> &Book {
        &self.book
    }

    /// Gathers the scope of `root` unless that is the one at hand.
    pub(super) fn take_scope(&mut self, root: VertexId, probe: &mut dyn Map3dProbe) {
        if !self.scope_is_fresh || self.scope.root() != Some(root) {
            let radius_m = self.params.consolidation_radius_m;
            self.scratch.place(&self.skeleton, root, radius_m, &mut self.scope);
            (self.scope_is_fresh, self.scope_is_told) = (true, false);
        }
        if !self.scope_is_told && Probe::<ConsolidationEvent<'_>>::on(probe) {
            self.scope_is_told = true;
            let (scope, skeleton) = (&self.scope, &self.skeleton);
            probe.emit(ConsolidationEvent::ScopeTaken { scope, skeleton });
        }
    }

    /// Room for a vertex.
    pub(super) fn cover(&mut self, vertex: VertexId) {
        while self.views_of.next_id() <= vertex {
            self.views_of.push(Vec::new());
        }
        self.skeleton.cover(vertex);
    }

    fn settled(&self, vertex: VertexId, probe: &mut dyn Map3dProbe) {
        if Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::Settled { map: self, vertex });
        }
    }
}

/// Views that a way from one place to another is planned through, at most.
const MOST_BETWEEN: usize = 10;

/// The skeleton of a map without vertices.
pub(super) fn empty_skeleton(params: &RelativeParams) -> Skeleton<Se3> {
    Skeleton::new(params.consolidation_radius_m).weigh_places(params.place_weight)
}

impl Map3d for RelativeMap {
    fn kind(&self) -> &'static str {
        "relative"
    }

    fn edges_added(
        &mut self,
        graph: &PoseGraph<Se3>,
        edges: &[EdgeId],
        probe: &mut dyn Map3dProbe,
    ) {
        if let Some(root) = self.take_edges(graph, edges, probe) {
            self.settled(root, probe);
        }
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph<Se3>, edge: EdgeId, probe: &mut dyn Map3dProbe) {
        self.withdraw(graph, edge, probe);
        self.settled(graph.edge(edge).b, probe);
    }

    fn looked(&mut self, look: &Look<'_>, probe: &mut dyn Map3dProbe) -> Result<(), Maps3dError> {
        self.insert(look, probe)?;
        self.settled(look.vertex, probe);
        Ok(())
    }

    fn tally(&self) -> MapTally {
        let mut tally = MapTally { volumes: self.views.len(), ..MapTally::default() };
        for state in &self.views {
            tally.open_m2 += state.open_m2;
            tally.sliver_m2 += state.sliver_m2;
            tally.largest_sliver_m2 = tally.largest_sliver_m2.max(state.largest_sliver_m2);
            tally.given_up_m2 += state.given_up_m2;
            tally.patches += state.parts.len();
            tally.faces += state.volume.face_count();
        }
        tally
    }

    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        self.patches_of(hovering, out);
    }

    fn is_by_vertex(&self) -> bool {
        true
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.views_of(vertex).iter().map(|&view| self.views[view as usize].open_m2).sum()
    }

    fn route(
        &mut self,
        hovering: &Hovering,
        _clearance_m: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute> {
        let (skeleton, views, views_of) = (&self.skeleton, &self.views, &self.views_of);
        let counts = |vertex: VertexId| {
            let here = views_of.get(vertex).into_iter().flatten();
            here.into_iter().any(|&view| views[view as usize].counts()) && comes_now(vertex)
        };
        let limit_m = f64::INFINITY;
        let way = self.scratch.way_to_nearest(skeleton, hovering.vertex, limit_m, counts)?;
        Some(FlightRoute::Repeat(way))
    }

    fn clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3<f64>,
        leaving_m: f64,
    ) -> FlightClearance {
        self.motion_clearance(hovering, to_in_body, leaving_m)
    }

    fn compare_farther(&mut self, vertex: VertexId, is_last: bool, probe: &mut dyn Map3dProbe) {
        self.compare_with_farther(vertex, is_last, probe);
        self.settled(vertex, probe);
    }

    fn way_through_views(
        &mut self,
        hovering: &Hovering,
        radius_m: f64,
    ) -> Option<Vec<Point3<f64>>> {
        let options = FanOptions { radius_m, ..FanOptions::default() };
        // A radius out of its range has no way.
        let way = self.way_through_fans(hovering, &options).ok()?.way?;
        Some(way.in_body.into_iter().skip(1).collect())
    }

    fn way_to(
        &mut self,
        hovering: &Hovering,
        vertex: VertexId,
        place_in_vertex: &Point3<f64>,
        radius_m: f64,
        probe: &mut dyn Map3dProbe,
    ) -> Option<Vec<Point3<f64>>> {
        let options = FanOptions { radius_m, most_volumes: MOST_BETWEEN, ..FanOptions::default() };
        // A radius out of its range has no way.
        let found = self.way_through_fans_to(hovering, vertex, place_in_vertex, &options, probe);
        Some(found.ok()?.way?.in_body.into_iter().skip(1).collect())
    }

    fn work(&self) -> MapWork {
        self.planned
    }

    fn give_up(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3<f64>],
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        self.give_up_near(hovering, places_in_body, radius_m, everywhere, probe);
        self.settled(hovering.vertex, probe);
    }

    fn knows(&self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Known {
        self.known_of(hovering, point_in_body)
    }

    fn meets_solid(&mut self, hovering: &Hovering, points_in_body: &[Point3<f64>]) -> bool {
        self.take_scope(hovering.vertex, &mut probe::Off);
        points_in_body
            .iter()
            .any(|point| self.known_within(&self.scope, hovering, point) == Known::Solid)
    }

    fn sights_of(&mut self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Sights {
        self.sights(hovering, point_in_body)
    }

    fn free_lines(
        &mut self,
        hovering: &Hovering,
        lines_in_body: &[[Point3<f64>; 2]],
        short_m: f64,
    ) -> Vec<bool> {
        self.lines_free(hovering, lines_in_body, short_m)
    }

    fn bytes(&self) -> usize {
        let views: usize =
            self.views.iter().map(|state| size_of::<ViewState>() + state.heap_bytes()).sum();
        let of: usize = self.views_of.iter().map(|views| 24 + 4 * views.capacity()).sum();
        views
            + of
            + self.book.heap_bytes()
            + self.skeleton.heap_bytes()
            + self.given_up.capacity() * size_of::<(VertexId, Point3<f64>, f64)>()
            + self.shells.iter().map(Shell::heap_bytes).sum::<usize>()
    }
}
