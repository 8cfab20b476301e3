//! The robot itself: observations on the outside, truth on the inside.

use std::collections::BTreeMap;
use std::sync::Arc;

use geometry::{Point2, Vector2};
use pose::{Se2, wrap_angle};
use probe::VertexId;
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};

use super::marks::Marks;
use super::random::{Purpose, Streams};
use super::recognition::error;
use super::{RobotParams, Tally, View};
use crate::World2d;

/// A robot in a [`World2d`].
///
/// Through [`Robot`] it offers what a real one would know. The methods of the type itself tell
/// the truth, for metrics and viewers only. All randomness follows from the seed: the noise of
/// forward motion k depends on the seed and on k alone, whatever was scanned, marked or repeated
/// in between.
#[derive(Clone, Debug)]
pub struct SimRobot {
    pub(super) world: Arc<World2d>,
    pub(super) params: RobotParams,
    pub(super) streams: Streams,
    pub(super) world_from_body: Se2,
    pub(super) tally: Tally,
    pub(super) marks: Marks,
    pub(super) standing_on: Option<VertexId>,
    pub(super) since_vertex_m: f64,
    pub(super) mark_count: u64,
    /// Wrong place matches: (here, there) to `here_from_there` as it was reported.
    pub(super) false_links: BTreeMap<(VertexId, VertexId), Se2>,
    repeat_count: u64,
    view: View,
}

impl SimRobot {
    /// A robot at the start of a place.
    pub fn new(world: Arc<World2d>, params: RobotParams, seed: u64) -> Self {
        let world_from_body = world.world_from_start();
        let start = Point2::from(world_from_body.translation);
        let tally = Tally {
            distance_m: 0.0,
            turning_rad: 0.0,
            forwards: 0,
            scans: 0,
            place_edges: 0,
            collisions: 0,
            bumps: 0,
            min_clearance_m: world.caster().distance_to(&start),
        };
        let (_, bearing_step_rad) = params.sensor.bearings_rad();
        Self {
            streams: Streams::new(seed),
            marks: Marks::new(params.places.radius_m),
            world,
            params,
            world_from_body,
            tally,
            standing_on: None,
            since_vertex_m: 0.0,
            mark_count: 0,
            false_links: BTreeMap::new(),
            repeat_count: 0,
            view: View {
                world_from_sensor: world_from_body,
                ends_in_world: Vec::new(),
                hit: Vec::new(),
                bearing_step_rad,
                full_circle: false,
            },
        }
    }

    /// The place that the robot is in.
    pub fn world(&self) -> &World2d {
        &self.world
    }

    /// What the robot is made of.
    pub fn params(&self) -> &RobotParams {
        &self.params
    }

    /// The true pose.
    pub fn world_from_body(&self) -> Se2 {
        self.world_from_body
    }

    /// The true pose of a vertex that was marked.
    pub fn world_from_vertex(&self, vertex: VertexId) -> Option<Se2> {
        self.marks.pose(vertex).copied()
    }

    /// What the last scan truly saw; no ray before the first scan.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Sums over everything that the robot did.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Puts the robot onto the nearest vertex that it comes near to (\[Zie18\] 3.1).
    ///
    /// The vertex that it just left does not count, else it could never leave. The heading stays.
    fn snap(&mut self) -> Option<(VertexId, Se2)> {
        let radius_m = self.params.drive.snap_radius_m?;
        let mut near = self.marks.near(&self.position(), radius_m);
        near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let (vertex, _) = near.into_iter().find(|&(vertex, _)| {
            Some(vertex) != self.standing_on && self.in_sight(&self.world_from_body, vertex)
        })?;
        let world_from_vertex = *self.marks.pose(vertex)?;
        self.place(Se2 {
            rotation: self.world_from_body.rotation,
            translation: world_from_vertex.translation,
        });
        self.arrive(vertex);
        Some((vertex, turn_between(&world_from_vertex, &self.world_from_body)))
    }

    /// Notes that the robot came to a vertex by its own motion.
    fn arrive(&mut self, vertex: VertexId) {
        if let Some(left) = self.standing_on {
            self.marks.link(left, vertex, self.since_vertex_m);
        }
        self.standing_on = Some(vertex);
        self.since_vertex_m = 0.0;
    }

    /// Follows a link that stands for no way: the robot drives where it believes the vertex to be.
    fn follow_false_link(&mut self, here_from_there: &Se2) -> Se2 {
        let here_from_body = self
            .standing_on
            .and_then(|here| self.marks.pose(here))
            .map_or_else(Se2::identity, |pose| turn_between(pose, &self.world_from_body));
        let body_from_there = here_from_body.inverse_mul(here_from_there);
        let step = body_from_there.translation;
        let turn_rad = if step.norm() > 0.0 { step.y.atan2(step.x) } else { 0.0 };
        self.turn(turn_rad);
        if self.displace(self.world_from_body.rotation * Vector2::new(step.norm(), 0.0)) {
            self.tally.collisions += 1;
        }
        let body_from_there = Se2::from_angle(turn_rad).inverse_mul(&body_from_there);
        Se2 { rotation: body_from_there.rotation.inverse(), translation: Vector2::zeros() }
    }

