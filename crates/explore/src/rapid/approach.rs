//! Which motion towards which frontier, with how much clearance.

use geometry::Point2;
use maps2d::Candidate;
use pose::Se2;
use sensing::Robot;

use super::behind::step_at;
use crate::{ExploreProbe, Explorer, PlannerEvent, RapidParams};

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

/// A motion that the policy may make.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// Which candidate.
    pub candidate: usize,
    /// Where to drive, in the body frame.
    pub to_in_body: Point2,
    /// How far at most, metres.
    pub at_most_m: f64,
    pub heading_rad: f64,
    /// The frontier that it serves, where it does not lead there itself.
    pub behind_in_body: Option<Point2>,
}

impl Explorer {
    /// The allowed motion with the least change of heading; greater clearances come first, and at
    /// each the straight way before the way by the "normal point".
    pub(super) fn choose(
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

    pub(super) fn straight_motion(
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
    pub(super) fn motion_by_normal_point(
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
    pub(super) fn motion_by_detour(
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
    pub(super) fn allowed(
        &mut self,
        candidate: usize,
        to_in_body: Point2,
        clearance_m: f64,
        level: usize,
        params: &RapidParams,
    ) -> Option<Motion> {
        let at_most_m = step_at(level, params);
        let distance_m = to_in_body.coords.norm();
        let step_m = distance_m.min(at_most_m);
        let first = if distance_m > 0.0 {
            Point2::from(to_in_body.coords * (step_m / distance_m))
        } else {
            to_in_body
        };
        let body_m = params.body_radius_m;
        let clearance = self.maps[0].clearance(&self.standing, &first).around_body(body_m);
        clearance.keeps(clearance_m - body_m).then(|| towards(candidate, to_in_body, at_most_m))
    }

    /// One move towards a point in view, if any clearance allows it; returns the motion made.
    pub(super) fn step_to(
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
}

pub(super) fn towards(candidate: usize, to_in_body: Point2, at_most_m: f64) -> Motion {
    let heading_rad = to_in_body.y.atan2(to_in_body.x);
    Motion { candidate, to_in_body, at_most_m, heading_rad, behind_in_body: None }
}
