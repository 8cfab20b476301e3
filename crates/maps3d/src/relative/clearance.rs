//! How near a straight motion comes to what the views of one vertex saw, and to where they end.

use geometry::planar::overlay::StepRings;
use nalgebra::Point3;
use probe::VertexId;

use super::RelativeMap;
use super::book::Cause;
use super::distance::{motion_triangle, point_triangle};
use super::grid::FaceGrid;
use super::ledger::OpenPart;
use super::pair::{Pair, shape_of};
use super::parts::rings_of;
use super::samples::triangles;
use crate::{FlightClearance, Hovering};

/// Shells of so many vertices are kept: a policy asks about one many times, and then about those nearby.
const KEPT: usize = 4;

/// Where the views of one vertex, taken together, end: in its frame, metres.
#[derive(Clone, Debug)]
pub(super) struct Shell {
    pub vertex: VertexId,
    corners: Box<[Point3<f32>]>,
    /// Triangles of `corners`.
    solid: Box<[[u32; 3]]>,
    unseen: Box<[[Point3<f32>; 3]]>,
}

impl Shell {
    pub fn heap_bytes(&self) -> usize {
        size_of_val(&*self.corners) + size_of_val(&*self.solid) + size_of_val(&*self.unseen)
    }
}

impl RelativeMap {
    pub(super) fn motion_clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3<f64>,
        leaving_m: f64,
    ) -> FlightClearance {
        let to = hovering.vertex_from_body.transform(to_in_body);
        if self.views_of(hovering.vertex).is_empty() || !to.iter().all(|x| x.is_finite()) {
            return FlightClearance::NONE;
        }
        let from = Point3::from(hovering.vertex_from_body.translation);
        self.take_shell(hovering.vertex);
        let Some(shell) = self.shells.first() else { return FlightClearance::NONE };
        let mut clearance = FlightClearance {
            solid_at_start_m: f64::INFINITY,
            solid_m: f64::INFINITY,
            solid_at_end_m: f64::INFINITY,
            unseen_m: f64::INFINITY,
            unseen_at_end_m: f64::INFINITY,
        };
        for corners in &shell.solid {
            let [a, b, c] = corners.map(|corner| shell.corners[corner as usize].cast::<f64>());
            let triangle = [&a, &b, &c];
            if may_be_nearer(&from, &to, triangle, clearance.solid_m) {
                let near_m = motion_triangle(&from, &to, triangle);
                clearance.solid_m = clearance.solid_m.min(near_m);
            }
            for (at, least_m) in
                [(&from, &mut clearance.solid_at_start_m), (&to, &mut clearance.solid_at_end_m)]
            {
                if may_be_nearer(at, at, triangle, *least_m) {
                    *least_m = least_m.min(point_triangle(at, triangle));
                }
            }
        }
        let length_m = (to - from).norm();
        let leaves_at = (leaving_m / length_m.max(1e-12)).min(1.0);
        let late = from + (to - from) * leaves_at;
        for corners in &shell.unseen {
            let [a, b, c] = corners.map(|p| p.cast::<f64>());
            let triangle = [&a, &b, &c];
            if leaves_at < 1.0 && may_be_nearer(&late, &to, triangle, clearance.unseen_m) {
                let near_m = motion_triangle(&late, &to, triangle);
                clearance.unseen_m = clearance.unseen_m.min(near_m);
            }
            if may_be_nearer(&to, &to, triangle, clearance.unseen_at_end_m) {
                let near_m = point_triangle(&to, triangle);
                clearance.unseen_at_end_m = clearance.unseen_at_end_m.min(near_m);
            }
        }
        if !self.is_seen_from(hovering.vertex, &to) {
            clearance.unseen_at_end_m = 0.0;
            if leaves_at < 1.0 {
                clearance.unseen_m = 0.0;
            }
        } else if leaves_at < 1.0 && !self.is_seen_from(hovering.vertex, &late) {
            clearance.unseen_m = 0.0;
        }
        clearance
    }

    /// Whether a point of the frame of a vertex lies in one of its views.
    fn is_seen_from(&self, vertex: VertexId, point: &Point3<f64>) -> bool {
        self.views_of(vertex).iter().any(|&view| {
            let state = &self.views[view as usize];
            state.volume.contains(&state.vertex_from_camera.inverse_transform(point))
        })
    }

    /// Puts the shell of a vertex first among those kept, and makes it where there is none.
    fn take_shell(&mut self, vertex: VertexId) {
        if let Some(at) = self.shells.iter().position(|shell| shell.vertex == vertex) {
            self.shells[..=at].rotate_right(1);
            return;
        }
        let shell = self.shell_of(vertex);
        self.shells.truncate(KEPT - 1);
        self.shells.insert(0, shell);
    }

    /// Obstacle faces of all views of a vertex; and of their frontier, what none of them sees beyond, where
    /// it hangs together over more than a sliver.
    fn shell_of(&mut self, vertex: VertexId) -> Shell {
        let (mut corners, mut solid, mut unseen) = (Vec::new(), Vec::new(), Vec::new());
        let mut work = std::mem::take(&mut self.work);
        let (mut all, mut rings) = (StepRings::new(), StepRings::new());
        let numbers = self.views_of(vertex);
        let inside = (Cause::Inside, shape_of(Cause::Inside, 0.0, &self.params));
        for &view in numbers {
            let state = &self.views[view as usize];
            let vertex_from_camera = &state.vertex_from_camera;
            let first = corners.len() as u32;
            corners.extend((0..state.volume.corner_count() as u16).map(|corner| {
                vertex_from_camera.transform(&state.volume.corner(corner)).cast::<f32>()
            }));
            solid.extend(
                state
                    .volume
                    .obstacles()
                    .map(|face| state.volume.face(face).map(|corner| first + u32::from(corner))),
            );
            let mut bare = state.clone();
            bare.open.fill(OpenPart::default());
            for &against in numbers.iter().filter(|&&other| other != view) {
                let other = &self.views[against as usize];
                let camera_from_against = vertex_from_camera.inverse_mul(&other.vertex_from_camera);
                let pair = Pair { view, against, camera_from_against, odometry_m: 0.0 };
                work.close(&bare, &other.volume, &pair, inside, |_| true);
                for (face, after) in work.changed.drain(..) {
                    bare.open[face] = after;
                }
            }
            // Slivers hide nothing, and would keep the robot from leaving.
            bare.given_up.clear();
            bare.measure(self.params.sliver_m2);
            for &piece in bare.parts.iter().flat_map(|part| &part.pieces) {
                let index = usize::from(piece.face);
                let corners = state.volume.points(state.volume.frontier()[index]);
                let face = FaceGrid::new(corners.map(|p| vertex_from_camera.transform(&p)));
                rings_of(&bare.open[index], piece, &mut all, &mut rings);
                triangles(&rings, |piece| {
                    unseen.push(piece.map(|place| face.point(place).cast::<f32>()));
                });
            }
        }
        self.work = work;
        Shell { vertex, corners: corners.into(), solid: solid.into(), unseen: unseen.into() }
    }
}

/// Whether a triangle may come nearer to a segment than `least_m`: its first corner less its longest side.
fn may_be_nearer(
    from: &Point3<f64>,
    to: &Point3<f64>,
    [a, b, c]: [&Point3<f64>; 3],
    least_m: f64,
) -> bool {
    let side = (b - a).norm_squared().max((c - a).norm_squared()).sqrt();
    let way = to - from;
    let squared = way.norm_squared();
    let along = if squared > 0.0 { ((a - from).dot(&way) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (a - (from + way * along)).norm() - side < least_m
}
