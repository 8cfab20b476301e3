//! What watches a run from outside: a recording, or nobody.

use explore::{ExploreProbe, Explorer, StepReport};
use metrics::{Coverage, Witness};
use probe::Off;
use worlds::World2d;

use super::{AtWork, Disagreement, StepRow};
use crate::export::Fed;

/// A listener of everything that one robot and its maps tell, and of the truth beside it.
pub trait Watch: ExploreProbe {
    /// Why it can no longer watch.
    type Error;

    /// Which map is at work can be asked from now on; before the first step.
    fn maps(&mut self, _at_work: &AtWork) {}

    /// Whether [`StepSeen::fed`] is of use.
    fn wants_feed(&self) -> bool {
        false
    }

    /// The place, once and before the first step.
    ///
    /// # Errors
    /// Where it cannot be written down.
    fn place(&mut self, world: &World2d, coverage: &Coverage) -> Result<(), Self::Error>;

    /// A step starts; all events until its end belong to it.
    fn step_begins(&mut self, step: u64, distance_m: f64, sim_time_secs: f64);

    /// A step ended.
    ///
    /// # Errors
    /// Where it cannot be written down.
    fn step_ends(&mut self, end: &StepSeen<'_>) -> Result<(), Self::Error>;
}

/// What there is to see when a step has ended.
pub struct StepSeen<'a> {
    /// The explorer after the step.
    pub explorer: &'a Explorer,
    /// What the step came to.
    pub report: &'a StepReport,
    /// What the maps were fed in this step; empty unless [`Watch::wants_feed`].
    pub fed: &'a [Fed],
    /// The truth.
    pub witness: &'a Witness,
    /// The cells first seen in this step, as indices into the coverage.
    pub newly_seen: &'a [usize],
    /// The rows of the maps in `steps.parquet`, the steering one first.
    pub rows: &'a [&'a StepRow],
    /// The first disagreement of the maps for its cause, at the step at which it was found.
    pub disagreement: Option<&'a Disagreement>,
}

impl Watch for Off {
    type Error = std::convert::Infallible;

    fn place(&mut self, _world: &World2d, _coverage: &Coverage) -> Result<(), Self::Error> {
        Ok(())
    }

    fn step_begins(&mut self, _step: u64, _distance_m: f64, _sim_time_secs: f64) {}

    fn step_ends(&mut self, _end: &StepSeen<'_>) -> Result<(), Self::Error> {
        Ok(())
    }
}
