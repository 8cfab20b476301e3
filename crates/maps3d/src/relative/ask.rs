//! The policy's questions: frontier of a vertex, what a point is, and what is given up.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use pose::Se3;
use posegraph::{Scope, ScopeScratch};

use super::book::Cause;
use super::events::ConsolidationEvent;
use super::pair::shape_of;
use super::parts::FrontierPart;
use super::state::GivenUp;
use super::volume::{LocalVolume, Shape};
use super::{RelativeMap, ViewState};
use crate::map::points_on;
use crate::{FrontierPatch, FrontierPoint, Hovering, Known, Map3dProbe};

/// What falls into one cell and faces one way.
#[derive(Clone, Debug, Default)]
struct Cluster {
    area_m2: f64,
    moment: Vector3<f64>,
    normal: Vector3<f64>,
    /// Middles of pieces in the frame of the vertex; the face of each, and its corners in the frame `camera`.
    points: Vec<(Point3<f64>, u16, [Point3<f64>; 3])>,
}

/// A place to go to on frontier that counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// The place, in the frame of the vertex of the view.
    pub in_vertex: Point3<f64>,
    /// Unit vector across the frontier that it stands for, into the unknown.
    pub normal_in_vertex: Vector3<f64>,
    /// The area that it stands for, square metres.
    pub area_m2: f64,
    /// The face of the volume that it lies on.
    pub face: u16,
    /// The open piece of that face, a triangle of which the place is the middle; in the frame `camera`.
    pub piece_in_camera: [Point3<f64>; 3],
}

impl RelativeMap {
    /// The frontier of the views of a vertex, one patch for each part that hangs together.
    pub(super) fn patches_of(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        out.clear();
        for &view in self.views_of(hovering.vertex) {
            let state = &self.views[view as usize];
            for part in &state.parts {
                let points = self.points_of(state, part, hovering);
                if points.is_empty() {
                    continue;
                }
                let first = part
                    .pieces
                    .first()
                    .map_or(0, |piece| u64::from(piece.face) << 16 | u64::from(piece.ring));
                out.push(FrontierPatch {
                    owner: hovering.vertex,
                    area_m2: points.iter().map(|point| point.area_m2).sum(),
                    points,
                    tag: u64::from(view) << 32 | first,
                });
            }
        }
    }

    /// A part as points in the frame `body`.
    fn points_of(
        &self,
        state: &ViewState,
        part: &FrontierPart,
        hovering: &Hovering,
    ) -> Vec<FrontierPoint> {
        let body = &hovering.vertex_from_body;
        let spots = self.spots_of(state, part).into_iter();
        let point = |spot: Spot| FrontierPoint {
            in_body: body.inverse_transform(&spot.in_vertex),
            normal_in_body: body.rotation.inverse() * spot.normal_in_vertex,
            area_m2: spot.area_m2,
        };
        spots.map(point).collect()
    }

    /// A part as places: what lies in one cell of space and faces the same of six ways is one, at the piece
    /// of the part that is nearest to its middle. The largest area first.
    pub(super) fn spots_of(&self, state: &ViewState, part: &FrontierPart) -> Vec<Spot> {
        let spacing_m = self.params.point_spacing_m;
        let mut clusters: BTreeMap<([i32; 3], usize), Cluster> = BTreeMap::new();
        state.samples(part, |sample| {
            let point = state.vertex_from_camera.transform(&sample.at);
            let normal = state.vertex_from_camera.rotation * sample.outward;
            let cell = [0, 1, 2].map(|axis| (point[axis] / spacing_m).floor() as i32);
            let way = 2 * normal.iamax() + usize::from(normal[normal.iamax()] < 0.0);
            let cluster = clusters.entry((cell, way)).or_default();
            cluster.area_m2 += sample.area_m2;
            cluster.moment += point.coords * sample.area_m2;
            cluster.normal += normal * sample.area_m2;
            cluster.points.push((point, sample.face, sample.corners));
        });
        let mut spots: Vec<Spot> = clusters
            .into_values()
            .filter(|cluster| cluster.area_m2 > 0.0)
            .filter_map(|cluster| {
                let middle = Point3::from(cluster.moment / cluster.area_m2);
                let apart = |p: &Point3<f64>| (p - middle).norm_squared();
                let nearest =
                    cluster.points.iter().min_by(|a, b| apart(&a.0).total_cmp(&apart(&b.0)))?;
                Some(Spot {
                    in_vertex: nearest.0,
                    normal_in_vertex: cluster.normal.try_normalize(0.0)?,
                    area_m2: cluster.area_m2,
                    face: nearest.1,
                    piece_in_camera: nearest.2,
                })
            })
            .collect();
        spots.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        spots
    }

