//! What a robot believed, against what was true.

use worlds::Tally;

use crate::Coverage;

/// The judgement of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Whether the robot believed that it had seen everything.
    pub believed_complete: bool,
    /// Share of the reachable free cells that were really seen.
    pub coverage: f64,
    /// The robot believed it, and it was not so.
    pub false_completion: bool,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// Distance at which the robot believed that it was done, metres; `None` unless it did so and
    /// everything was seen (\[ISRR19\] sec. 6).
    pub d_max_m: Option<f64>,
    /// Mean distance at first sight of a cell, metres; `None` unless the robot believed that it
    /// was done and everything was seen (\[ISRR19\] sec. 6).
    pub d_exp_m: Option<f64>,
    /// Free cells, reachable or not.
    pub cells_total: usize,
    /// Free cells that the robot could reach.
    pub cells_reachable: usize,
}

impl Verdict {
    /// Judges a run at its end.
    pub fn new(coverage: &Coverage, tally: &Tally, believed_complete: bool) -> Self {
        let complete = coverage.is_complete();
        Self {
            believed_complete,
            coverage: coverage.fraction(),
            false_completion: believed_complete && !complete,
            distance_m: tally.distance_m,
            d_max_m: (believed_complete && complete).then_some(tally.distance_m),
            d_exp_m: coverage.d_exp_m().filter(|_| believed_complete),
            cells_total: coverage.cells_total(),
            cells_reachable: coverage.cells_reachable(),
        }
    }
}
