//! Driving along a way over free cells.

use geometry::Point2;
use sensing::Robot;

use crate::{ExploreProbe, Explorer, GiveUp, RapidParams};

impl Explorer {
    /// One move along a way of straight legs: to the farthest point that can be seen from here.
    pub(super) fn drive_towards(
        &mut self,
        robot: &mut dyn Robot,
        points: &[Point2],
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        for (level, &clearance_m) in params.clearances_m.iter().enumerate() {
            for point in points.iter().rev() {
                let distance_m = point.coords.norm();
                if distance_m < params.arrival_m {
                    continue;
                }
                let whole = self.maps[0].clearance(&self.standing, point);
                let near = distance_m <= params.step_m || whole.keeps(clearance_m);
                if !near {
                    continue;
                }
                let Some(motion) = self.allowed(0, *point, clearance_m, level, params) else {
                    continue;
                };
                if motion.heading_rad.abs() > params.turn_tolerance_rad
                    && self.rapid.turns_here < params.turns_at_a_place
                {
                    self.rapid.turns_here += 1;
                    self.turn(robot, motion.heading_rad, probe);
                    self.scan(robot, probe);
                } else {
                    self.rapid.turns_here = 0;
                    self.turn(robot, motion.heading_rad, probe);
                    let step_m = distance_m.min(motion.at_most_m);
                    self.backtracked_m += step_m;
                    self.forward(robot, step_m, probe);
                }
                return;
            }
        }
        // No motion is allowed from what is seen: look towards the way, then give its end up.
        let heading_rad = points.first().map_or(0.0, |p| p.y.atan2(p.x));
        if self.rapid.turns_here < params.turns_at_a_place {
            self.rapid.turns_here += 1;
            self.turn(robot, heading_rad, probe);
            self.scan(robot, probe);
        } else {
            self.rapid.turns_here = 0;
            if let Some(goal) = points.last() {
                self.give_up(goal, GiveUp::Blocked, params, probe);
            }
        }
    }
}
