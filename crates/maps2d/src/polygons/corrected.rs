//! The map with corrected poses.

use geometry::Point2;
use geometry::planar::overlay::{Operation, OverlayEvent, Region, overlay_with, union_all};
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, Probe, VertexId};
use sensing::Scan;

use super::raster::global_of;
use super::{
    GivenUp, GlobalPlanner, Here, OpenFrontier, OpenParams, PolygonEvent, Tag, region_of,
    with_straight_walls,
};
use crate::correction::{Correction, CorrectionParams};
use crate::volume::{LocalVolume, Samples, VolumeParams, build};
use crate::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, MapProbe, Route, Standing,
    Vantage,
};

/// Parameters of [`CorrectedPolygons`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CorrectedPolygonsParams {
    /// How scans become volumes.
    pub volume: VolumeParams,
    /// What counts as open.
    pub open: OpenParams,
    /// What the optimiser is told.
    pub correction: CorrectionParams,
}

/// One region of all views, placed by an optimised pose graph.
#[derive(Clone, Debug)]
pub struct CorrectedPolygons {
    params: CorrectedPolygonsParams,
    correction: Correction,
    /// What was seen from each vertex, and the volume of it.
    views: IdVec<VertexId, Option<Box<(Samples, LocalVolume)>>>,
    region: Region<Tag>,
    /// The region without the view from the vertex that was united last, and that vertex: further
    /// scans there take the place of that view.
    base: (Region<Tag>, Option<VertexId>),
    open: OpenFrontier,
    given_up: GivenUp,
    here: Here,
    planner: GlobalPlanner,
}

impl CorrectedPolygons {
    /// A map of nothing.
    pub fn new(params: CorrectedPolygonsParams) -> Self {
        Self {
            params,
            correction: Correction::new(params.correction),
            views: IdVec::new(),
            region: Region::default(),
            base: (Region::default(), None),
            open: OpenFrontier::default(),
            given_up: GivenUp::default(),
            here: Here::new(params.volume),
            planner: GlobalPlanner::default(),
        }
    }

    /// What is known to be free, with labelled edges, in the map's frame.
    pub fn region(&self) -> &Region<Tag> {
        &self.region
    }

    /// The open frontier of the region.
    pub fn open(&self) -> &OpenFrontier {
        &self.open
    }

    /// The poses.
    pub fn correction(&self) -> &Correction {
        &self.correction
    }

    fn map_from_body(&self, standing: &Standing) -> Se2 {
        self.correction.pose(standing.vertex) * standing.vertex_from_body
    }

    /// Places all views anew and unites them.
    fn rebuild(&mut self, probe: &mut dyn MapProbe) {
        let placed: Vec<Region<Tag>> = self
            .views
            .iter_ids()
            .filter_map(|(vertex, view)| Some((vertex, view.as_deref()?)))
            .map(|(vertex, (_, volume))| region_of(vertex, volume, &self.correction.pose(vertex)))
            .collect();
        let all: Vec<&Region<Tag>> = placed.iter().collect();
        // Views that the lattice cannot hold leave the map as it was.
        if let Ok(united) = union_all(&all) {
            self.region = with_straight_walls(&united.region);
        }
        self.base.1 = None;
        self.measure();
        if Probe::<PolygonEvent<'_>>::on(probe) {
            probe.emit(PolygonEvent::Rebuilt { views: all.len(), region: &self.region });
        }
    }

    fn measure(&mut self) {
        let discs = self.given_up.discs(|vertex| self.correction.pose(vertex));
        self.open = OpenFrontier::of(&self.region, &self.params.open, &discs);
    }

    fn unite(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some((_, volume)) = self.views.get(vertex).and_then(Option::as_deref) else { return };
        let view = region_of(vertex, volume, &self.correction.pose(vertex));
        let mut told: Vec<OverlayEvent> = Vec::new();
        let united = if Probe::<PolygonEvent<'_>>::on(probe) {
            overlay_with(&self.base.0, &view, Operation::Union, &mut told)
        } else {
            overlay_with(&self.base.0, &view, Operation::Union, &mut probe::Off)
        };
        if let Ok(united) = united {
            self.region = with_straight_walls(&united.region);
        }
        for event in &told {
            probe.emit(PolygonEvent::of_overlay(event));
        }
        if Probe::<PolygonEvent<'_>>::on(probe) {
            probe.emit(PolygonEvent::United { vertex, view: &view, region: &self.region });
        }
    }

    fn corrected(&mut self, corrected: bool, probe: &mut dyn MapProbe) {
        // Without drift a correction moves nothing that the lattice of unions could tell.
        if corrected && self.correction.has_moved() {
            self.rebuild(probe);
        }
    }
}

