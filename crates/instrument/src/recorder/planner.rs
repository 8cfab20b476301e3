//! What the policy looked at and chose.

use geometry::Point2;
use maps2d::Candidate;
use pose::Se2;
use rerun::RecordingStream;

use crate::InstrumentError;
use crate::columns::{Lines, Now, Points};
use crate::palette;

/// Rows of `belief/planner/..`.
pub(super) struct Planner {
    candidates: Points,
    goal: Points,
    way: Lines,
    given_up: Points,
}

impl Planner {
    pub fn new(name: &str) -> Self {
        let path = |what: &str| format!("{name}/belief/planner/{what}");
        Self {
            candidates: Points::new(path("candidates"), -4.0, 30.0),
            goal: Points::new(path("goal"), -6.0, 31.0),
            way: Lines::new(path("way"), -1.4, 29.0),
            given_up: Points::new(path("given_up"), -5.0, 32.0),
        }
    }

    /// The candidates, from the best (green) to the worst (yellow); grey where refused.
    pub fn candidates(&mut self, scored: &[(Candidate, f64)], belief_from_body: &Se2) {
        for (candidate, colour) in coloured(scored) {
            self.candidates.point(&belief_from_body.transform(&candidate.goals_in_body[0]), colour);
        }
    }

    pub fn goal(&mut self, goal_in_body: &Point2, belief_from_body: &Se2) {
        let goal = belief_from_body.transform(goal_in_body);
        self.goal.point(&goal, palette::GOAL);
        self.way.segment(&Point2::from(belief_from_body.translation), &goal, palette::ROUTE);
    }

    pub fn way(&mut self, way: impl IntoIterator<Item = Point2>) {
        self.way.strip(way, palette::ROUTE);
    }

    pub fn given_up(&mut self, goal_in_body: &Point2, belief_from_body: &Se2) {
        self.given_up.point(&belief_from_body.transform(goal_in_body), palette::GIVEN_UP);
    }

    /// Leaves the step out.
    pub fn skip_step(&mut self) {
        self.candidates.forget();
        self.goal.forget();
        self.way.forget();
        self.given_up.forget();
    }

    /// Ends the step.
    pub fn end_step(&mut self, now: &Now) {
        self.candidates.end_row(now);
        self.goal.end_row(now);
        self.way.end_row(now);
        self.given_up.end_row(now);
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.candidates.send(stream)?;
        self.goal.send(stream)?;
        self.way.send(stream)?;
        self.given_up.send(stream)
    }
}

/// Candidates with the colours of their scores.
pub(super) fn coloured(
    scored: &[(Candidate, f64)],
) -> impl Iterator<Item = (&Candidate, crate::columns::Rgba)> {
    let finite = || scored.iter().map(|(_, score)| *score).filter(|score| score.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    scored.iter().map(move |(candidate, score)| {
        let colour = if !score.is_finite() {
            palette::REFUSED
        } else if high > low {
            palette::ramp((score - low) / (high - low))
        } else {
            palette::BEST
        };
        (candidate, colour)
    })
}
