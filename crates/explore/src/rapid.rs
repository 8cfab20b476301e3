//! The rapid policy: towards the frontier in view with the least change of heading, else along the
//! graph to the nearest vertex with frontier (\[ISRR19\] 5, \[Zie18\] 2.9).
//!
//! It ends for certain. Every action either closes frontier, founds a vertex nearer to a goal, or
//! gives a goal up; a goal that is given up takes the frontier around it out of the count for good,
//! and a goal is given up when it is reached and still there, when no motion towards it keeps even
//! the least clearance, or when the robot has moved towards it for longer than it can be far away.

use std::collections::BTreeMap;

use geometry::Point2;
use maps2d::{Candidate, Route};
use pose::Se2;
use probe::VertexId;
use sensing::Robot;

use crate::{Ending, ExploreProbe, Explorer, GiveUp, PlannerEvent, RapidParams, State};

/// Moves towards one goal after which it cannot be far away any more.
const MOST_MOVES: u32 = 12;

/// What the policy remembers between steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// What is left of the way along the graph, last leg first.
    pub way: Vec<(VertexId, f64)>,
    /// Scans since the robot came to this place.
    pub turns_here: u32,
    /// The goal of the last move.
    pub pursuit: Option<Pursuit>,
    /// How often the robot was sent to a vertex, and what it had left when it was sent last.
    pub sent: BTreeMap<VertexId, (u32, f64)>,
    /// A vertex that the robot was sent to in vain: its goals are given up on arrival.
    pub in_vain: Option<VertexId>,
    /// The frontier that a "normal point" serves, in the body frame of now, until it is looked at.
    pub behind: Option<Behind>,
}

/// A goal that the robot moves towards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pursuit {
    /// Where it is, in the body frame of now.
    goal_in_body: Point2,
    /// Moves made towards it.
    moves: u32,
    /// The vertex that it was chosen at.
    chosen_at: VertexId,
}

/// How a goal is approached; the first that the clearance allows is taken.
#[derive(Clone, Copy, Debug)]
enum Approach {
    /// Straight to it.
    Straight,
    /// By a point before it, on its normal (\[Zie18\] 2.9.3).
    NormalPoint,
    /// By a point from which it can be reached.
    Detour,
}

/// A frontier that is approached by a point before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Behind {
    /// The point before it; `None` once the robot is there.
    point_in_body: Option<Point2>,
    /// The frontier.
    goal_in_body: Point2,
    /// Moves made for it.
    moves: u32,
}

impl Behind {
    fn moved(self, here_from_there: &Se2) -> Self {
        Self {
            point_in_body: self.point_in_body.map(|p| here_from_there.inverse_transform(&p)),
            goal_in_body: here_from_there.inverse_transform(&self.goal_in_body),
            moves: self.moves + 1,
        }
    }
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
    /// The frontier that it serves, where it does not lead there itself.
    behind_in_body: Option<Point2>,
}

