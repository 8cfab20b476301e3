//! Levenberg-Marquardt: damped steps, and only downhill.
//!
//! 1. Solve `(H + λ diag H) δ = -g` (Marquardt 1963).
//! 2. Take the step where the cost falls; the damping follows the gain ratio (Nielsen 1999).
//! 3. Where it rises, raise the damping, each time by a larger factor, and solve again.

use probe::Probe;

use super::problem::Problem;
use super::state::{LARGEST_DAMPING, SINGULAR, State, gain_ratio};
use super::{OptimizerEvent, Options, Termination};
use crate::factors::Manifold;

/// Damping of the first iteration.
const FIRST: f64 = 1e-5;

/// Damping below this is as good as none.
const LEAST: f64 = 1e-14;

pub(super) fn run<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Termination {
    let (mut damping, mut growth) = (FIRST, 2.0);
    while state.iterations.len() < options.max_iterations {
        let Some(promise) = state.promise(problem, damping) else {
            return SINGULAR;
        };
        damping = promise.damping;
        problem.moved(&state.poses, &state.step, &mut state.trial);
        let cost = problem.cost(&state.trial);
        let before = state.cost;
        let gain = gain_ratio(before - cost, promise.decrease);
        let accepted = cost.is_finite() && cost <= before;
        let relative_decrease = promise.decrease / before;
        // The promise of a damped step says little about convergence.
        let last = (damping <= 1e-3 || !accepted) && relative_decrease <= options.relative_decrease
            || promise.step_max <= options.step;
        if accepted {
            state.accept(problem, cost, last);
            damping = (damping * (1.0 - (2.0 * gain - 1.0).powi(3)).max(0.1)).max(LEAST);
            growth = 2.0;
        } else {
            damping *= growth;
            growth *= 2.0;
        }
        state.record(problem, promise, cost, accepted, before, probe);
        if last || before == 0.0 {
            return promise.converged(relative_decrease, options);
        }
        if damping > LARGEST_DAMPING {
            return Termination::Stalled { damping, threshold: LARGEST_DAMPING };
        }
    }
    Termination::IterationLimit {
        iterations: options.max_iterations,
        limit: options.max_iterations,
    }
}
