//! What a probe sees of an optimisation.

use super::{Iteration, Report};

/// The size of the normal equations and of their factor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fill {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Stored numbers in the lower triangle of the matrix.
    pub matrix: usize,
    /// Stored numbers in its factor.
    pub factor: usize,
}

/// Facts about a running optimisation, in the past tense.
#[derive(Clone, Copy, Debug)]
pub enum OptimizerEvent<'a, P> {
    /// The graph was analysed; nothing has moved.
    Started {
        /// `map_from_body` of every vertex.
        poses: &'a [P],
        /// `eᵀ Ω e` of each factor.
        factor_chi2: &'a [f64],
        /// Weight of each factor.
        weights: &'a [f64],
        /// The size of the linear systems.
        fill: Fill,
    },
    /// An iteration was done.
    Iterated {
        /// What it did.
        iteration: &'a Iteration,
        /// `map_from_body` of every vertex after it.
        poses: &'a [P],
        /// `eᵀ Ω e` of each factor at these poses.
        factor_chi2: &'a [f64],
        /// Weight of each factor at these poses.
        weights: &'a [f64],
    },
    /// The optimisation ended.
    Finished {
        /// What was done, and why it ended.
        report: &'a Report,
    },
}