impl Explorer {
    pub(crate) fn act_rapid(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) {
        let params = self.params.policy.rapid().clone();
        if params.look_first && self.look_first(robot, &params, probe) {
            return;
        }
        if self.follow_way(robot, &params, probe) || self.go_behind(robot, &params, probe) {
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
        if !self.look_around(robot, &params, probe) && !self.go_on(robot, &params, probe) {
            self.deliberate(robot, &params, probe);
        }
    }

    /// Turns to a frontier that turning can settle, if there is one.
    fn look_first(
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
    fn look_around(
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

    /// Goes on along the way, if one is being followed and still worth it.
    fn follow_way(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(&(goal, _)) = self.rapid.way.first() else { return false };
        if self.maps[0].frontier_at(goal) <= 0.0 {
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

    /// Goes on to a "normal point", then looks at the frontier from there and drives up to it.
    ///
    /// The frontier belongs to a volume elsewhere, so it is not in view as a candidate; without this
    /// the robot would be sent back and choose the same point again.
    fn go_behind(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(behind) = self.rapid.behind.take() else { return false };
        if let Some(point) = behind.point_in_body
            && point.coords.norm() >= params.arrival_m
            && let Some(moved) = self.step_to(robot, point, params, probe)
        {
            let behind = behind.moved(&moved);
            self.rapid.behind = (behind.moves < MOST_MOVES).then_some(behind);
            return true;
        }
        let goal = behind.goal_in_body;
        let heading_rad = goal.y.atan2(goal.x);
        if heading_rad.abs() > params.turn_tolerance_rad && self.rapid.turns_here == 0 {
            self.rapid.turns_here += 1;
            self.turn(robot, heading_rad, probe);
            self.scan(robot, probe);
            let turned = Se2::from_angle(heading_rad);
            self.rapid.behind = Some(Behind { point_in_body: None, ..behind.moved(&turned) });
            return true;
        }
        if behind.moves < MOST_MOVES
            && goal.coords.norm() >= params.arrival_m
            && let Some(moved) = self.step_to(robot, goal, params, probe)
        {
            self.rapid.behind = Some(Behind { point_in_body: None, ..behind.moved(&moved) });
            return true;
        }
        // Seen from the normal point or from as near as can be. If the frontier is still there, the
        // robot will be sent to it again, and in the end give it up.
        false
    }

    /// One move towards a point in view, if any clearance allows it; returns the motion made.
    fn step_to(
        &mut self,
        robot: &mut dyn Robot,
        to_in_body: Point2,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> Option<Se2> {
        let motion = params.clearances_m.iter().enumerate().find_map(|(level, &clearance_m)| {
            self.allowed(0, to_in_body, clearance_m, level, params)
        })?;
        let step_m = to_in_body.coords.norm().min(motion.at_most_m);
        self.rapid.turns_here = 0;
        self.turn(robot, motion.heading_rad, probe);
        self.forward(robot, step_m, probe);
        Some(Se2::from_angle(motion.heading_rad) * Se2::new(step_m, 0.0, 0.0))
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
        let in_vain = self.rapid.in_vain == Some(self.standing.vertex);
        let motion = if in_vain { None } else { self.choose(candidates, params, probe) };
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
        if let Some(goal_in_body) = motion.behind_in_body {
            let point_in_body = Some(motion.to_in_body);
            let behind = Behind { point_in_body, goal_in_body, moves: 0 };
            let turned = Se2::from_angle(if must_turn { motion.heading_rad } else { 0.0 });
            self.rapid.behind = Some(behind.moved(&(turned * Se2::new(step_m, 0.0, 0.0))));
        }
        let before = self.rapid.pursuit;
        self.rapid.pursuit = Some(Pursuit {
            goal_in_body: Point2::new(distance_m - step_m, 0.0),
            moves: before.map_or(0, |pursuit| pursuit.moves) + 1,
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
    fn go_on(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(pursuit) = self.rapid.pursuit else { return false };
        let goal = pursuit.goal_in_body;
        let left = self.maps[0].frontier_at(pursuit.chosen_at) > 0.0;
        if !left || pursuit.moves > MOST_MOVES || goal.coords.norm() < params.arrival_m {
            return false;
        }
        let Some(moved) = self.step_to(robot, goal, params, probe) else { return false };
        self.rapid.pursuit = Some(Pursuit {
            goal_in_body: moved.inverse_transform(&goal),
            moves: pursuit.moves + 1,
            ..pursuit
        });
        true
    }

    /// Whether the robot has moved towards this goal for longer than it can be far away.
    fn is_chasing(&mut self, motion: &Motion, params: &RapidParams) -> bool {
        let Some(pursuit) = self.rapid.pursuit else { return false };
        let same = (pursuit.goal_in_body - motion.to_in_body).norm() < params.give_up_radius_m;
        if !same {
            self.rapid.pursuit = None;
        }
        same && pursuit.moves > MOST_MOVES
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
        let everywhere = why == GiveUp::NothingNew;
        self.maps[0].give_up(&self.standing, goal_in_body, radius_m, everywhere, &mut *probe);
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
            for approach in [Approach::Straight, Approach::NormalPoint, Approach::Detour] {
                scored.clear();
                let mut best: Option<Motion> = None;
                for (i, candidate) in candidates.iter().enumerate() {
                    let motion = match approach {
                        Approach::Straight => {
                            self.straight_motion(i, candidate, clearance_m, level, params)
                        }
                        Approach::NormalPoint => {
                            self.motion_by_normal_point(i, candidate, clearance_m, level, params)
                        }
                        Approach::Detour => {
                            self.motion_by_detour(i, candidate, clearance_m, level, params)
                        }
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

    /// By a point on the normal of the frontier, a stretch before it, in free space (\[Zie18\] 2.9.3).
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
            let motion = self.allowed(candidate, point, clearance_m, level, params)?;
            Some(Motion { behind_in_body: Some(of.goals_in_body[0]), ..motion })
        })
    }

    /// By a point from which the goal can be reached, where the robot stands too near to a corner.
    fn motion_by_detour(
        &mut self,
        candidate: usize,
        of: &Candidate,
        clearance_m: f64,
        level: usize,
        params: &RapidParams,
    ) -> Option<Motion> {
        if of.turn_only {
            return None;
        }
        of.goals_in_body.into_iter().find_map(|goal| {
            let point = self.maps[0].detour(&self.standing, &goal, clearance_m)?;
            let motion = self.allowed(candidate, point, clearance_m, level, params)?;
            Some(Motion { behind_in_body: Some(goal), ..motion })
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
        let clearance = self.maps[0].clearance(&self.standing, &first);
        clearance.keeps(clearance_m).then(|| towards(candidate, to_in_body, at_most_m))
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
        self.take_route(robot, route, params, probe);
    }

    fn take_route(
        &mut self,
        robot: &mut dyn Robot,
        route: Route,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) {
        probe.emit(PlannerEvent::RoutePlanned {
            standing: self.standing,
            route: &route,
            length_m: length_m(&route),
        });
        match route {
            Route::Repeat(mut legs) => {
                legs.reverse();
                if let Some(&(goal, _)) = legs.first() {
                    let left_m = self.maps[0].frontier_at(goal);
                    let sent = self.rapid.sent.entry(goal).or_insert((0, f64::INFINITY));
                    *sent = if left_m < sent.1 - 1e-6 { (1, left_m) } else { (sent.0 + 1, left_m) };
                    self.rapid.in_vain = (sent.0 > params.visits_in_vain).then_some(goal);
                }
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
                let whole = self.maps[0].clearance(&self.standing, point);
                let near = distance_m <= params.step_m || whole.keeps(clearance_m);
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
    Motion { candidate, to_in_body, at_most_m, heading_rad, behind_in_body: None }
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