    /// Stands on a vertex again, heading along the straight line from where the robot stood.
    fn follow_taught_link(&mut self, world_from_there: &Se2) -> Se2 {
        let way = world_from_there.translation - self.world_from_body.translation;
        let mut nominal = self.world_from_body;
        if way.norm() > 1e-9 {
            nominal = Se2::new(0.0, 0.0, way.y.atan2(way.x));
            let turn_rad = wrap_angle(nominal.angle() - self.world_from_body.angle());
            self.tally.turning_rad += turn_rad.abs();
        }
        nominal.translation = world_from_there.translation;
        self.place(nominal);
        let drive = &self.params.drive;
        let sigmas = (drive.repeat_sigma_m, drive.repeat_sigma_rotation_rad);
        let slip = error(self.streams.draw(Purpose::Repeat, self.repeat_count, 0), sigmas);
        if slip != Se2::identity() {
            if self.displace(self.world_from_body.rotation * slip.translation) {
                self.tally.bumps += 1;
            }
            self.world_from_body.rotation *= slip.rotation;
        }
        turn_between(world_from_there, &nominal)
    }
}

/// `a_from_b` of two poses known to be in one place: the rotation alone, the translation exactly 0.
fn turn_between(world_from_a: &Se2, world_from_b: &Se2) -> Se2 {
    Se2 { rotation: world_from_a.inverse_mul(world_from_b).rotation, translation: Vector2::zeros() }
}

impl Robot for SimRobot {
    /// Turns exactly: turning is noiseless in the benchmark (\[ISRR19\] 6.1).
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        let turn = Se2::from_angle(angle_rad);
        self.world_from_body = self.world_from_body * turn;
        self.tally.turning_rad += angle_rad.abs();
        Odometry { before_from_after: turn, distance_m: 0.0, snapped: None }
    }

    /// Drives with noise on the true pose; the odometry reported is the command.
    ///
    /// A commanded motion that touches an obstacle counts as a collision and stops 1 mm short of
    /// it; noise that pushes the robot into one counts as a bump and stops likewise. A distance
    /// that is negative or not finite counts as 0.
    fn forward(&mut self, distance_m: f64) -> Odometry {
        let distance_m = if distance_m.is_finite() { distance_m.max(0.0) } else { 0.0 };
        self.drive_forward(distance_m);
        self.since_vertex_m += distance_m;
        let snapped = self.snap();
        Odometry { before_from_after: Se2::new(distance_m, 0.0, 0.0), distance_m, snapped }
    }

    /// Puts the robot onto the true position of `to`, and charges `length_m`.
    ///
    /// The way was driven before, so it counts no collision and no bump, unless the options add
    /// error: an end error that pushes the robot into a wall is a bump; and a link that a false
    /// place match made up is driven blindly, from the believed to the believed place, so the
    /// robot may collide and ends somewhere else. A vertex that was never marked leaves the robot
    /// where it is.
    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        let length_m = if length_m.is_finite() { length_m.max(0.0) } else { 0.0 };
        self.tally.distance_m += length_m;
        let made_up = self.standing_on.and_then(|here| self.false_links.get(&(here, to)).copied());
        let vertex_from_body = match (made_up, self.marks.pose(to).copied()) {
            (Some(here_from_there), _) => self.follow_false_link(&here_from_there),
            (None, Some(world_from_there)) => self.follow_taught_link(&world_from_there),
            (None, None) => Se2::identity(),
        };
        self.repeat_count += 1;
        self.standing_on = Some(to);
        self.since_vertex_m = 0.0;
        Repeated { vertex: to, vertex_from_body, distance_m: length_m }
    }

    /// Casts every ray from the true pose. A ray without a hit reports the full range.
    fn scan(&mut self) -> Scan {
        let sensor = &self.params.sensor;
        let (first_rad, step_rad) = sensor.bearings_rad();
        let origin = self.position();
        self.view.world_from_sensor = self.world_from_body;
        self.view.ends_in_world.clear();
        self.view.hit.clear();
        let mut ranges_m = Vec::with_capacity(sensor.rays);
        for i in 0..sensor.rays {
            let (sin, cos) = (first_rad + step_rad * i as f64).sin_cos();
            let direction = self.world_from_body.rotation * Vector2::new(cos, sin);
            let hit_m = self.world.caster().cast(&origin, &direction, sensor.range_m);
            self.view.ends_in_world.push(origin + direction * hit_m.unwrap_or(sensor.range_m));
            self.view.hit.push(hit_m.is_some());
            ranges_m.push(match hit_m {
                None => sensor.range_m,
                Some(range_m) if sensor.range_sigma_m > 0.0 => {
                    let mut draw = self.streams.draw(Purpose::Range, self.tally.scans, i as u64);
                    (range_m + sensor.range_sigma_m * draw.normals2()[0]).max(0.0)
                }
                Some(range_m) => range_m,
            });
        }
        self.tally.scans += 1;
        let scan = Scan::new(first_rad, step_rad, ranges_m, sensor.range_m);
        self.view.full_circle = sensor.rays > 1 && scan.is_full_circle();
        scan
    }

    fn mark(&mut self, vertex: VertexId) {
        self.marks.insert(vertex, self.world_from_body);
        self.arrive(vertex);
        self.mark_count += 1;
    }

    /// Known places within the radius of true distance, in line of sight, and at least
    /// `exclude_factor` radii away along the robot's own graph (\[ISRR19\] sec. 6), by id.
    ///
    /// The graph holds the ways driven between places marked one after the other, and the places
    /// reported before this call. Cost: the places within the radius, and the vertices within the
    /// excluded part of the graph.
    fn recognize(&mut self) -> Vec<PlaceMatch> {
        self.matches()
    }
}
