//! The robot itself: observations on the outside, truth on the inside.

use std::sync::Arc;

use geometry::Vector3;
use pose::Se3;
use probe::{Id, VertexId};
use sensing::{DepthImage, Flight, FlyingRobot, Returned, SpaceMatch};

use super::motion::yaw;
use super::recognition::error;
use super::{FlyerParams, SpaceView};
use crate::robot::links::Links;
use crate::robot::random::{Purpose, Streams};
use crate::{Tally, World3d, WorldError};

/// A robot in a [`World3d`]: a ball that hovers upright and turns about the vertical.
///
/// Through [`FlyingRobot`] it offers what a real one would know. The methods of the type itself tell the
/// truth, for metrics and viewers only. All randomness follows from the seed: the noise of flight k
/// depends on the seed and on k alone, whatever was looked at, marked or repeated in between.
#[derive(Clone, Debug)]
pub struct SimFlyer {
    pub(super) world: Arc<World3d>,
    pub(super) params: FlyerParams,
    pub(super) streams: Streams,
    pub(super) world_from_body: Se3,
    pub(super) tally: Tally,
    pub(super) marks: Vec<Option<Se3>>,
    pub(super) links: Links,
    pub(super) hovers_at: Option<VertexId>,
    pub(super) mark_count: u64,
    pub(super) view: SpaceView,
    since_vertex_m: f64,
    repeat_count: u64,
}

impl SimFlyer {
    /// A robot at the start of a place.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] for what is out of its range; [`WorldError::StartTooTight`] where the body
    /// does not fit at the start.
    pub fn new(world: Arc<World3d>, params: FlyerParams, seed: u64) -> Result<Self, WorldError> {
        params.check()?;
        let world_from_body = world.world_from_start();
        let clearance_m = world.caster().distance_to(&world_from_body.translation.into());
        if clearance_m <= params.radius_m {
            return Err(WorldError::StartTooTight { radius_m: params.radius_m, clearance_m });
        }
        let view = SpaceView {
            world_from_camera: world_from_body * params.camera.body_from_camera(),
            camera: params.camera.camera(),
            columns: params.camera.columns,
            depths_m: vec![0.0; params.camera.columns * params.camera.rows],
            far_m: params.camera.far_m,
        };
        Ok(Self {
            streams: Streams::new(seed),
            world,
            params,
            world_from_body,
            tally: Tally {
                distance_m: 0.0,
                turning_rad: 0.0,
                forwards: 0,
                scans: 0,
                place_edges: 0,
                collisions: 0,
                bumps: 0,
                min_clearance_m: clearance_m,
            },
            marks: Vec::new(),
            links: Links::default(),
            hovers_at: None,
            mark_count: 0,
            view,
            since_vertex_m: 0.0,
            repeat_count: 0,
        })
    }

    /// The place that the robot is in.
    pub fn world(&self) -> &World3d {
        &self.world
    }

    /// What the robot is made of.
    pub fn params(&self) -> &FlyerParams {
        &self.params
    }

    /// The true pose.
    pub fn world_from_body(&self) -> Se3 {
        self.world_from_body
    }

    /// The true pose of a vertex that was marked.
    pub fn world_from_vertex(&self, vertex: VertexId) -> Option<Se3> {
        self.marks.get(vertex.index()).copied().flatten()
    }

    /// What the last look truly saw; depths of 0 before the first.
    pub fn view(&self) -> &SpaceView {
        &self.view
    }

    /// Sums over everything that the robot did.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }
}

impl FlyingRobot for SimFlyer {
    /// Turns exactly: turning is noiseless in the benchmark (\[ISRR19\] 6.1). A turn that is not finite is
    /// none.
    fn turn(&mut self, yaw_rad: f64) -> Flight {
        let yaw_rad = if yaw_rad.is_finite() { yaw_rad } else { 0.0 };
        let turn = yaw(yaw_rad);
        self.world_from_body = self.world_from_body * turn;
        self.tally.turning_rad += yaw_rad.abs();
        Flight { before_from_after: turn, distance_m: 0.0 }
    }

    /// Flies with noise on the true pose; the odometry reported is the command.
    ///
    /// A commanded flight that touches a surface counts as a collision and stops 1 mm short of it; noise
    /// that pushes the robot into one counts as a bump and stops likewise. A vector that is not finite
    /// counts as none.
    fn fly(&mut self, by_in_body: &Vector3) -> Flight {
        let is_finite = by_in_body.iter().all(|x| x.is_finite());
        let by_in_body = if is_finite { *by_in_body } else { Vector3::zeros() };
        let distance_m = by_in_body.norm();
        self.fly_truly(&by_in_body);
        self.since_vertex_m += distance_m;
        Flight { before_from_after: Se3::new(by_in_body, yaw(0.0).rotation), distance_m }
    }

    /// Puts the robot onto the true pose of `to`, and charges `length_m`.
    ///
    /// The way was flown before, so it counts no collision and no bump, unless the options add error at its
    /// end. A vertex that was never marked leaves the robot where it is.
    fn repeat(&mut self, to: VertexId, length_m: f64) -> Returned {
        let length_m = if length_m.is_finite() { length_m.max(0.0) } else { 0.0 };
        self.tally.distance_m += length_m;
        if let Some(world_from_there) = self.world_from_vertex(to) {
            self.place(world_from_there);
            let sigmas = (self.params.repeat_sigma_m, self.params.repeat_sigma_rotation_rad);
            let slip = error(self.streams.draw(Purpose::Repeat, self.repeat_count, 0), sigmas);
            if slip != Se3::identity() {
                if self.displace(self.world_from_body.rotation * slip.translation) {
                    self.tally.bumps += 1;
                }
                self.world_from_body.rotation *= slip.rotation;
            }
        }
        self.repeat_count += 1;
        self.hovers_at = Some(to);
        self.since_vertex_m = 0.0;
        Returned { vertex: to, vertex_from_body: Se3::identity(), distance_m: length_m }
    }

    /// Casts every ray from the true pose. A ray without a hit nearer than the far distance tells nothing.
    fn look(&mut self) -> DepthImage {
        self.take_image()
    }

    fn body_from_camera(&self) -> Se3 {
        self.params.camera.body_from_camera()
    }

    fn mark(&mut self, vertex: VertexId) {
        let index = vertex.index();
        if self.marks.len() <= index {
            self.marks.resize(index + 1, None);
        }
        self.marks[index] = Some(self.world_from_body);
        if let Some(left) = self.hovers_at {
            self.links.link(left, vertex, self.since_vertex_m);
        }
        self.hovers_at = Some(vertex);
        self.since_vertex_m = 0.0;
        self.mark_count += 1;
    }

    /// Known places within the radius of true distance, in line of sight, and at least `exclude_factor`
    /// radii away along the robot's own graph (\[ISRR19\] sec. 6), by id.
    fn recognize(&mut self) -> Vec<SpaceMatch> {
        self.matches()
    }
}
