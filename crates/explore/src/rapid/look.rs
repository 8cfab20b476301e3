//! Turning where that is enough: before the robot moves, and before it leaves.

use sensing::Robot;

use crate::{ExploreProbe, Explorer, RapidParams};

impl Explorer {
    /// Turns to a frontier that turning can settle, if there is one.
    pub(super) fn look_first(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        if self.rapid.turns_here >= params.turns_at_a_place {
            return false;
        }
        let mut candidates = std::mem::take(&mut self.candidates);
        self.maps[0].in_view(&self.standing, &mut candidates);
        candidates.retain(|candidate| candidate.turn_only);
        let motion = self.choose(&candidates, params, probe);
        self.candidates = candidates;
        let Some(motion) = motion else { return self.look_around(robot, params, probe) };
        if motion.heading_rad.abs() <= params.turn_tolerance_rad {
            return false;
        }
        self.rapid.turns_here += 1;
        self.turn(robot, motion.heading_rad, probe);
        self.scan(robot, probe);
        true
    }

    /// Before the robot leaves: turns to what other places have left open around here.
    ///
    /// Without this a frontier beside the robot, out of its field of view, would only be looked at
    /// after a way there and back.
    pub(super) fn look_around(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        if self.rapid.turns_here >= params.turns_at_a_place {
            return false;
        }
        let mut candidates = std::mem::take(&mut self.candidates);
        self.maps[0].around(&self.standing, &mut candidates);
        let motion = self.choose(&candidates, params, probe);
        self.candidates = candidates;
        let Some(motion) = motion else { return false };
        self.rapid.turns_here += 1;
        self.turn(robot, motion.heading_rad, probe);
        self.scan(robot, probe);
        true
    }
}