    /// Frontier about these places does not count any more: that of the views of the vertex, or `everywhere`, of
    /// all in scope and of those to come.
    pub(super) fn give_up_near(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3<f64>],
        radius_m: f64,
        everywhere: bool,
        probe: &mut dyn Map3dProbe,
    ) {
        let vertex = hovering.vertex;
        let places = places_in_body.iter().map(|place| hovering.vertex_from_body.transform(place));
        let finite = |place: &Point3<f64>| place.iter().all(|x| x.is_finite()) && radius_m >= 0.0;
        let places: Vec<Point3<f64>> = places.filter(finite).collect();
        if places.is_empty() {
            return;
        }
        self.cover(vertex);
        self.take_scope(vertex, probe);
        let rows = if everywhere { self.scope.placed().len() } else { 1 };
        let first = self.given_up.len() as u32;
        if everywhere {
            self.given_up.extend(places.iter().map(|&place| (vertex, place, radius_m)));
        }
        for (at, row) in self.scope.placed()[..rows].iter().enumerate() {
            let has_views = self.views_of.get(row.vertex).is_some_and(|views| !views.is_empty());
            let path = (at > 0 && has_views)
                .then(|| self.book.remember(self.scope.path_between(&self.skeleton, at, 0)));
            for &view in self.views_of.get(row.vertex).into_iter().flatten() {
                let state = &mut self.views[view as usize];
                let (centre, ball_m) = state.open_ball;
                let mut is_near = false;
                for (place, number) in places.iter().zip(first..) {
                    let in_vertex = row.root_from_vertex.inverse_transform(place);
                    let place_in_camera = state.vertex_from_camera.inverse_transform(&in_vertex);
                    let over = path.map(|path| (path, number));
                    state.given_up.push(GivenUp { place_in_camera, radius_m, over });
                    is_near |= (place_in_camera - centre).norm() <= ball_m + radius_m;
                }
                if state.counts() && is_near {
                    state.measure(self.params.sliver_m2);
                }
            }
        }
        for place_in_vertex in places {
            probe.emit(ConsolidationEvent::GivenUp { vertex, place_in_vertex, radius_m });
        }
    }

    /// For each line, whether views in scope hold all of it but its end; retired ones as well.
    pub(super) fn lines_free(
        &mut self,
        hovering: &Hovering,
        lines_in_body: &[[Point3<f64>; 2]],
        short_m: f64,
    ) -> Vec<bool> {
        self.cover(hovering.vertex);
        self.take_scope(hovering.vertex, &mut probe::Off);
        let views = self.all_placed_views();
        let placed: Vec<(Se3, &LocalVolume)> = views
            .iter()
            .map(|at| (at.root_from_camera.inverse(), &self.views[at.view as usize].volume))
            .collect();
        // What held the last point mostly holds the next one too.
        let mut last = 0;
        let mut is_free = |point: &Point3<f64>| {
            let holds = |at: usize| {
                let (camera_from_root, volume) = &placed[at];
                volume.contains(&camera_from_root.transform(point))
            };
            if last < placed.len() && holds(last) {
                return true;
            }
            let found = (0..placed.len()).find(|&at| holds(at));
            last = found.unwrap_or(last);
            found.is_some()
        };
        let in_root = |p: &Point3<f64>| hovering.vertex_from_body.transform(p);
        lines_in_body
            .iter()
            .map(|line| points_on(&line.each_ref().map(in_root), short_m).all(|p| is_free(&p)))
            .collect()
    }

    /// What the views in scope take a point for: free inside of any, solid where it lies behind an obstacle
    /// of one, no farther than what closes frontier along walls.
    pub(super) fn known_of(&self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Known {
        let mut scope = Scope::default();
        let radius_m = self.params.consolidation_radius_m;
        ScopeScratch::default().place(&self.skeleton, hovering.vertex, radius_m, &mut scope);
        self.known_within(&scope, hovering, point_in_body)
    }

    /// The same by the views of a scope around the vertex.
    pub(super) fn known_within(
        &self,
        scope: &Scope<Se3>,
        hovering: &Hovering,
        point_in_body: &Point3<f64>,
    ) -> Known {
        let in_root = hovering.vertex_from_body.transform(point_in_body);
        let behind = Shape { inset_px: 0.0, ..shape_of(Cause::Wall, 0.0, &self.params) };
        let mut known = Known::Unknown;
        for row in scope.placed() {
            let in_vertex = row.root_from_vertex.inverse_transform(&in_root);
            for &view in self.views_of(row.vertex) {
                let state = &self.views[view as usize];
                let point = state.vertex_from_camera.inverse_transform(&in_vertex);
                if state.volume.contains(&point) {
                    return Known::Free;
                }
                let beyond = state.volume.holds(&point, behind);
                let is_solid = |face: u16| state.volume.frontier().binary_search(&face).is_err();
                if beyond.is_some_and(is_solid) {
                    known = Known::Solid;
                }
            }
        }
        known
    }
}
