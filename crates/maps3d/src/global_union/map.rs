//! The map: looks come in, questions are answered.

use pose::Se3;
use posegraph::PoseGraph;
use probe::{EdgeId, Off, Probe, VertexId};
use solid::boolean::{BooleanEvent, Options};
use solid::{Operation, Point3, Polyhedron, SolidError, boolean_with, clean, unite};

use super::ask::{clearance, in_sight, knows};
use super::patches::Frontier;
use super::places::{GivenUp, Place};
use super::poses::Poses;
use super::surface::Surface;
use super::view::{View, body_at};
use super::volumes::Volumes;
use super::walls;
use super::ways::{Wanted, to_frontier};
use super::{UnionEvent, UnionParams};
use crate::{
    DepthEvent, FlightClearance, FlightRoute, FrontierPatch, Hovering, Known, Look, Map3d,
    Map3dProbe, MapTally, MapWork, Maps3dError, polyhedron_with,
};

/// The least share of its volume that a map must keep in a union: more than rounding is never lost.
const KEPT_SHARE: f64 = 1.0 - 1e-6;

/// What was done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UnionCounts {
    /// Unions of a view with the map, those of rebuilding included.
    pub unions: u64,
    /// Views that the union refused when they came.
    pub refused: u64,
    /// Times that the pose graph was optimised.
    pub corrections: u64,
    /// Times that all views were united again.
    pub rebuilds: u64,
    /// Times that the map was filled with tetrahedra.
    pub fillings: u64,
    /// Times that it could not be.
    pub refused_fillings: u64,
    /// Ways that were planned.
    pub ways: u64,
    /// Ways that were asked for and not found.
    pub no_ways: u64,
}

/// The united polyhedron of all views ([`global_union`](super)).
#[derive(Debug)]
pub struct UnionMap {
    params: UnionParams,
    poses: Poses,
    views: Vec<View>,
    /// The united map.
    united: Surface,
    /// Views that the union refused, in the frame `map`.
    aside: Vec<Surface>,
    frontier: Frontier,
    given_up: GivenUp,
    volumes: Option<Volumes>,
    counts: UnionCounts,
    work: MapWork,
    /// Faces of the map when it was cleaned last.
    cleaned_faces: usize,
}

