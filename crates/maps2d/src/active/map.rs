//! The map and its answers to the trait.

use geometry::Point2;
use geometry::planar::overlay::Region;
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, Probe, VertexId};
use sensing::Scan;

use super::aims::Aims;
use super::apart::unite_apart;
use super::area::{Area, Links};
use super::rings::{box_of, next, region_of_rings, ring_of, twice_area_m2, winding};
use super::sheets::merge_sheets;
use super::unite::{United, unite};
use super::untwist::{Splits, untwist};
use super::walls::{settle_along, walls_near};
use super::ways::region_inside;
use super::{Broken, Corner, Twisted};
use crate::correction::{Correction, CorrectionParams};
use crate::polygons::{
    GivenUp, GlobalPlanner, Here, OpenFrontier, OpenParams, PolygonEvent, Tag, global_of,
};
use crate::volume::{LocalVolume, VolumeParams};
use crate::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, MapProbe, Route, Standing,
    Vantage,
};

/// Parameters of [`ActiveArea`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveAreaParams {
    /// How scans become views; their strictness margin pulls views in before they are united.
    pub volume: VolumeParams,
    /// What counts as open.
    pub open: OpenParams,
    /// What the optimiser is told.
    pub correction: CorrectionParams,
    /// How many edges of the pose graph the active area reaches (n in eq. 2.8).
    pub area_edges: usize,
    /// Whether intersection points become corners (2.7.4).
    pub keep_intersections: bool,
    /// What becomes of upended parts (2.7.5).
    pub twisted: Twisted,
}

impl Default for ActiveAreaParams {
    fn default() -> Self {
        Self {
            volume: VolumeParams::default(),
            open: OpenParams::default(),
            correction: CorrectionParams::default(),
            area_edges: 10,
            keep_intersections: true,
            twisted: Twisted::Flip,
        }
    }
}

/// A global polygon that is merged inside the active area only (\[Zie18\] 2.7).
#[derive(Clone, Debug)]
pub struct ActiveArea {
    params: ActiveAreaParams,
    pub(super) correction: Correction,
    pub(super) links: Links,
    rings: Vec<Vec<Corner>>,
    /// The volume seen from each vertex last, for ways through the area.
    views: IdVec<VertexId, Option<Box<LocalVolume>>>,
    pub(super) open: OpenFrontier,
    pub(super) given_up: GivenUp,
    here: Here,
    pub(super) planner: GlobalPlanner,
    pub(super) aims: Aims,
    invalid: u64,
    scans: u64,
}

impl ActiveArea {
    /// A map of nothing.
    pub fn new(params: ActiveAreaParams) -> Self {
        Self {
            params,
            correction: Correction::new(params.correction),
            links: Links::default(),
            rings: Vec::new(),
            views: IdVec::new(),
            open: OpenFrontier::default(),
            given_up: GivenUp::default(),
            here: Here::new(params.volume),
            planner: GlobalPlanner::default(),
            aims: Aims::default(),
            invalid: 0,
            scans: 0,
        }
    }

    /// The rings: outer ones counter-clockwise, inner ones clockwise. They may overlap.
    pub fn rings(&self) -> &[Vec<Corner>] {
        &self.rings
    }

    /// How often the map was found to be broken.
    pub fn invalid(&self) -> u64 {
        self.invalid
    }

    /// The poses.
    pub fn correction(&self) -> &Correction {
        &self.correction
    }

    /// The open frontier of all rings.
    pub fn open(&self) -> &OpenFrontier {
        &self.open
    }

    pub(super) fn map_from_body(&self, standing: &Standing) -> Se2 {
        self.correction.pose(standing.vertex) * standing.vertex_from_body
    }

    pub(super) fn area(&self, vertex: VertexId) -> Area {
        self.links.within(vertex, self.params.area_edges)
    }

