//! What an optimisation is asked to do.

use super::{Loss, LossOn};
use crate::ErrorKind;

/// How the step of an iteration is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Full steps of the normal equations, downhill or not; reaches furthest from odometry.
    #[default]
    GaussNewton,
    /// Damped steps; a step that raises the cost is taken back.
    LevenbergMarquardt,
    /// Steps within a trust region, between steepest descent and Gauss-Newton (Powell 1970).
    Dogleg,
}

/// Options of an optimisation; the default suits most graphs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the step of an iteration is found.
    pub solver: Solver,
    /// Which error is minimised.
    pub error: ErrorKind,
    /// How the cost of a factor grows.
    pub loss: Loss,
    /// Which factors the loss is applied to.
    pub loss_on: LossOn,
    /// Iterations are ended here.
    pub max_iterations: usize,
    /// Converged where at most this share of the cost is left to gain, by the rate of the last
    /// iterations.
    pub relative_decrease: f64,
    /// Converged where no entry of a step is longer than this, metres or radians.
    pub step: f64,
    /// Threads that may work at the same time; the result has the same bits for every number.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            solver: Solver::GaussNewton,
            error: ErrorKind::G2o,
            loss: Loss::None,
            loss_on: LossOn::Closures,
            max_iterations: 100,
            relative_decrease: 5e-8,
            step: 1e-9,
            threads: 1,
        }
    }
}
