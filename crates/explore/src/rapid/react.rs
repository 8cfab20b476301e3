//! Reacting to frontier in view, going on to it, and giving it up.

use geometry::Point2;
use maps2d::Candidate;
use pose::Se2;
use probe::VertexId;
use sensing::Robot;

use super::approach::Motion;
use super::behind::{Behind, most_moves};
use crate::{ExploreProbe, Explorer, GiveUp, PlannerEvent, RapidParams, State};

/// A goal that the robot moves towards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pursuit {
    /// Where it is, in the body frame of now.
    goal_in_body: Point2,
    /// Moves that may still be made towards it.
    moves_left: u32,
    /// The vertex that it was chosen at.
    chosen_at: VertexId,
}

impl Explorer {
    /// Acts on the frontiers in view; false when all that happened is that goals were given up, or that
    /// the robot tired of the place.
    pub(super) fn react(
        &mut self,
        robot: &mut dyn Robot,
        candidates: &[Candidate],
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        self.change_state(State::Reactive, probe);
        if self.rapid.haunts.is_spent(self.standing.vertex) {
            for candidate in candidates {
                self.give_up(&candidate.goals_in_body[0], GiveUp::NothingNew, params, probe);
            }
            return false;
        }
        let in_vain = self.rapid.in_vain == Some(self.standing.vertex);
        let motion = if in_vain { None } else { self.choose(candidates, params, probe) };
        let Some(motion) = motion else {
            if !in_vain && self.go_round(robot, candidates, params, probe) {
                return true;
            }
            for candidate in candidates {
                self.give_up(&candidate.goals_in_body[0], GiveUp::Blocked, params, probe);
            }
            return false;
        };
        let candidate = &candidates[motion.candidate];
        probe.emit(PlannerEvent::GoalChosen {
            standing: self.standing,
            goal_in_body: motion.to_in_body,
        });
        let distance_m = motion.to_in_body.coords.norm();
        if !self.is_worth_going(&candidate.goals_in_body[0], distance_m, params) {
            if self.rapid.haunts.tire_of(self.standing.vertex) {
                return false;
            }
            self.give_up(&candidate.goals_in_body[0], GiveUp::NothingNew, params, probe);
            return false;
        }
        let must_turn = motion.heading_rad.abs() > params.turn_tolerance_rad;
        if must_turn && self.rapid.turns_here < params.turns_at_a_place {
            self.rapid.turns_here += 1;
            self.turn(robot, motion.heading_rad, probe);
            self.scan(robot, probe);
            return true;
        }
        if candidate.turn_only || distance_m < params.arrival_m || self.is_chasing(&motion, params)
        {
            self.give_up(&candidate.goals_in_body[0], GiveUp::NothingNew, params, probe);
            return false;
        }
        if must_turn {
            self.turn(robot, motion.heading_rad, probe);
        }
        let step_m = distance_m.min(motion.at_most_m);
        self.rapid.turns_here = 0;
        if let Some(goal_in_body) = motion.behind_in_body {
            let point = Some(motion.to_in_body);
            let behind = Behind::new(point, goal_in_body, params);
            let turned = Se2::from_angle(if must_turn { motion.heading_rad } else { 0.0 });
            self.rapid.behind = Some(behind.moved(&(turned * Se2::new(step_m, 0.0, 0.0))));
        }
        let before = self.rapid.pursuit;
        self.rapid.pursuit = Some(Pursuit {
            goal_in_body: Point2::new(distance_m - step_m, 0.0),
            moves_left: before
                .map_or_else(|| most_moves(distance_m, params), |pursuit| pursuit.moves_left)
                .saturating_sub(1),
            chosen_at: before.map_or(self.standing.vertex, |pursuit| pursuit.chosen_at),
        });
        self.forward(robot, step_m, probe);
        true
    }

    /// Goes on towards the goal of the last move, though nothing is in view any more.
    ///
    /// What the robot saw of a frontier from farther off may show more of the unknown than what it
    /// sees from nearer; then only the vertex that it came from has frontier left, and going back
    /// there would lead here again.
    pub(super) fn go_on(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(pursuit) = self.rapid.pursuit else { return false };
        let goal = pursuit.goal_in_body;
        let left = self.maps[0].frontier_at(pursuit.chosen_at) > 0.0;
        if !left || pursuit.moves_left == 0 || goal.coords.norm() < params.arrival_m {
            return false;
        }
        let Some(moved) = self.step_to(robot, goal, params, probe) else {
            return self.go_on_by_detour(robot, &goal, params, probe);
        };
        self.rapid.pursuit = Some(Pursuit {
            goal_in_body: moved.inverse_transform(&goal),
            moves_left: pursuit.moves_left - 1,
            ..pursuit
        });
        true
    }

    /// Goes on towards a goal behind a corner that the straight way to it would touch.
    ///
    /// Down a staircase of corridors the robot sees farther than it gets on that line. It would go
    /// back and come again, and leave all that lies behind.
    fn go_on_by_detour(
        &mut self,
        robot: &mut dyn Robot,
        goal_in_body: &Point2,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let standing = self.standing;
        for &clearance_m in &params.clearances_m {
            let Some(point) = self.maps[0].detour(&standing, goal_in_body, clearance_m) else {
                continue;
            };
            if let Some(moved) = self.step_to(robot, point, params, probe) {
                let behind = Behind::new(Some(point), *goal_in_body, params);
                self.rapid.behind = Some(behind.moved(&moved));
                self.rapid.pursuit = None;
                return true;
            }
        }
        false
    }

    /// Whether the robot has moved towards this goal for longer than it can be far away.
    pub(super) fn is_chasing(&mut self, motion: &Motion, params: &RapidParams) -> bool {
        let Some(pursuit) = self.rapid.pursuit else { return false };
        let same = (pursuit.goal_in_body - motion.to_in_body).norm() < params.give_up_radius_m;
        if !same {
            self.rapid.pursuit = None;
        }
        same && pursuit.moves_left == 0
    }

    pub(super) fn give_up(
        &mut self,
        goal_in_body: &Point2,
        why: GiveUp,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        self.rapid.pursuit = None;
        probe.emit(PlannerEvent::GoalGivenUp {
            standing: self.standing,
            goal_in_body: *goal_in_body,
            why,
        });
        let radius_m = params.give_up_radius_m;
        let everywhere = why == GiveUp::NothingNew;
        self.maps[0].give_up(&self.standing, goal_in_body, radius_m, everywhere, &mut *probe);
    }
}