    /// Splits rings at crossings of edges that `counts` holds for; tells of it.
    fn untwist_where(
        &mut self,
        takes: impl Fn(&[Corner]) -> bool,
        counts: impl Fn(&Corner, &Corner) -> bool,
        twisted: Twisted,
        probe: &mut dyn MapProbe,
    ) {
        let mut done = Splits::default();
        let mut crossed = Vec::new();
        let mut rings = Vec::with_capacity(self.rings.len());
        for ring in std::mem::take(&mut self.rings) {
            if takes(&ring) {
                rings.extend(untwist(ring, &counts, twisted, &mut done, &mut crossed));
            } else {
                rings.push(ring);
            }
        }
        self.rings = rings;
        if done.splits > 0 && Probe::<PolygonEvent<'_>>::on(probe) {
            let (flipped, removed) = (done.flipped, done.removed);
            probe.emit(PolygonEvent::Untwisted { at: &crossed, flipped, removed });
        }
    }

    /// Unites the view from here with the rings (2.6, 2.7.1, 2.7.2).
    fn unite_view(&mut self, vertex: VertexId, probe: &mut dyn MapProbe) {
        let Some(volume) = self.here.volume(vertex) else { return };
        let margin_m = self.params.volume.strict_margin_m;
        let map_from_vertex = self.correction.pose(vertex);
        let mut view = ring_of(vertex, volume, &map_from_vertex, margin_m, self.scans);
        if view.len() < 3 || twice_area_m2(&view) <= 0.0 {
            return;
        }
        let active = self.area(vertex);
        self.settle_walls(vertex, &mut view, &active);
        let is_active =
            |a: &Corner, b: &Corner| active.contains(a.anchor) && active.contains(b.anchor);
        // Doubly seen space, before the union (2.7.5).
        let touches = |ring: &[Corner]| ring.iter().any(|corner| active.contains(corner.anchor));
        self.untwist_where(touches, is_active, self.params.twisted, probe);
        let keep_points = self.params.keep_intersections;
        let mut united = unite(&self.rings, &view, &active, keep_points);
        if united.is_err() && self.merge_sheets(&active, probe) {
            united = unite(&self.rings, &view, &active, keep_points);
        }
        if united.is_err() {
            united = unite_apart(&self.rings, &view, &active, keep_points);
        }
        let united = united.and_then(|united| match holds_robot(&united, &view) {
            true => Ok(united),
            false => Err(Broken::RobotOutside),
        });
        match united {
            Ok(united) => {
                self.tell_union(vertex, &view, &united, probe);
                self.rings = united.rings;
            }
            Err(why) => {
                self.invalid += 1;
                probe.emit(PolygonEvent::Invalid { vertex, why });
            }
        }
    }

    /// Unites sheets that lie over each other in the area (2.7.3); whether there were any.
    fn merge_sheets(&mut self, active: &Area, probe: &mut dyn MapProbe) -> bool {
        let before = self.rings.len();
        let merged = merge_sheets(&mut self.rings, active, self.params.keep_intersections);
        for crossing in &merged {
            let (at, entry) = (crossing.at, crossing.entry);
            probe.emit(PolygonEvent::Intersected { at, entry });
            probe.emit(PolygonEvent::Merged { at });
        }
        !merged.is_empty() || self.rings.len() < before
    }

    /// Settles frontier along walls, both ways between the view and what the area saw before.
    fn settle_walls(&mut self, vertex: VertexId, view: &mut Vec<Corner>, active: &Area) {
        let radius_m = self.params.open.wall_closing_m;
        let Some(around) = box_of(view) else { return };
        let mut walls = Vec::new();
        let Some(volume) = self.here.volume(vertex) else { return };
        walls_near(vertex, volume, &self.correction.pose(vertex), around, radius_m, &mut walls);
        let takes = |corner: &Corner| active.contains(corner.edge.data.vertex);
        for ring in &mut self.rings {
            settle_along(ring, takes, &walls, radius_m);
        }
        walls.clear();
        for &other in active.vertices() {
            if let Some(volume) = self.views.get(other).and_then(Option::as_deref) {
                let map_from_other = self.correction.pose(other);
                walls_near(other, volume, &map_from_other, around, radius_m, &mut walls);
            }
        }
        settle_along(view, |_| true, &walls, radius_m);
    }

    fn tell_union(
        &self,
        vertex: VertexId,
        view: &[Corner],
        united: &United,
        probe: &mut dyn MapProbe,
    ) {
        if !Probe::<PolygonEvent<'_>>::on(probe) {
            return;
        }
        for crossing in &united.crossings {
            let (at, entry) = (crossing.at, crossing.entry);
            probe.emit(PolygonEvent::Intersected { at, entry });
        }
        if united.followed > 0 {
            probe.emit(PolygonEvent::Followed { vertex, found: united.followed });
        }
        for crossing in &united.crossings {
            probe.emit(PolygonEvent::Merged { at: crossing.at });
        }
        for ring in united.rings.iter().rev().take(united.loops) {
            let (corners, area_m2) = (ring.len(), 0.5 * twice_area_m2(ring));
            probe.emit(PolygonEvent::LoopClosed { corners, area_m2 });
        }
        let view = region_of_rings(&[view.to_vec()]);
        let region = region_of_rings(&united.rings);
        probe.emit(PolygonEvent::United { vertex, view: &view, region: &region });
    }

    /// Moves every corner with its anchor (eq. 2.12), then mends what that has twisted (2.7.3).
    fn follow_poses(&mut self, before: &[Se2], at: VertexId, probe: &mut dyn MapProbe) {
        let motions: Vec<Se2> = before
            .iter()
            .zip(self.correction.poses())
            .map(|(old, new)| *new * old.inverse())
            .collect();
        let mut moved_max_m: f64 = 0.0;
        for corner in self.rings.iter_mut().flatten() {
            let Some(motion) = motions.get(corner.anchor.0 as usize) else { continue };
            let moved = motion.transform(&corner.at);
            moved_max_m = moved_max_m.max((moved - corner.at).norm());
            corner.at = moved;
        }
        if Probe::<PolygonEvent<'_>>::on(probe) {
            let region = region_of_rings(&self.rings);
            probe.emit(PolygonEvent::CornersMoved { moved_max_m, region: &region });
        }
        let inner = |ring: &[Corner]| twice_area_m2(ring) <= 0.0;
        self.untwist_where(inner, |_, _| true, self.params.twisted, probe);
        let active = self.area(at);
        let is_active =
            |a: &Corner, b: &Corner| active.contains(a.anchor) && active.contains(b.anchor);
        // Overlapping active parts of an outer ring are merged: what is doubly known goes.
        let outer = |ring: &[Corner]| {
            twice_area_m2(ring) > 0.0 && ring.iter().any(|c| active.contains(c.anchor))
        };
        self.untwist_where(outer, is_active, Twisted::Remove, probe);
        self.measure();
    }

    pub(super) fn measure(&mut self) {
        let discs = self.given_up.discs(|vertex| self.correction.pose(vertex));
        // Walls have settled what they settle when views were united.
        let params = OpenParams { wall_closing_m: 0.0, ..self.params.open };
        self.open = OpenFrontier::of(&region_of_rings(&self.rings), &params, &discs);
    }

    /// The open frontier that is anchored inside the area (2.9.2).
    pub(super) fn open_inside(&self, active: &Area) -> OpenFrontier {
        let mut inside = self.open.clone();
        inside
            .chains
            .retain(|chain| chain.parts.iter().any(|part| active.contains(part.tag.vertex)));
        inside
    }

    /// What the views of the area saw, united.
    pub(super) fn region_inside(&self, active: &Area) -> Region<Tag> {
        let view = |vertex| self.views.get(vertex)?.as_deref();
        region_inside(active, view, |vertex| self.correction.pose(vertex))
    }

    fn corrected(&mut self, before: Vec<Se2>, corrected: bool, probe: &mut dyn MapProbe) {
        // A correction that moves nothing leaves nothing to mend.
        if corrected
            && self.correction.has_moved()
            && let Some(last) = before.len().checked_sub(1)
        {
            self.follow_poses(&before, VertexId(last as u32), probe);
        }
    }
}

