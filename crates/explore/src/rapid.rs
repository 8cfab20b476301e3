//! The rapid policy: towards the frontier in view with the least change of heading, else along the
//! graph to the nearest vertex with frontier ([ISRR19] 5, [Zie18] 2.9).
//!
//! It ends for certain. Every action either closes frontier, founds a vertex nearer to a goal, or
//! gives a goal up; a goal that is given up takes the frontier around it out of the count for good,
//! and a goal is given up when it is reached and still there, when no motion towards it keeps even
//! the least clearance, or when the robot has moved towards it for longer than it can be far away.

use geometry::Point2;
use maps2d::{Candidate, Route};
use probe::VertexId;
use sensing::Robot;

use crate::{Ending, Explorer, ExploreProbe, GiveUp, PlannerEvent, RapidParams, State};

/// What the policy remembers between steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// What is left of the way along the graph, last leg first.
    pub way: Vec<(VertexId, f64)>,
    /// Scans since the robot came to this place.
    pub turns_here: u32,
    /// The goal of the last move in the body frame of now, and moves made towards it.
    pub pursuit: Option<(Point2, u32)>,
}

/// A motion that the policy may make.
#[derive(Clone, Copy, Debug)]
struct Motion {
    /// Which candidate.
    candidate: usize,
    /// Where to drive, in the body frame.
    to_in_body: Point2,
    /// How far at most, metres.
    at_most_m: f64,
    heading_rad: f64,
}

impl Explorer {
    pub(crate) fn act_rapid(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) {
        let params = self.params.policy.rapid().clone();
        if self.follow_way(robot, &params, probe) {
            return;
        }
        // Giving goals up may leave nothing in view; each round closes some, so this ends.
        loop {
            let mut candidates = std::mem::take(&mut self.candidates);
            self.maps[0].in_view(&self.standing, &mut candidates);
            let acted = if candidates.is_empty() {
                None
            } else {
                Some(self.react(robot, &candidates, &params, probe))
            };
            self.candidates = candidates;
            match acted {
                Some(true) => return,
                Some(false) => continue,
                None => break,
            }
        }
        self.deliberate(robot, &params, probe);
    }

    /// Goes on along the way, if one is being followed and still worth it.
    fn follow_way(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(&(goal, _)) = self.rapid.way.first() else { return false };
        if !self.maps[0].is_worth_visiting(goal) {
            self.rapid.way.clear();
            return false;
        }
        self.rapid.turns_here = 0;
        self.rapid.pursuit = None;
        if params.teleport {
            let legs = std::mem::take(&mut self.rapid.way);
            for (i, (to, length_m)) in legs.into_iter().enumerate().rev() {
                self.repeat(robot, to, length_m, i == 0, probe);
            }
        } else if let Some((to, length_m)) = self.rapid.way.pop() {
            self.repeat(robot, to, length_m, true, probe);
        }
        true
    }

