//! What an optimisation did, and why it ended.

use super::Fill;
use crate::factors::InformationPolicy;

/// Why an optimisation ended, with the measured value and the threshold it was held against.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Termination {
    /// There was hardly anything left to gain.
    CostConverged {
        /// What was left to gain before or after the last step, as a share of the cost.
        relative_decrease: f64,
        /// At most this counts as converged.
        threshold: f64,
    },
    /// The steps became too short to matter.
    StepConverged {
        /// The largest entry of the last step, metres or radians.
        step: f64,
        /// At most this counts as converged.
        threshold: f64,
    },
    /// There was nothing to move: no factors, or every vertex is fixed.
    NothingToDo,
    /// The limit of iterations came first.
    IterationLimit {
        /// Iterations done.
        iterations: usize,
        /// The limit.
        limit: usize,
    },
    /// No step of any length lowered the cost.
    Stalled {
        /// The damping of the last try.
        damping: f64,
        /// The largest that is tried.
        threshold: f64,
    },
    /// The normal equations could not be factorised with any damping.
    Singular {
        /// The damping of the last try.
        damping: f64,
        /// The largest that is tried.
        threshold: f64,
    },
    /// A cost or pose was not a number.
    NotFinite {
        /// The cost at that moment.
        chi2: f64,
    },
    /// There were not as many start poses as vertices.
    StartMissing {
        /// Number of start poses.
        poses: usize,
        /// Number of vertices.
        vertices: usize,
    },
}

impl Termination {
    /// Whether the poses are a stationary point to the asked precision.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::CostConverged { .. } | Self::StepConverged { .. } | Self::NothingToDo)
    }

    /// A name for reports: `cost_converged`, `iteration_limit` and so on.
    pub fn name(self) -> &'static str {
        match self {
            Self::CostConverged { .. } => "cost_converged",
            Self::StepConverged { .. } => "step_converged",
            Self::NothingToDo => "nothing_to_do",
            Self::IterationLimit { .. } => "iteration_limit",
            Self::Stalled { .. } => "stalled",
            Self::Singular { .. } => "singular",
            Self::NotFinite { .. } => "not_finite",
            Self::StartMissing { .. } => "start_missing",
        }
    }
}

/// One iteration: one step that was computed, whether it was taken or not.
///
/// That is one linearisation and one factorisation as a rule: a step that was taken back leaves the
/// linearisation as it was, a last step by the factor before it needs none, and a matrix that is not
/// positive definite is factorised again with more damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Counts from 1.
    pub index: usize,
    /// Cost before the step, with losses and weights.
    pub cost_before: f64,
    /// Cost at the end of the step, whether it was taken or not.
    pub cost: f64,
    /// Damping of the normal equations; the radius of the trust region for dogleg.
    pub damping: f64,
    /// Length of the step over all vertices.
    pub step_norm: f64,
    /// Largest entry of the step, metres or radians.
    pub step_max: f64,
    /// Largest entry of the gradient of half the cost.
    pub gradient_max: f64,
    /// How much of the decrease that the linear model promised came true.
    pub gain_ratio: f64,
    /// Whether the step was taken.
    pub accepted: bool,
}

/// What an optimisation did, and why it ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Why it ended.
    pub termination: Termination,
    /// `χ²` of the start without losses and weights, with information matrices as used.
    pub chi2_initial: f64,
    /// `χ²` of the result without losses and weights, with information matrices as used.
    pub chi2: f64,
    /// Cost of the result with losses and weights: what was minimised.
    pub cost: f64,
    /// Every iteration in order.
    pub iterations: Vec<Iteration>,
    /// Indices of the vertices that were held: the fixed ones, and the first of each component
    /// that has none.
    pub held: Vec<usize>,
    /// Number of connected components.
    pub components: usize,
    /// What was done about information matrices.
    pub information: InformationPolicy,
    /// The size of the linear systems.
    pub fill: Fill,
}

/// Poses, and how they came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution<P> {
    /// `map_from_body` of every vertex.
    pub poses: Vec<P>,
    /// Weight of each factor at the end: the given one times that of the loss.
    pub weights: Vec<f64>,
    /// What was done, and why it ended.
    pub report: Report,
}
