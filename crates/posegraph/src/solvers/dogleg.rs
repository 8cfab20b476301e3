//! Powell's dogleg: within a trust region, from steepest descent towards Gauss-Newton.
//!
//! Lengths are measured in units of the diagonal of `H`, so that metres and radians compare.
//!
//! 1. The Gauss-Newton step, taken where it lies within the region.
//! 2. Else the way from the minimum along steepest descent to the Gauss-Newton step, cut where it
//!    leaves the region; steepest descent itself where already that does (Powell 1970).
//! 3. The radius follows the gain ratio; a step that raises the cost is taken back.

use probe::Probe;

use super::problem::Problem;
use super::state::{Promise, SINGULAR, State, gain_ratio};
use super::{OptimizerEvent, Options, Termination};
use crate::factors::Manifold;

/// The region is not made smaller than this share of the Gauss-Newton step.
const SMALLEST_SHARE: f64 = 1e-12;

pub(super) fn run<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Termination {
    let limit = options.max_iterations;
    let mut radius = f64::INFINITY;
    let mut newton: Vec<f64> = Vec::new();
    let mut cauchy: Vec<f64> = Vec::new();
    let mut fresh: Option<Promise> = None;
    for _ in 0..limit {
        let full = match fresh {
            Some(full) => full,
            None => {
                let Some(full) = state.promise(problem, 0.0) else {
                    return SINGULAR;
                };
                newton.clone_from(&state.step);
                cauchy_point(problem, &state.poses, &mut cauchy);
                full
            }
        };
        let newton_length = length(problem, &newton);
        if radius.is_infinite() {
            radius = newton_length;
        }
        let (promised, whole) = if newton_length <= radius {
            state.step.clone_from(&newton);
            (full.decrease, true)
        } else {
            cut(problem, &cauchy, &newton, radius, &mut state.step);
            let along: f64 =
                state.step.iter().zip(&problem.gradient).map(|(step, g)| step * g).sum();
            (-2.0 * along - problem.curvature(&state.step, &state.poses), false)
        };
        let mut promise = state.promise_of_step(problem, 0.0);
        promise.decrease = promised;
        promise.damping = radius;
        problem.moved(&state.poses, &state.step, &mut state.trial);
        let cost = problem.cost(&state.trial);
        let before = state.cost;
        let gain = gain_ratio(before - cost, promised);
        let accepted = cost.is_finite() && cost <= before;
        let relative_decrease = full.decrease / before;
        let last = full.step_max <= options.step || relative_decrease <= options.relative_decrease;
        if accepted {
            state.accept(problem, cost, last);
        }
        fresh = if accepted { None } else { Some(full) };
        let reached = if whole { newton_length } else { radius };
        if gain > 0.75 {
            radius = radius.max(3.0 * reached);
        } else if !accepted || gain < 0.25 {
            radius = 0.25 * reached;
        }
        state.record(problem, promise, cost, accepted, before, probe);
        if last || before == 0.0 {
            return full.converged(relative_decrease, options);
        }
        if radius < SMALLEST_SHARE * newton_length {
            return Termination::Stalled { damping: radius, threshold: SMALLEST_SHARE };
        }
    }
    Termination::IterationLimit { iterations: limit, limit }
}

/// The minimum of the linear model along steepest descent.
fn cauchy_point<P: Manifold<D>, const D: usize>(
    problem: &Problem<'_, P, D>,
    poses: &[P],
    cauchy: &mut Vec<f64>,
) {
    cauchy.clear();
    cauchy.extend(
        problem
            .gradient
            .iter()
            .zip(problem.diagonal())
            .map(|(gradient, diagonal)| if *diagonal > 0.0 { -gradient / diagonal } else { 0.0 }),
    );
    let along: f64 = cauchy.iter().zip(&problem.gradient).map(|(step, g)| -step * g).sum();
    let curvature = problem.curvature(cauchy, poses);
    let reach = if curvature > 0.0 { along / curvature } else { 0.0 };
    for entry in cauchy {
        *entry *= reach;
    }
}

/// Length of a step in units of the diagonal.
fn length<P: Manifold<D>, const D: usize>(problem: &Problem<'_, P, D>, step: &[f64]) -> f64 {
    step.iter().zip(problem.diagonal()).map(|(step, d)| step * step * d).sum::<f64>().sqrt()
}

/// Where the way to the Cauchy point and on to the Newton step leaves the region.
fn cut<P: Manifold<D>, const D: usize>(
    problem: &Problem<'_, P, D>,
    cauchy: &[f64],
    newton: &[f64],
    radius: f64,
    step: &mut Vec<f64>,
) {
    step.clear();
    let first = length(problem, cauchy);
    if first >= radius {
        step.extend(cauchy.iter().map(|entry| entry * radius / first));
        return;
    }
    // |c + t (n - c)|² = r², with t in (0, 1].
    let (mut square, mut mixed) = (0.0, 0.0);
    for ((c, n), d) in cauchy.iter().zip(newton).zip(problem.diagonal()) {
        square += (n - c) * (n - c) * d;
        mixed += c * (n - c) * d;
    }
    let rest = radius * radius - first * first;
    let root = (mixed * mixed + square * rest).sqrt();
    let t = if mixed > 0.0 { rest / (mixed + root) } else { (root - mixed) / square };
    step.extend(cauchy.iter().zip(newton).map(|(c, n)| c + t.clamp(0.0, 1.0) * (n - c)));
}
