//! Flying in truth: noise, and surfaces that stop the robot.

use geometry::{Point3, Vector3};
use pose::Se3;
use pose::nalgebra::UnitQuaternion;

use super::SimFlyer;
use crate::robot::random::Purpose;

/// How far from a surface a stopped robot hovers, metres: a ray must not start on a wall.
const STANDOFF_M: f64 = 1e-3;

/// A turn about the vertical, counter-clockwise from above, radians.
pub(super) fn yaw(angle_rad: f64) -> Se3 {
    Se3::new(Vector3::zeros(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad))
}

impl SimFlyer {
    /// One flight in truth: the command, then its noise (\[ISRR19\] 6.1, with one axis more).
    pub(super) fn fly_truly(&mut self, by_in_body: &Vector3) {
        let distance_m = by_in_body.norm();
        if self.displace(self.world_from_body.rotation * by_in_body) {
            self.tally.collisions += 1;
        }
        let count = self.tally.forwards;
        self.tally.forwards += 1;
        self.tally.distance_m += distance_m;
        let odometry = &self.params.odometry;
        let spread = odometry.scale * distance_m.sqrt();
        let slip = Vector3::from(self.streams.draw(Purpose::Odometry, count, 0).normals3())
            * (odometry.sigma_translation * spread);
        let turn = self.streams.draw(Purpose::Yaw, count, 0).normals2()[0];
        let turn_rad = odometry.sigma_rotation_rad * spread * turn;
        if self.displace(self.world_from_body.rotation * slip) {
            self.tally.bumps += 1;
        }
        self.world_from_body = self.world_from_body * yaw(turn_rad);
    }

    /// Moves the true position, stopping short of surfaces; whether one was touched.
    pub(super) fn displace(&mut self, motion_in_world: Vector3) -> bool {
        let from = self.position();
        let to = from + motion_in_world;
        let caster = self.world.caster();
        let hit_m = caster.sweep(&from, &to, self.params.radius_m);
        let reached = match hit_m {
            None => to,
            Some(hit_m) => {
                // With the standoff added to the radius the stop is short of the surface itself, not only
                // along the way, however flat the angle.
                let stop = caster.sweep(&from, &to, self.params.radius_m + STANDOFF_M);
                let stop_m = stop.unwrap_or(hit_m).min(hit_m);
                from + motion_in_world * (stop_m / motion_in_world.norm())
            }
        };
        let clearance_m = caster.clearance(&from, &reached);
        self.tally.min_clearance_m = self.tally.min_clearance_m.min(clearance_m);
        self.world_from_body.translation = reached.coords;
        hit_m.is_some()
    }

    /// Puts the robot somewhere without flying there.
    pub(super) fn place(&mut self, world_from_body: Se3) {
        self.world_from_body = world_from_body;
        let clearance_m = self.world.caster().distance_to(&self.position());
        self.tally.min_clearance_m = self.tally.min_clearance_m.min(clearance_m);
    }

    /// True position of the robot.
    pub(super) fn position(&self) -> Point3 {
        Point3::from(self.world_from_body.translation)
    }
}