    /// Acts on the frontiers in view; false when all that happened is that goals were given up.
    fn react(
        &mut self,
        robot: &mut dyn Robot,
        candidates: &[Candidate],
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        self.change_state(State::Reactive, probe);
        let motion = self.choose(candidates, params, probe);
        let Some(motion) = motion else {
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
        let must_turn = motion.heading_rad.abs() > params.turn_tolerance_rad;
        if must_turn && self.rapid.turns_here < params.turns_at_a_place {
            self.rapid.turns_here += 1;
            self.turn(robot, motion.heading_rad, probe);
            self.scan(robot, probe);
            return true;
        }
        let distance_m = motion.to_in_body.coords.norm();
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
        let ahead = Point2::new(distance_m - step_m, 0.0);
        let moves = self.rapid.pursuit.map_or(0, |(_, moves)| moves);
        self.rapid.pursuit = Some((ahead, moves + 1));
        self.forward(robot, step_m, probe);
        true
    }

    /// Whether the robot has moved towards this goal for longer than it can be far away.
    fn is_chasing(&mut self, motion: &Motion, params: &RapidParams) -> bool {
        let Some((goal, moves)) = self.rapid.pursuit else { return false };
        let same = (goal - motion.to_in_body).norm() < params.give_up_radius_m;
        if !same {
            self.rapid.pursuit = None;
        }
        same && moves > 12
    }

    fn give_up(
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
        self.maps[0].give_up(&self.standing, goal_in_body, radius_m, &mut *probe);
    }

    /// The allowed motion with the least change of heading; greater clearances come first, and at
    /// each the straight way before the way by the "normal point".
    fn choose(
        &mut self,
        candidates: &[Candidate],
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> Option<Motion> {
        let mut scored: Vec<(Candidate, f64)> = Vec::new();
        for (level, &clearance_m) in params.clearances_m.iter().enumerate() {
            for by_normal_point in [false, true] {
                scored.clear();
                let mut best: Option<Motion> = None;
                for (i, candidate) in candidates.iter().enumerate() {
                    let motion = if by_normal_point {
                        self.motion_by_normal_point(i, candidate, clearance_m, level, params)
                    } else {
                        self.straight_motion(i, candidate, clearance_m, level, params)
                    };
                    let score = motion.map_or(f64::INFINITY, |motion| motion.heading_rad.abs());
                    scored.push((*candidate, score));
                    if let Some(motion) = motion
                        && best.is_none_or(|b| motion.heading_rad.abs() < b.heading_rad.abs())
                    {
                        best = Some(motion);
                    }
                }
                if best.is_some() {
                    probe.emit(PlannerEvent::CandidatesScored {
                        standing: self.standing,
                        scored: &scored,
                    });
                    return best;
                }
            }
        }
        probe.emit(PlannerEvent::CandidatesScored { standing: self.standing, scored: &scored });
        None
    }

    fn straight_motion(
        &mut self,
        candidate: usize,
        of: &Candidate,
        clearance_m: f64,
        level: usize,
        params: &RapidParams,
    ) -> Option<Motion> {
        if of.turn_only {
            return Some(towards(candidate, of.goals_in_body[0], params.step_m));
        }
        of.goals_in_body
            .into_iter()
            .find_map(|goal| self.allowed(candidate, goal, clearance_m, level, params))
    }

    /// By a point on the normal of the frontier, a stretch before it, in free space ([Zie18] 2.9.3).
    fn motion_by_normal_point(
        &mut self,
        candidate: usize,
        of: &Candidate,
        clearance_m: f64,
        level: usize,
        params: &RapidParams,
    ) -> Option<Motion> {
        if of.turn_only || of.normal_in_body.norm_squared() == 0.0 {
            return None;
        }
        params.normal_point_m.iter().find_map(|&before_m| {
            let point = of.goals_in_body[0] - of.normal_in_body * before_m;
            if point.coords.norm() < 2.0 * params.arrival_m {
                return None;
            }
            self.allowed(candidate, point, clearance_m, level, params)
        })
    }

    /// The motion to `to_in_body` if its first step keeps the clearance.
    fn allowed(
        &mut self,
        candidate: usize,
        to_in_body: Point2,
        clearance_m: f64,
        level: usize,
        params: &RapidParams,
    ) -> Option<Motion> {
        // Squeezing through goes by shorter steps: noise grows with the distance.
        let at_most_m = params.step_m / (1 << level.min(4)) as f64;
        let distance_m = to_in_body.coords.norm();
        let step_m = distance_m.min(at_most_m);
        let first = if distance_m > 0.0 {
            Point2::from(to_in_body.coords * (step_m / distance_m))
        } else {
            to_in_body
        };
        let kept_m = self.maps[0].clearance(&self.standing, &first, clearance_m);
        (kept_m >= clearance_m).then(|| towards(candidate, to_in_body, at_most_m))
    }

    /// Nothing in view: the nearest frontier elsewhere, or the end.
    fn deliberate(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        self.change_state(State::Deliberate, probe);
        let least_m = params.clearances_m.first().copied().unwrap_or(0.0);
        let Some(route) = self.maps[0].route(&self.standing, least_m) else {
            self.finish(Ending::Complete, probe);
            return;
        };
        probe.emit(PlannerEvent::RoutePlanned {
            standing: self.standing,
            route: &route,
            length_m: length_m(&route),
        });
        match route {
            Route::Repeat(mut legs) => {
                legs.reverse();
                self.rapid.way = legs;
                if !self.follow_way(robot, params, probe) {
                    // The goal is here, but nothing of it is in view: it cannot be acted on.
                    self.finish(Ending::Stuck, probe);
                }
            }
            Route::Drive(points) => self.drive_towards(robot, &points, params, probe),
        }
    }

    /// One move along a way of straight legs: to the farthest point that can be seen from here.
    fn drive_towards(
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
                // Unseen directions are looked at first: the map may believe in them wrongly.
                let motion = towards(0, *point, params.step_m);
                let whole_m = self.maps[0].clearance(&self.standing, point, clearance_m);
                let near = distance_m <= params.step_m || whole_m >= clearance_m;
                if !near {
                    continue;
                }
                let Some(motion) =
                    self.allowed(motion.candidate, *point, clearance_m, level, params)
                else {
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

fn towards(candidate: usize, to_in_body: Point2, at_most_m: f64) -> Motion {
    let heading_rad = to_in_body.y.atan2(to_in_body.x);
    Motion { candidate, to_in_body, at_most_m, heading_rad }
}

fn length_m(route: &Route) -> f64 {
    match route {
        Route::Repeat(legs) => legs.iter().map(|(_, length_m)| length_m).sum(),
        Route::Drive(points) => {
            let mut at = Point2::origin();
            let mut sum_m = 0.0;
            for point in points {
                sum_m += (point - at).norm();
                at = *point;
            }
            sum_m
        }
    }
}
