//! Gauss-Newton: full steps, downhill or not.
//!
//! 1. Solve `H δ = -g` and take the whole step. The cost may rise: from a start far away the full
//!    steps of the first iterations pass hills that hold damped steps up, which is why they reach
//!    the best known cost from odometry on more graphs.
//! 2. Where the cost falls by clearly more than the linear model promised, the model is too stiff
//!    along the step. A parabola through both tells how much longer the step should be; the longer
//!    one is taken where its cost is lower.
//! 3. Converged where what is left to gain is next to nothing, by the rate of the last iterations.
//! 4. Where the cost has not been below its best for [`PATIENCE`] iterations, or is not a number,
//!    damped steps go on from the best poses ([`levenberg_marquardt`]).

use probe::Probe;

use super::problem::Problem;
use super::state::{LARGEST_DAMPING, Promise, State};
use super::{OptimizerEvent, Options, Termination, levenberg_marquardt};
use crate::factors::Manifold;

/// Iterations in which the cost may stay above its best.
const PATIENCE: usize = 15;

/// A gain ratio above this asks for longer steps.
const STIFF: f64 = 1.3;

/// A step is made at most this many times as long.
const LONGEST: f64 = 4.0;

/// The rate of convergence is taken to be no better than this: the last iterations may have been
/// on the quadratic part, the next ones need not be.
const BEST_RATE: f64 = 0.05;

pub(super) fn run<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Termination {
    let limit = options.max_iterations;
    let mut best = state.cost;
    let mut best_poses = state.poses.clone();
    let mut since_best = 0;
    let mut last_gain = 1.0;
    let mut last_decrease = f64::INFINITY;
    while state.iterations.len() < limit {
        let Some(mut promise) = state.promise(problem, 0.0) else {
            return Termination::Singular { damping: LARGEST_DAMPING, threshold: LARGEST_DAMPING };
        };
        let ending = ending(&promise, last_decrease, state.cost, options);
        last_decrease = promise.decrease;
        problem.moved(&state.poses, &state.step, &mut state.trial);
        if ending.is_none() && last_gain > STIFF {
            lengthen(problem, state, &mut promise);
        }
        let cost = if ending.is_some() {
            problem.evaluate(&state.trial)
        } else {
            problem.linearize(&state.trial)
        };
        std::mem::swap(&mut state.poses, &mut state.trial);
        let before = std::mem::replace(&mut state.cost, cost);
        state.record(problem, promise, cost, true, before, probe);
        if let Some(ending) = ending {
            return ending;
        }
        last_gain = (before - cost) / promise.decrease;
        if cost < best {
            best = cost;
            best_poses.clone_from(&state.poses);
            since_best = 0;
        } else {
            since_best += 1;
        }
        if !cost.is_finite() || since_best == PATIENCE {
            state.poses.clone_from(&best_poses);
            state.cost = problem.linearize(&state.poses);
            return levenberg_marquardt::run(problem, state, options, probe);
        }
    }
    if state.cost > best {
        state.poses = best_poses;
        state.cost = problem.evaluate(&state.poses);
    }
    Termination::IterationLimit { iterations: limit, limit }
}

/// Whether the step that was just found is the last one.
fn ending(
    promise: &Promise,
    last_decrease: f64,
    cost: f64,
    options: &Options,
) -> Option<Termination> {
    if promise.step_max <= options.step || cost == 0.0 {
        return Some(Termination::StepConverged {
            step: promise.step_max,
            threshold: options.step,
        });
    }
    let rate = (promise.decrease / last_decrease).max(BEST_RATE);
    let rest = if rate < 0.5 { promise.decrease * rate / (1.0 - rate) } else { promise.decrease };
    let relative_decrease = rest / cost;
    let threshold = options.relative_decrease;
    (relative_decrease <= threshold)
        .then_some(Termination::CostConverged { relative_decrease, threshold })
}

/// Tries a longer step along the current one, and keeps it where its cost is lower.
fn lengthen<P: Manifold<D>, const D: usize>(
    problem: &Problem<'_, P, D>,
    state: &mut State<P>,
    promise: &mut Promise,
) {
    let cost = problem.cost(&state.trial);
    let gain = (state.cost - cost) / promise.decrease;
    if gain <= STIFF || !gain.is_finite() {
        return;
    }
    // Along the step the cost is f - 2αp + α²q with the promise p, and gain = 2 - q/p.
    let share = 2.0 - gain;
    let factor = if share > 1.0 / LONGEST { 1.0 / share } else { LONGEST };
    for entry in &mut state.step {
        *entry *= factor;
    }
    let mut longer = Vec::with_capacity(state.trial.len());
    problem.moved(&state.poses, &state.step, &mut longer);
    if problem.cost(&longer) < cost {
        state.trial = longer;
        promise.step_norm *= factor;
        promise.step_max *= factor;
    }
}
