//! Driving in truth: noise, and walls that stop the robot.

use geometry::{Point2, Vector2};
use pose::Se2;

use super::SimRobot;
use super::random::Purpose;

/// How far from an obstacle a stopped robot stands, metres: a ray must not start on a wall.
const STANDOFF_M: f64 = 1e-3;

impl SimRobot {
    /// One forward motion in truth: the command, then its noise (\[ISRR19\] 6.1).
    pub(super) fn drive_forward(&mut self, distance_m: f64) {
        let command = self.world_from_body.rotation * Vector2::new(distance_m, 0.0);
        if self.displace(command) {
            self.tally.collisions += 1;
        }
        let count = self.tally.forwards;
        self.tally.forwards += 1;
        self.tally.distance_m += distance_m;

        let odometry = &self.params.odometry;
        let spread = odometry.scale * distance_m.sqrt();
        let drift = odometry.scale * distance_m;
        let [x, y, theta] = self.streams.draw(Purpose::Odometry, count, 0).normals3();
        let slip = Vector2::new(
            odometry.bias_translation * drift + odometry.sigma_translation * spread * x,
            odometry.sigma_translation * spread * y,
        );
        let yaw = odometry.bias_rotation_rad * drift + odometry.sigma_rotation_rad * spread * theta;
        if self.displace(self.world_from_body.rotation * slip) {
            self.tally.bumps += 1;
        }
        self.world_from_body = self.world_from_body * Se2::from_angle(yaw);
    }

    /// Moves the true position, stopping short of obstacles; whether one was touched.
    pub(super) fn displace(&mut self, motion_in_world: Vector2) -> bool {
        let from = self.position();
        let to = from + motion_in_world;
        let caster = self.world.caster();
        let radius_m = self.params.drive.robot_radius_m.max(0.0);
        let hit_m = caster.sweep(&from, &to, radius_m);
        let reached = match hit_m {
            None => to,
            Some(hit_m) => {
                // With the standoff added to the radius the stop is short of the wall itself, not
                // only along the way, however flat the angle.
                let stop_m = caster.sweep(&from, &to, radius_m + STANDOFF_M).unwrap_or(hit_m);
                from + motion_in_world * (stop_m.min(hit_m) / motion_in_world.norm())
            }
        };
        let clearance_m = self.world.caster().clearance(&from, &reached);
        self.tally.min_clearance_m = self.tally.min_clearance_m.min(clearance_m);
        self.world_from_body.translation = reached.coords;
        hit_m.is_some()
    }

    /// Puts the robot somewhere without driving there.
    pub(super) fn place(&mut self, world_from_body: Se2) {
        self.world_from_body = world_from_body;
        let clearance_m = self.world.caster().distance_to(&self.position());
        self.tally.min_clearance_m = self.tally.min_clearance_m.min(clearance_m);
    }

    /// True position of the robot.
    pub(super) fn position(&self) -> Point2 {
        Point2::from(self.world_from_body.translation)
    }
}
