//! Where an optimisation stands.

use probe::Probe;

use super::problem::Problem;
use super::{Iteration, OptimizerEvent, Options, Termination};
use crate::factors::Manifold;

/// The first damping that is tried where the matrix is not positive definite.
const FIRST_DAMPING: f64 = 1e-10;

/// The largest damping; steps are then next to nothing.
pub(super) const LARGEST_DAMPING: f64 = 1e12;

/// Where an optimisation stands, and the buffers that its iterations share.
pub(super) struct State<P> {
    /// The poses found so far.
    pub poses: Vec<P>,
    /// Their cost.
    pub cost: f64,
    /// The step of this iteration, in elimination order.
    pub step: Vec<f64>,
    /// The poses that it leads to.
    pub trial: Vec<P>,
    /// What has been done.
    pub iterations: Vec<Iteration>,
}

/// What is known of a step before it is tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise {
    /// Damping that the step was computed with.
    pub damping: f64,
    /// By how much the linear model lowers the cost.
    pub decrease: f64,
    /// Length of the step.
    pub step_norm: f64,
    /// Its largest entry.
    pub step_max: f64,
    /// Largest entry of the gradient.
    pub gradient_max: f64,
}

impl<P> State<P> {
    /// Solves for the step with at least this damping, with more where the matrix needs it.
    ///
    /// `None` where no damping makes the matrix positive definite.
    pub(super) fn promise<const D: usize>(
        &mut self,
        problem: &mut Problem<'_, P, D>,
        least_damping: f64,
    ) -> Option<Promise>
    where
        P: Manifold<D>,
    {
        let mut damping = least_damping;
        while problem.factorize(damping).is_err() {
            damping = if damping == 0.0 { FIRST_DAMPING } else { damping * 100.0 };
            if damping > LARGEST_DAMPING {
                return None;
            }
        }
        problem.solve(&mut self.step);
        Some(self.promise_of_step(problem, damping))
    }

    /// Solves for the step without damping; `None` where the matrix is not positive definite.
    pub(super) fn undamped<const D: usize>(
        &mut self,
        problem: &mut Problem<'_, P, D>,
    ) -> Option<Promise>
    where
        P: Manifold<D>,
    {
        problem.factorize(0.0).ok()?;
        problem.solve(&mut self.step);
        Some(self.promise_of_step(problem, 0.0))
    }

    /// What the linear model promises for the current step, which solved the system with this
    /// damping.
    pub(super) fn promise_of_step<const D: usize>(
        &self,
        problem: &Problem<'_, P, D>,
        damping: f64,
    ) -> Promise
    where
        P: Manifold<D>,
    {
        let (mut along, mut damped, mut square) = (0.0, 0.0, 0.0);
        let (mut step_max, mut gradient_max) = (0.0f64, 0.0f64);
        for ((step, gradient), diagonal) in
            self.step.iter().zip(&problem.gradient).zip(problem.diagonal())
        {
            along -= gradient * step;
            damped += step * step * diagonal;
            square += step * step;
            step_max = step_max.max(step.abs());
            gradient_max = gradient_max.max(gradient.abs());
        }
        Promise {
            damping,
            decrease: along + damping * damped,
            step_norm: f64::sqrt(square),
            step_max,
            gradient_max,
        }
    }

    /// Takes the trial poses, of this cost; linearises there, unless this was the last step.
    pub(super) fn accept<const D: usize>(
        &mut self,
        problem: &mut Problem<'_, P, D>,
        cost: f64,
        last: bool,
    ) where
        P: Manifold<D>,
    {
        std::mem::swap(&mut self.poses, &mut self.trial);
        self.cost = cost;
        if last {
            problem.evaluate(&self.poses);
        } else {
            problem.linearize(&self.poses);
        }
    }

    /// Writes down an iteration.
    pub(super) fn record<const D: usize>(
        &mut self,
        problem: &Problem<'_, P, D>,
        promise: Promise,
        cost: f64,
        accepted: bool,
        cost_before: f64,
        probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
    ) where
        P: Manifold<D>,
    {
        let iteration = Iteration {
            index: self.iterations.len() + 1,
            cost_before,
            cost,
            damping: promise.damping,
            step_norm: promise.step_norm,
            step_max: promise.step_max,
            gradient_max: promise.gradient_max,
            gain_ratio: gain_ratio(cost_before - cost, promise.decrease),
            accepted,
        };
        self.iterations.push(iteration);
        if probe.on() {
            probe.emit(OptimizerEvent::Iterated {
                iteration: &iteration,
                poses: &self.poses,
                factor_chi2: &problem.factor_chi2,
                weights: &problem.weights,
            });
        }
    }
}

impl Promise {
    /// Which of the two thresholds ended an optimisation that has converged with this step.
    pub(super) fn converged(&self, relative_decrease: f64, options: &Options) -> Termination {
        if self.step_max <= options.step {
            Termination::StepConverged { step: self.step_max, threshold: options.step }
        } else {
            Termination::CostConverged { relative_decrease, threshold: options.relative_decrease }
        }
    }
}

/// The end where no damping makes the matrix positive definite.
pub(super) const SINGULAR: Termination =
    Termination::Singular { damping: LARGEST_DAMPING, threshold: LARGEST_DAMPING };

/// How much of a promised decrease came true; 1 where nothing was promised.
pub(super) fn gain_ratio(decrease: f64, promised: f64) -> f64 {
    if promised > 0.0 { decrease / promised } else { 1.0 }
}