impl UnionMap {
    /// A map of nothing.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn new(params: UnionParams) -> Result<Self, Maps3dError> {
        params.check()?;
        Ok(Self {
            params,
            poses: Poses::default(),
            views: Vec::new(),
            united: Surface::new(Polyhedron::empty()),
            aside: Vec::new(),
            frontier: Frontier::default(),
            given_up: GivenUp::default(),
            volumes: None,
            counts: UnionCounts::default(),
            work: MapWork::default(),
            cleaned_faces: 0,
        })
    }

    /// How it is made.
    pub fn params(&self) -> &UnionParams {
        &self.params
    }

    /// The united views, in the frame `map`.
    pub fn polyhedron(&self) -> &Polyhedron {
        &self.united.mesh
    }

    /// Where vertices are, by vertex.
    pub fn map_from_vertex(&self) -> &[Se3] {
        self.poses.all()
    }

    /// What was done so far.
    pub fn counts(&self) -> UnionCounts {
        self.counts
    }

    /// Number of looks in the map.
    pub fn looks(&self) -> usize {
        self.views.len()
    }

    /// Number of views that stand beside the union because it refused them.
    pub fn beside(&self) -> usize {
        self.aside.len()
    }

    /// Fills the map with tetrahedra, if they are not there already; tells how many there are.
    ///
    /// Cost: that of [`solid::tetrahedralize`] after each look.
    pub fn fill(&mut self, probe: &mut dyn Map3dProbe) -> usize {
        match self.volumes.take() {
            Some(volumes) => self.volumes.insert(volumes).len(),
            None => {
                let (volumes, filled) = Volumes::new(&self.united.mesh, &self.views, probe);
                match filled {
                    Ok(()) => self.counts.fillings += 1,
                    Err(_) => self.counts.refused_fillings += 1,
                }
                self.work.tetrahedra = volumes.len();
                self.volumes.insert(volumes).len()
            }
        }
    }

    fn options(&self) -> Options {
        Options { coincident_m: self.params.coincident_m, ..Options::default() }
    }

    fn surfaces(&self) -> Vec<&Surface> {
        std::iter::once(&self.united).chain(&self.aside).collect()
    }

    fn map_from_body(&self, hovering: &Hovering) -> Se3 {
        self.poses.of(hovering.vertex) * hovering.vertex_from_body
    }

    /// The operand of a view: where it is in the map, with the place that the robot takes up.
    fn operand(&self, number: usize) -> Polyhedron {
        let view = &self.views[number];
        let placed = view.placed(number as u32, self.params.jitter_m);
        let is_first = !self.views[..number].iter().any(|other| other.vertex == view.vertex);
        if !is_first {
            return placed;
        }
        let at = Point3::from(self.poses.of(view.vertex).translation);
        let Some(body) = body_at(&at, self.params.body_m) else { return placed };
        solid::boolean(&placed, &body, Operation::Union, &self.options()).unwrap_or(placed)
    }

    /// Step 2 for one view: the map with it, and how many faces the obstacle won.
    fn united_with(&self, operand: &Surface) -> Result<(Polyhedron, usize), SolidError> {
        let before = &self.united.mesh;
        if before.is_empty() {
            return Ok((unite(std::slice::from_ref(&operand.mesh), &self.options())?, 0));
        }
        let mut settled = Settled(0);
        let operation = Operation::Union;
        let after = boolean_with(before, &operand.mesh, operation, &self.options(), &mut settled)?;
        let (had_m3, has_m3) = (before.volume_m3(), after.volume_m3());
        if has_m3 < KEPT_SHARE * had_m3 {
            let reason = format!("of {had_m3} cubic metres {has_m3} were left");
            return Err(SolidError::Engine { operation: operation.name(), reason });
        }
        let (after, by_walls) = walls::settle(after, [&self.united, operand], self.params.wall_m);
        Ok((after, settled.0 + by_walls))
    }

    /// Steps 1 to 3 for the view of this number, which is in the list already.
    fn unite_one(&mut self, number: usize, probe: &mut dyn Map3dProbe) {
        let operand = self.operand(number);
        let View { vertex, map_from_camera, .. } = self.views[number];
        let view = number as u32;
        probe.emit(UnionEvent::Placed { view, vertex, map_from_camera, operand: &operand });
        let operand = Surface::new(operand);
        self.counts.unions += 1;
        match self.united_with(&operand) {
            Ok((map, settled)) => {
                probe.emit(UnionEvent::United { view, map: &map, settled });
                self.united = Surface::new(self.cleaned(map, probe));
            }
            Err(why) => {
                self.counts.refused += 1;
                self.views[number].aside = true;
                probe.emit(UnionEvent::Refused { view, why: &why });
                self.aside.push(operand);
            }
        }
    }

    /// Step 3, whenever the map grew enough.
    fn cleaned(&mut self, map: Polyhedron, probe: &mut dyn Map3dProbe) -> Polyhedron {
        let grown =
            map.faces().len() as f64 >= self.params.clean_growth * self.cleaned_faces as f64;
        if self.params.clean_m <= 0.0 || !grown {
            return map;
        }
        let cleaned = clean(&map, self.params.clean_m);
        self.cleaned_faces = cleaned.mesh.faces().len();
        probe.emit(UnionEvent::Cleaned { map: &cleaned.mesh, removed: &cleaned.removed });
        cleaned.mesh
    }

    /// Step 4, after anything that it depends on changed.
    fn sort(&mut self, probe: &mut dyn Map3dProbe) {
        let given_up = self.given_up.in_map(&self.poses);
        self.frontier = Frontier::of(&self.surfaces(), &given_up, &self.params);
        let Frontier { patches, sliver_m2, .. } = &self.frontier;
        probe.emit(UnionEvent::Sorted { patches, sliver_m2: *sliver_m2 });
    }

    /// Step 5: unites all views again if any of them moved by more than is let pass.
    fn follow(&mut self, probe: &mut dyn Map3dProbe) {
        let mut moved_max_m = 0.0_f64;
        for view in &self.views {
            let now = self.poses.of(view.vertex) * view.vertex_from_camera;
            moved_max_m = moved_max_m.max(view.moves_by(&now));
        }
        if moved_max_m <= self.params.rebuild_m {
            return;
        }
        for view in &mut self.views {
            view.map_from_camera = self.poses.of(view.vertex) * view.vertex_from_camera;
            view.aside = false;
        }
        self.counts.rebuilds += 1;
        (self.volumes, self.cleaned_faces) = (None, 0);
        self.aside.clear();
        self.united = Surface::new(Polyhedron::empty());
        (0..self.views.len()).for_each(|number| self.unite_one(number, probe));
        let (views, map) = (self.views.len(), &self.united.mesh);
        probe.emit(UnionEvent::Rebuilt { views, moved_max_m, map });
        self.sort(probe);
    }

    fn give_up_in_map(
        &mut self,
        vertex: VertexId,
        place: Point3,
        radius_m: f64,
        unreachable: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        let in_vertex = self.poses.of(vertex).inverse_transform(&place);
        self.given_up.add(Place { vertex, in_vertex, radius_m });
        probe.emit(UnionEvent::GivenUp { place, radius_m, unreachable });
    }
}

/// Counts the faces that the obstacle won.
struct Settled(usize);

impl Probe<BooleanEvent<'_>> for Settled {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, event: BooleanEvent<'_>) {
        if let BooleanEvent::Settled { faces } = event {
            self.0 += faces.len();
        }
    }
}

/// Hands the events of a view on.
struct Relay<'a>(&'a mut dyn Map3dProbe);

