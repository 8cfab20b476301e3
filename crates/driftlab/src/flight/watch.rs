//! What watches a flight from outside: a recording, or nobody.

use explore::{FlightExplorer, FlightProbe, FlightReport};
use metrics::{FlightWitness, VoxelCoverage};
use probe::Off;
use worlds::World3d;

use super::FlightRow;
use crate::run::AtWork;

/// A listener of everything that one flying robot and its maps tell, and of the truth beside it.
pub trait FlightWatch: FlightProbe {
    /// Why it can no longer watch.
    type Error;

    /// Which map is at work can be asked from now on; before the first step.
    fn maps(&mut self, _at_work: &AtWork) {}

    /// The place, once and before the first step.
    ///
    /// # Errors
    /// Where it cannot be written down.
    fn place(&mut self, world: &World3d, coverage: &VoxelCoverage) -> Result<(), Self::Error>;

    /// A step starts; all events until its end belong to it.
    fn step_begins(&mut self, step: u64, distance_m: f64);

    /// A step ended.
    ///
    /// # Errors
    /// Where it cannot be written down.
    fn step_ends(&mut self, end: &FlightSeen<'_>) -> Result<(), Self::Error>;
}

/// What there is to see when a step of a flight has ended.
pub struct FlightSeen<'a> {
    /// The explorer after the step.
    pub explorer: &'a FlightExplorer,
    /// What the step came to.
    pub report: &'a FlightReport,
    /// The truth.
    pub witness: &'a FlightWitness,
    /// The voxels first seen in this step, as indices into the coverage.
    pub newly_seen: &'a [usize],
    /// The rows of the maps in `steps.parquet`, the steering one first.
    pub rows: &'a [&'a FlightRow],
}

impl FlightWatch for Off {
    type Error = std::convert::Infallible;

    fn place(&mut self, _world: &World3d, _coverage: &VoxelCoverage) -> Result<(), Self::Error> {
        Ok(())
    }

    fn step_begins(&mut self, _step: u64, _distance_m: f64) {}

    fn step_ends(&mut self, _end: &FlightSeen<'_>) -> Result<(), Self::Error> {
        Ok(())
    }
}
