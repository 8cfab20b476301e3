//! When to stop going somewhere: the rule that ends every run.

use std::collections::VecDeque;

use maps2d::Frontier;

use crate::{Explorer, RapidParams};

/// What a map has left is compared with this many of its values before.
const REMEMBERED: usize = 8;

/// Lengths of frontier that differ by less are the same, metres: a large map sums up so many that
/// going to and fro between the same places never gives the same bits twice.
const SAME_M: f64 = 1e-3;

/// How long the robot goes on while nothing changes.
///
/// A map of cells may send the robot to and fro between two places for ever, if what it sees at
/// each makes the other look better.
#[derive(Clone, Debug, Default)]
pub(crate) struct Patience {
    /// What was left when the robot was sent before, latest last.
    left: VecDeque<Frontier>,
    /// Actions taken while what is left was one of those.
    actions: u32,
}

impl Explorer {
    /// Whether the robot should go on to a goal at the end of a way of this length: false when it
    /// acted for longer than such a way takes, and all the while nothing new was left or gone.
    pub(super) fn is_worth_going(&mut self, length_m: f64, params: &RapidParams) -> bool {
        let left = self.maps[0].frontier();
        let patience = &mut self.rapid.patience;
        let is_same = |before: &Frontier| {
            before.places == left.places && (before.open_m - left.open_m).abs() < SAME_M
        };
        if !patience.left.iter().any(is_same) {
            if patience.left.len() == REMEMBERED {
                patience.left.pop_front();
            }
            patience.left.push_back(left);
            patience.actions = 0;
        }
        // For every step of the way a turn or two, and as much again for going round.
        if f64::from(patience.actions) >= 60.0 + 6.0 * length_m / params.step_m {
            *patience = Patience::default();
            return false;
        }
        patience.actions += 1;
        true
    }
}