impl Probe<DepthEvent<'_>> for Relay<'_> {
    fn on(&self) -> bool {
        Probe::<DepthEvent<'_>>::on(self.0)
    }

    fn emit(&mut self, event: DepthEvent<'_>) {
        self.0.emit(event);
    }
}

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
        let pose = &look.vertex_from_camera;
        let finite = pose.translation.iter().chain(pose.rotation.coords.iter());
        if !finite.copied().all(f64::is_finite) {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        let made = polyhedron_with(look.image, &self.params.view, &mut Relay(&mut *probe))?;
        self.poses.cover(look.vertex);
        let map_from_camera = self.poses.of(look.vertex) * look.vertex_from_camera;
        let view = View {
            vertex: look.vertex,
            vertex_from_camera: look.vertex_from_camera,
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
        let found = to_frontier(&mut volumes, &from, &wanted);
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
        place_in_body: &Point3,
        radius_m: f64,
        _everywhere: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        let place = self.map_from_body(hovering).transform(place_in_body);
        self.give_up_in_map(hovering.vertex, place, radius_m, false, probe);
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
            + self.volumes.as_ref().map_or(0, Volumes::heap_bytes)
    }
}

#[cfg(test)]
mod tests {
    use sensing::{Camera, DepthImage};
    use solid::Label;

    use super::*;

    /// Takes views whose polyhedra are given: what a depth image never gives can be tried.
    fn take(map: &mut UnionMap, in_camera: Polyhedron, x_m: f64) {
        let map_from_camera =
            Se3::new(nalgebra::Vector3::new(x_m, 0.0, 0.0), Se3::identity().rotation);
        map.poses.cover(VertexId(0));
        map.views.push(View {
            vertex: VertexId(0),
            vertex_from_camera: map_from_camera,
            in_camera,
            map_from_camera,
            aside: false,
        });
        map.unite_one(map.views.len() - 1, &mut Off);
        map.sort(&mut Off);
    }

    fn view() -> Polyhedron {
        let camera = Camera::new(30.0, 30.0, 15.5, 11.5);
        let image = DepthImage::new(32, camera, vec![3.0; 32 * 24]);
        let options = UnionParams::default().view;
        crate::polyhedron(&image, &options).expect("a sound image").polyhedron
    }

    #[test]
    fn a_view_that_the_union_refuses_stands_beside_the_map() {
        let mut map = UnionMap::new(UnionParams::default()).expect("usual options");
        take(&mut map, view(), 0.0);
        let (before, open_m2) = (map.polyhedron().clone(), map.tally().open_m2);
        // A view that lacks a face is no closed 2-manifold.
        let (vertices, mut faces, mut labels, _) = view().into_parts();
        let lost = faces.len() - 1;
        faces.truncate(lost);
        labels.truncate(lost);
        let open = Polyhedron::try_new(vertices, faces, labels).expect("faces that exist");
        take(&mut map, open, 1.0);
        assert!(map.polyhedron() == &before);
        assert_eq!((map.counts.refused, map.beside(), map.looks()), (1, 1, 2));
        assert_eq!(map.work().refused, 1);
        // Its frontier counts where it is outside of the map, and ways lead into its fan.
        assert!(map.tally().open_m2 > 0.5 * open_m2);
        map.fill(&mut Off);
        let volumes = map.volumes.as_mut().expect("it was filled");
        let planner = volumes.planner(0.0).expect("sound tetrahedra");
        let (from, to) = (Point3::new(-0.5, 0.0, 2.0), Point3::new(2.0, 0.0, 2.5));
        let plan = planner.plan(&from, &crate::Target::Point(to)).expect("both are inside");
        assert!(plan.is_some_and(|plan| plan.path_m < 3.0));
    }

    #[test]
    fn what_cannot_be_filled_is_fanned() {
        let mut map = UnionMap::new(UnionParams::default()).expect("usual options");
        take(&mut map, view(), 0.0);
        // A map that meets itself, as engines may leave one where faces are coplanar to rounding.
        let (low, high) = (Point3::new(0.0, 0.0, 1.0), Point3::new(1.0, 1.0, 2.0));
        let cube = Polyhedron::cuboid(&low, &high, Label::Frontier);
        let (mut vertices, mut faces, mut labels, _) = cube.clone().into_parts();
        let first = vertices.len() as u32;
        vertices.extend(cube.vertices().iter().map(|v| v + nalgebra::Vector3::repeat(0.3)));
        faces.extend(cube.faces().iter().map(|face| face.map(|v| v + first)));
        labels.extend(cube.labels());
        let crossed = Polyhedron::try_new(vertices, faces, labels).expect("faces that exist");
        map.united = Surface::new(crossed);
        assert!(map.fill(&mut Off) >= 2, "the fan of the one view, a wall of two faces at least");
        assert_eq!((map.counts.fillings, map.counts.refused_fillings), (0, 1));
        assert_eq!(map.work().refused, 1);
    }
}
