//! Gauss-Newton: full steps.

use probe::Probe;

use super::problem::Problem;
use super::state::{LARGEST_DAMPING, State};
use super::{OptimizerEvent, Options, Termination};
use crate::factors::Manifold;

pub(super) fn run<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Termination {
    for _ in 0..options.max_iterations {
        let Some(promise) = state.promise(problem, 0.0) else {
            return Termination::Singular { damping: LARGEST_DAMPING, threshold: LARGEST_DAMPING };
        };
        problem.moved(&state.poses, &state.step, &mut state.trial);
        let relative_decrease = promise.decrease / state.cost;
        let last = relative_decrease <= options.relative_decrease
            || promise.step_max <= options.step
            || state.cost == 0.0;
        let cost =
            if last { problem.evaluate(&state.trial) } else { problem.linearize(&state.trial) };
        std::mem::swap(&mut state.poses, &mut state.trial);
        let before = std::mem::replace(&mut state.cost, cost);
        state.record(problem, promise, cost, true, before, probe);
        if !cost.is_finite() {
            return Termination::NotFinite { chi2: cost };
        }
        if last {
            return if promise.step_max <= options.step {
                Termination::StepConverged { step: promise.step_max, threshold: options.step }
            } else {
                let threshold = options.relative_decrease;
                Termination::CostConverged { relative_decrease, threshold }
            };
        }
    }
    Termination::IterationLimit {
        iterations: options.max_iterations,
        limit: options.max_iterations,
    }
}