/// Whether a point just before the robot is known to be free.
fn holds_robot(united: &United, view: &[Corner]) -> bool {
    let Some(first) = view.first() else { return true };
    let second = &view[next(view, 0)];
    // Half-way along the view's first side, a little towards the middle of all corners.
    let middle = view.iter().fold(geometry::Vector2::zeros(), |sum, c| sum + c.at.coords);
    let middle = middle / view.len() as f64;
    let side = (first.at.coords + second.at.coords) * 0.5;
    let inside = [0.01, 0.1, 0.3, 0.5]
        .map(|share| Point2::from(side + (middle - side) * share))
        .into_iter()
        .find(|point| winding(view, point) > 0);
    // A view so thin that no such point lies in it says nothing.
    inside
        .is_none_or(|point| united.rings.iter().map(|ring| winding(ring, &point)).sum::<i32>() > 0)
}

impl ExplorationMap for ActiveArea {
    fn kind(&self) -> &'static str {
        "active_area"
    }

    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], probe: &mut dyn MapProbe) {
        edges.iter().for_each(|&edge| self.links.add(graph, edge));
        // Odometry first: what is new has to be somewhere before it is corrected.
        let odometry = |&&edge: &&EdgeId| graph.edge(edge).kind == posegraph::EdgeKind::Odometry;
        let wheels: Vec<EdgeId> = edges.iter().filter(odometry).copied().collect();
        self.correction.edges_added(graph, &wheels, probe);
        let before = self.correction.poses().to_vec();
        let places = edges.len() - wheels.len();
        if places > 0 {
            let last = edges.iter().map(|&edge| graph.edge(edge)).map(|edge| edge.a.max(edge.b));
            last.for_each(|vertex| self.correction.cover(vertex));
            let corrected = self.correction.optimise(graph, places, probe);
            self.corrected(before, corrected, probe);
        }
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph, edge: EdgeId, probe: &mut dyn MapProbe) {
        self.links.remove(edge);
        let before = self.correction.poses().to_vec();
        let corrected = self.correction.optimise(graph, 0, probe);
        self.corrected(before, corrected, probe);
    }

    fn poses_reestimated(&mut self, map_from_vertex: &[Se2], probe: &mut dyn MapProbe) {
        let before = self.correction.poses().to_vec();
        self.correction.set(map_from_vertex);
        self.corrected(before, true, probe);
    }

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let vertex = standing.vertex;
        if let Some((dual, way)) = self.planner.take_planned() {
            probe.emit(PolygonEvent::WayPlanned { dual: &dual, way: &way });
        }
        self.scans += 1;
        self.correction.cover(vertex);
        self.links.cover(vertex);
        self.here.scanned(standing, scan, probe);
        while self.views.next_id() <= vertex {
            self.views.push(None);
        }
        self.views[vertex] = self.here.volume(vertex).cloned().map(Box::new);
        self.unite_view(vertex, probe);
        self.measure();
        if Probe::<PolygonEvent<'_>>::on(probe) {
            let region = region_of_rings(&self.rings);
            let open = &self.open;
            probe.emit(PolygonEvent::Settled { standing: vertex, region: &region, open });
        }
    }

    fn frontier(&self) -> Frontier {
        self.open.summary()
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        let map_from_body = self.map_from_body(standing);
        let open = self.open_inside(&self.area(standing.vertex));
        self.planner.in_view(&self.here, &open, &map_from_body, standing, out);
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        let map_from_body = self.map_from_body(standing);
        let open = self.open_inside(&self.area(standing.vertex));
        self.planner.around(&self.here, &open, &map_from_body, standing, out);
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        self.here.clearance(standing, to_in_body)
    }

    /// Inside the area by the dual graph; else back along the graph (2.9.3). What neither leads to is
    /// given up: it is believed to be out of reach.
    fn route(&mut self, standing: &Standing, _clearance_m: f64) -> Option<Route> {
        let route = self.way_on(standing);
        if route.is_none() {
            let map_from_vertex = self.correction.pose(standing.vertex);
            self.given_up.add_all(&self.open, standing.vertex, &map_from_vertex);
            self.measure();
        }
        route
    }

    /// Length of the frontier that is anchored to a vertex.
    fn frontier_at(&self, vertex: VertexId) -> f64 {
        let parts = self.open.counting().flat_map(|chain| &chain.parts);
        parts.filter(|part| part.tag.vertex == vertex).map(|part| part.length_m()).sum()
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        self.here.detour(standing, goal_in_body, clearance_m)
    }

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
        let point = self.map_from_body(standing).transform(point_in_body);
        self.rings.iter().map(|ring| winding(ring, &point)).sum::<i32>() > 0
    }

    fn corrections(&self) -> u64 {
        self.correction.count()
    }

    fn global(&self) -> Option<GlobalBelief> {
        Some(global_of(&region_of_rings(&self.rings), self.correction.poses()))
    }

    fn invalid(&self) -> u64 {
        self.invalid
    }

    fn bytes(&self) -> usize {
        let corners: usize = self.rings.iter().map(Vec::len).sum();
        let views: usize =
            self.views.iter().filter_map(Option::as_deref).map(LocalVolume::heap_bytes).sum();
        corners * size_of::<Corner>()
            + views
            + self.links.heap_bytes()
            + self.correction.heap_bytes()
            + self.here.heap_bytes()
            + self.given_up.heap_bytes()
    }
}
