//! Gauss-Newton: full steps, downhill or not.
//!
//! 1. Solve `H δ = -g` and take the whole step. The cost may rise: from a start far away the full
//!    steps of the first iterations pass hills that hold damped steps up, which is why they reach
//!    the best known cost from odometry on more graphs.
//! 2. Where the cost falls by clearly more than the linear model promised, the model is too stiff
//!    along the step. A parabola through both tells how much longer the step should be; the longer
//!    one is taken where its cost is lower.
//! 3. Where the gain ratio is far from 1 near a minimum, residuals are large and full steps converge
//!    slowly. The next matrix holds the second derivatives that Gauss-Newton leaves out
//!    ([`Curvature`](crate::factors::Curvature)): steps are Newton's as long as the matrix is positive
//!    definite and the cost falls.
//! 4. Converged where what is left to gain is next to nothing, by the rate of the last iterations. The
//!    step that tells so is found with the factor of the iteration before, where that will do
//!    ([`last_step`](super::last_step)): one factorisation less. It is not taken where it leads uphill.
//! 5. Where the cost has not been below its best for [`PATIENCE`] iterations, or is not a number,
//!    damped steps go on from the best poses ([`levenberg_marquardt`]).

use probe::Probe;

use super::problem::Problem;
use super::state::{Promise, SINGULAR, State};
use super::{OptimizerEvent, Options, Termination, levenberg_marquardt};
use crate::factors::Manifold;

/// Iterations in which the cost may stay above its best.
const PATIENCE: usize = 15;

/// A gain ratio above this asks for longer steps.
const STIFF: f64 = 1.3;

/// Where a step promises less than this share of the cost, the poses are near a minimum.
const CALM: f64 = 0.1;

/// A gain ratio this far from 1 near a minimum asks for second derivatives.
const UNLIKE: f64 = 0.2;

/// Iterations without second derivatives after they have failed.
const PLAIN_AFTER_NEWTON: usize = 3;

/// A step is made at most this many times as long.
const LONGEST: f64 = 4.0;

/// The rate of convergence is taken to be no better than this: the last iterations may have been
/// on the quadratic part, the next ones need not be.
const BEST_RATE: f64 = 0.05;

/// What the last step may leave unsolved, as a share of what may be left to gain.
const UNSOLVED: f64 = 0.01;

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
    // Whether the matrix holds second derivatives, and the iterations in which it must not.
    let mut newton = false;
    let mut plain = 0;
    // Whether there is a factor, and that of a matrix without damping.
    let mut undamped = false;
    while state.iterations.len() < limit {
        let near = undamped && like(last_gain) && last_decrease < CALM * state.cost;
        if near && let Some(ending) = last_step(problem, state, last_decrease, options, probe) {
            return ending;
        }
        let mut promise = if newton { state.undamped(problem) } else { None };
        if newton && promise.is_none() {
            (newton, plain) = (false, PLAIN_AFTER_NEWTON);
            problem.linearize(&state.poses);
        }
        promise = promise.or_else(|| state.promise(problem, 0.0));
        let Some(mut promise) = promise else {
            return SINGULAR;
        };
        // A rate says something only where the model holds.
        let before_that = if like(last_gain) { last_decrease } else { promise.decrease };
        let ending = ending(&promise, before_that, state.cost, options);
        problem.moved(&state.poses, &state.step, &mut state.trial);
        if ending.is_none() && last_gain > STIFF && !newton {
            lengthen(problem, state, &mut promise);
        }
        let calm = promise.decrease < CALM * state.cost;
        let next_newton = calm && plain == 0 && (newton || !like(last_gain));
        let cost = if ending.is_some() {
            problem.evaluate(&state.trial)
        } else {
            problem.expand(&state.trial, next_newton)
        };
        let before = state.cost;
        if newton && cost > before && ending.is_none() {
            // Newton's step led uphill: the next one is from the same poses without him.
            state.record(problem, promise, cost, false, before, probe);
            (newton, plain) = (false, PLAIN_AFTER_NEWTON);
            problem.linearize(&state.poses);
            continue;
        }
        // Where residuals are large, the last step may lead uphill, as others may: it is not worth it.
        if let Some(ending) = ending
            && cost > before
        {
            state.record(problem, promise, cost, false, before, probe);
            state.cost = problem.evaluate(&state.poses);
            return ending;
        }
        std::mem::swap(&mut state.poses, &mut state.trial);
        state.cost = cost;
        state.record(problem, promise, cost, true, before, probe);
        if let Some(ending) = ending {
            return ending;
        }
        last_gain = (before - cost) / promise.decrease;
        last_decrease = promise.decrease;
        undamped = promise.damping == 0.0;
        plain = plain.saturating_sub(1);
        newton = next_newton;
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

/// Takes the last step by the factor of the iteration before, where that tells that it is the last.
///
/// Poses and matrix stay as they are where it does not.
fn last_step<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    last_decrease: f64,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Option<Termination> {
    let before = state.cost;
    let all = options.relative_decrease * before;
    let promise = state.by_last_factor(problem, all / BEST_RATE, all * UNSOLVED)?;
    let ending = ending(&promise, last_decrease, before, options)?;
    problem.moved(&state.poses, &state.step, &mut state.trial);
    let cost = problem.evaluate(&state.trial);
    if cost.is_nan() || cost > before + all * UNSOLVED {
        return None;
    }
    std::mem::swap(&mut state.poses, &mut state.trial);
    state.cost = cost;
    state.record(problem, promise, cost, true, before, probe);
    Some(ending)
}

/// Whether a gain ratio is near enough to 1 for the model to hold.
fn like(gain: f64) -> bool {
    (gain - 1.0).abs() <= UNLIKE
}

/// Whether the step that was just found is the last one.
fn ending(
    promise: &Promise,
    last_decrease: f64,
    cost: f64,
    options: &Options,
) -> Option<Termination> {
    let rate = (promise.decrease / last_decrease).max(BEST_RATE);
    let rest = if rate < 0.5 { promise.decrease * rate / (1.0 - rate) } else { promise.decrease };
    let relative_decrease = rest / cost;
    // At cost 0 there is no gradient, and no step.
    let ended = promise.step_max <= options.step || relative_decrease <= options.relative_decrease;
    ended.then(|| promise.converged(relative_decrease, options))
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
