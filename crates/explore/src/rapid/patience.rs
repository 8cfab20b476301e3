//! When to stop going somewhere: the rules that end every run.

use std::collections::VecDeque;

use geometry::Point2;
use maps2d::Frontier;

use crate::{Explorer, RapidParams};

/// What a map has left is compared with this many of its values before.
const REMEMBERED: usize = 8;

/// Lengths of frontier that differ by less are the same, metres: a large map sums up so many that
/// going to and fro between the same places never gives the same bits twice.
const SAME_M: f64 = 1e-3;

/// How many actions back the goals are remembered.
const GOALS: usize = 1024;

/// A goal is given up when so many of those actions were for it. Many times what going there takes:
/// at a corner between narrow corridors the robot may try for a hundred actions and then get through,
/// and all of a maze may lie behind.
const MOST_FOR_ONE: usize = 400;

/// How long the robot goes on while nothing changes, or for the same goal.
///
/// A map may send the robot to and fro for ever, if what it sees at one place makes another look
/// better and the other way round. Either nothing new is left or gone meanwhile; or something new is
/// left behind in each round, and then it is the goals that come again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Patience {
    /// What was left when the robot was sent before, latest last.
    left: VecDeque<Frontier>,
    /// Actions taken while what is left was one of those.
    actions: u32,
    /// The goals of the last actions, by odometry, latest last: near each other they drift as one.
    goals_in_odom: VecDeque<Point2>,
}

impl Patience {
    /// Whether what is left was so before; remembers it.
    fn is_known(&mut self, left: Frontier) -> bool {
        let is_same = |before: &Frontier| {
            before.places == left.places && (before.open_m - left.open_m).abs() < SAME_M
        };
        let known = self.left.iter().any(is_same);
        if !known {
            keep(&mut self.left, left, REMEMBERED);
        }
        known
    }

    /// How many of the last actions were for this goal; remembers one more.
    fn actions_for(&mut self, goal_in_odom: Point2, radius_m: f64) -> usize {
        let is_same = |before: &&Point2| (*before - goal_in_odom).norm() < radius_m;
        let actions = self.goals_in_odom.iter().filter(is_same).count();
        keep(&mut self.goals_in_odom, goal_in_odom, GOALS);
        actions
    }
}

fn keep<T>(values: &mut VecDeque<T>, value: T, most: usize) {
    if values.len() == most {
        values.pop_front();
    }
    values.push_back(value);
}

impl Explorer {
    /// Whether the robot should go on to a goal at the end of a way of this length: false when it
    /// acted for longer than such a way takes and nothing new was left or gone all the while, or for
    /// very long for this goal.
    pub(super) fn is_worth_going(
        &mut self,
        goal_in_body: &Point2,
        length_m: f64,
        params: &RapidParams,
    ) -> bool {
        let left = self.maps[0].frontier();
        let odom_from_body = self.odom_from_vertex * self.standing.vertex_from_body;
        let goal_in_odom = odom_from_body.transform(goal_in_body);
        let patience = &mut self.rapid.patience;
        if !patience.is_known(left) {
            patience.actions = 0;
        }
        // For every step of the way a turn or two, and as much again for going round.
        let is_idle = f64::from(patience.actions) >= 60.0 + 6.0 * length_m / params.step_m;
        let for_this = patience.actions_for(goal_in_odom, params.give_up_radius_m);
        if is_idle || for_this >= MOST_FOR_ONE {
            *patience = Patience::default();
            return false;
        }
        patience.actions += 1;
        true
    }
}
