//! The map: what it holds, and what became of it.

use pose::Se3;
use probe::VertexId;
use solid::{Point3, Polyhedron};

use super::ask::in_sight;
use super::patches::Frontier;
use super::places::{GivenUp, InVain, Place};
use super::poses::Poses;
use super::surface::Surface;
use super::view::View;
use super::volumes::Volumes;
use super::{UnionCounts, UnionEvent, UnionParams};
use crate::{FrontierPoint, Hovering, Map3dProbe, MapWork, Maps3dError};

/// Frontier within this of a place is looked at together, and given up together, metres.
const IN_VAIN_M: f64 = 0.75;

/// A look tells of frontier up to this share of its reach.
const IN_VIEW: f64 = 0.75;

/// It tells nothing of frontier that it sees along, by the cosine of the angle to the normal.
const LEAST_ACROSS: f64 = 0.1;

/// The united polyhedron of all views ([`global_union`](super)).
#[derive(Debug)]
pub struct UnionMap {
    pub(super) params: UnionParams,
    pub(super) poses: Poses,
    pub(super) views: Vec<View>,
    /// The united map.
    pub(super) united: Surface,
    /// Views that the union refused, in the frame `map`.
    pub(super) aside: Vec<Surface>,
    pub(super) frontier: Frontier,
    pub(super) given_up: GivenUp,
    pub(super) in_vain: InVain,
    pub(super) volumes: Option<Volumes>,
    pub(super) counts: UnionCounts,
    pub(super) work: MapWork,
    /// Faces of the map when it was cleaned last.
    pub(super) cleaned_faces: usize,
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
            in_vain: InVain::default(),
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

    pub(super) fn surfaces(&self) -> Vec<&Surface> {
        std::iter::once(&self.united).chain(&self.aside).collect()
    }

    pub(super) fn map_from_body(&self, hovering: &Hovering) -> Se3 {
        self.poses.of(hovering.vertex) * hovering.vertex_from_body
    }

    /// Step 4, after anything that it depends on changed.
    pub(super) fn sort(&mut self, probe: &mut dyn Map3dProbe) {
        let given_up = self.given_up.in_map(&self.poses);
        self.frontier = Frontier::of(&self.surfaces(), &given_up, &self.params);
        let Frontier { patches, sliver_m2, .. } = &self.frontier;
        probe.emit(UnionEvent::Sorted { patches, sliver_m2: *sliver_m2 });
    }

    pub(super) fn give_up_in_map(
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

    /// Step 4 after a look: what it had in view and is still there was looked at in vain, and is given up after
    /// so many looks as are allowed.
    pub(super) fn give_up_in_vain(&mut self, number: usize, probe: &mut dyn Map3dProbe) {
        let (view, allowed) = (&self.views[number], self.params.looks_in_vain);
        if allowed == 0 {
            return;
        }
        let (vertex, camera) = (view.vertex, Point3::from(view.map_from_camera.translation));
        let patches = &self.frontier.patches;
        let in_sight = in_sight(&self.surfaces(), patches, &camera, IN_VIEW * self.params.reach_m);
        let points = in_sight.iter().flat_map(|patch| &patch.points);
        let is_looked_at = |point: &&FrontierPoint| {
            let by = point.in_body - camera;
            by.dot(&point.normal_in_body) > LEAST_ACROSS * by.norm() && view.shows(&point.in_body)
        };
        let places: Vec<Point3> = points.filter(is_looked_at).map(|point| point.in_body).collect();
        let vertex_from_map = self.poses.of(vertex).inverse();
        let mut given_up = false;
        for place in places {
            let in_vertex = vertex_from_map.transform(&place);
            let radius_m = IN_VAIN_M;
            if self.in_vain.note(Place { vertex, in_vertex, radius_m }, &self.poses) >= allowed {
                self.give_up_in_map(vertex, place, radius_m, false, probe);
                given_up = true;
            }
        }
        if given_up {
            self.sort(probe);
        }
    }
}
