//! Frontiers that are approached by another place: a point before them, or another vertex.

use geometry::Point2;
use maps2d::{Candidate, Vantage};
use pose::Se2;
use probe::VertexId;
use sensing::Robot;

use crate::{ExploreProbe, Explorer, RapidParams};

/// A frontier that is approached by a point before it, or from another vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Behind {
    /// The point before it; `None` once the robot is there.
    point_in_body: Option<Point2>,
    /// The frontier.
    goal_in_body: Point2,
    /// Moves that may still be made for it.
    moves_left: u32,
}

impl Behind {
    /// By a point before the frontier.
    pub(super) fn new(
        point_in_body: Option<Point2>,
        goal_in_body: Point2,
        params: &RapidParams,
    ) -> Self {
        let point_m = point_in_body.map_or(0.0, |point| point.coords.norm());
        let moves_left = most_moves(point_m + goal_in_body.coords.norm(), params);
        Self { point_in_body, goal_in_body, moves_left }
    }

    /// After a motion of the robot.
    pub(super) fn moved(self, here_from_there: &Se2) -> Self {
        Self {
            point_in_body: self.point_in_body.map(|p| here_from_there.inverse_transform(&p)),
            goal_in_body: here_from_there.inverse_transform(&self.goal_in_body),
            moves_left: self.moves_left.saturating_sub(1),
        }
    }
}

/// What a way to another vertex is driven for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Served {
    /// The vertex whose frontier it is.
    pub vertex: VertexId,
    /// The frontier, in the frame of the last vertex of the way.
    pub goal_in_last: Point2,
}

/// Moves towards a goal at this distance after which it cannot be far away any more, even by the
/// shortest steps and not quite straight.
pub(super) fn most_moves(distance_m: f64, params: &RapidParams) -> u32 {
    let levels = params.clearances_m.len().saturating_sub(1);
    4 + (2.0 * distance_m / step_at(levels, params)).min(1e4).ceil() as u32
}

/// Longest move with the clearance of this rank: squeezing through goes by shorter steps, because
/// noise grows with the distance.
pub(super) fn step_at(level: usize, params: &RapidParams) -> f64 {
    params.step_m / (1 << level.min(4)) as f64
}

impl Explorer {
    /// Goes on to a "normal point", then looks at the frontier from there and drives up to it.
    ///
    /// The frontier belongs to a volume elsewhere, so it is not in view as a candidate; without this
    /// the robot would be sent back and choose the same point again. It drives up even where looking
    /// has closed the frontier: stopping there costs more later (forest house, alpha 0: 390 m
    /// instead of 294 m), because what lies around is then left behind.
    pub(super) fn go_behind(
        &mut self,
        robot: &mut dyn Robot,
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let Some(behind) = self.rapid.behind.take() else { return false };
        if let Some(point) = behind.point_in_body
            && point.coords.norm() >= params.arrival_m
            && behind.moves_left > 0
            && let Some(moved) = self.step_to(robot, point, params, probe)
        {
            self.rapid.behind = Some(behind.moved(&moved));
            return true;
        }
        let behind = Behind { point_in_body: None, ..behind };
        let goal = behind.goal_in_body;
        let heading_rad = goal.y.atan2(goal.x);
        if heading_rad.abs() > params.turn_tolerance_rad && self.rapid.turns_here == 0 {
            self.rapid.turns_here += 1;
            self.turn(robot, heading_rad, probe);
            self.scan(robot, probe);
            self.rapid.behind = Some(behind.moved(&Se2::from_angle(heading_rad)));
            return true;
        }
        if behind.moves_left > 0
            && goal.coords.norm() >= params.arrival_m
            && let Some(moved) = self.step_to(robot, goal, params, probe)
        {
            self.rapid.behind = Some(behind.moved(&moved));
            return true;
        }
        // Seen from the normal point or from as near as can be. If the frontier is still there, the
        // robot will be sent to it again, and in the end give it up.
        false
    }

    /// Sets out for another vertex from which one of these goals can be reached; false where the map
    /// knows none.
    ///
    /// What is seen past two corners of a staircase of corridors cannot be reached on the line of
    /// sight, nor by one point beside it.
    pub(super) fn go_round(
        &mut self,
        robot: &mut dyn Robot,
        candidates: &[Candidate],
        params: &RapidParams,
        probe: &mut dyn ExploreProbe,
    ) -> bool {
        let standing = self.standing;
        for &clearance_m in &params.clearances_m {
            for candidate in candidates.iter().filter(|candidate| !candidate.turn_only) {
                let vantage = candidate
                    .goals_in_body
                    .iter()
                    .find_map(|goal| self.maps[0].vantage(&standing, goal, clearance_m));
                let Some(Vantage { way, goal_in_vertex }) = vantage else { continue };
                self.rapid.served =
                    Some(Served { vertex: standing.vertex, goal_in_last: goal_in_vertex });
                self.set_out(robot, way, params, probe);
                return true;
            }
        }
        false
    }
}