impl ExplorationMap for CorrectedPolygons {
    fn kind(&self) -> &'static str {
        "corrected_polygons"
    }

    /// Optimises where a place was recognised, and unites all views again.
    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe) {
        let corrected = self.correction.edges_added(graph, edges, probe);
        self.corrected(corrected, probe);
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph, _edge: EdgeId, probe: &mut dyn MapProbe) {
        let corrected = self.correction.optimise(graph, 0, probe);
        self.corrected(corrected, probe);
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe) {
        self.correction.set(map_from_vertex);
        self.rebuild(probe);
    }

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let vertex = standing.vertex;
        if let Some((dual, way)) = self.planner.take_planned() {
            probe.emit(PolygonEvent::WayPlanned { dual: &dual, way: &way });
        }
        self.correction.cover(vertex);
        while self.views.next_id() <= vertex {
            self.views.push(None);
        }
        let known = self.views[vertex].is_some();
        let nothing = || Box::new((Samples::new(), LocalVolume::empty()));
        let view = self.views[vertex].get_or_insert_with(nothing);
        view.0.add(scan, &standing.vertex_from_body);
        view.1 = build(&view.0, &self.params.volume).unwrap_or_else(|_| LocalVolume::empty());
        self.here.scanned(standing, scan, probe);
        if known && self.base.1 != Some(vertex) {
            // A view that has long been united is changed.
            self.rebuild(probe);
        } else {
            if self.base.1 != Some(vertex) {
                self.base = (self.region.clone(), Some(vertex));
            }
            self.unite(vertex, probe);
            self.measure();
        }
        if Probe::<PolygonEvent<'_>>::on(probe) {
            let (region, open) = (&self.region, &self.open);
            probe.emit(PolygonEvent::Settled { standing: vertex, region, open });
        }
    }

    fn frontier(&self) -> Frontier {
        self.open.summary()
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        let map_from_body = self.map_from_body(standing);
        self.planner.in_view(&self.here, &self.open, &map_from_body, standing, out);
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        let map_from_body = self.map_from_body(standing);
        self.planner.around(&self.here, &self.open, &map_from_body, standing, out);
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        self.here.clearance(standing, to_in_body)
    }

    /// By the dual graph. What no way leads to is given up: it is believed to be out of reach.
    fn route(&mut self, standing: &Standing, _clearance_m: f64) -> Option<Route> {
        let map_from_body = self.map_from_body(standing);
        let route = self.planner.route(&self.region, &self.open, &map_from_body);
        if route.is_none() {
            let map_from_vertex = self.correction.pose(standing.vertex);
            self.given_up.add_all(&self.open, standing.vertex, &map_from_vertex);
            self.measure();
        }
        route
    }

    /// The map leads to places, not to vertices.
    fn frontier_at(&self, _vertex: VertexId) -> f64 {
        0.0
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        self.here.detour(standing, goal_in_body, clearance_m)
    }

    /// Ways over triangles lead round corners already.
    fn vantage(&mut self, _: &Standing, _: &Point2, _: f64) -> Option<Vantage> {
        None
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        _everywhere: bool,
        _probe: &mut dyn MapProbe,
    ) {
        let at_in_vertex = standing.vertex_from_body.transform(goal_in_body);
        self.given_up.add(standing.vertex, at_in_vertex, radius_m);
        self.measure();
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        self.region.contains(&self.map_from_body(standing).transform(point_in_body))
    }

    fn corrections(&self) -> u64 {
        self.correction.count()
    }

    fn global(&self) -> Option<GlobalBelief> {
        Some(global_of(&self.region, self.correction.poses()))
    }

    fn bytes(&self) -> usize {
        let views: usize = self
            .views
            .iter()
            .filter_map(Option::as_deref)
            .map(|(samples, volume)| {
                samples.len() * size_of::<crate::volume::Sample>() + volume.heap_bytes()
            })
            .sum();
        views
            + self.region.heap_bytes()
            + self.base.0.heap_bytes()
            + self.correction.heap_bytes()
            + self.here.heap_bytes()
            + self.given_up.heap_bytes()
    }
}
