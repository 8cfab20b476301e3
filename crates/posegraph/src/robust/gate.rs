//! The line between closures that are believed and those that are not.

use super::believed::Believed;
use super::chi_square::chi_square_quantile;
use super::noise::scale_of_closures;
use crate::factors::Manifold;
use crate::solvers::{OptimizerEvent, Options, Solution};

/// Probability with which a good closure passes, were its noise Gaussian: real tails are heavier, and
/// wrong closures are seldom near.
const GATE: f64 = 1.0 - 1e-6;

/// In the end what is believed as a whole counts up to this many times the scale of closures: a graph
/// with few closures shows its noise in odometry only.
const WIDEST: f64 = 100.0;

/// Scales of fewer closures are not believed.
const FEWEST: usize = 5;

/// In the end a good closure may be twice as far off as the gate allows: one that was left out did not
/// draw the map to itself, and wrong ones are far off by then.
pub(super) const SLACK: f64 = 4.0;

/// So much farther off it may be at first: taken in, it draws the map to itself if it is good, and
/// fails the next round if it is not.
const SECOND_CHANCE: f64 = 64.0;

/// A doubted closure is left out where the map is better off without it by this many gates.
const WORTH: f64 = 2.0;

/// Doubted closures that are tried without, at most: those with the largest `χ²`.
const TRIALS: usize = 20;

/// Rounds of judging and optimising again.
const ROUNDS: i32 = 10;

/// The largest `χ²` at which a closure of `degrees` dimensions is believed.
pub(super) fn gate(scale: f64, degrees: usize) -> f64 {
    chi_square_quantile(GATE, degrees) * scale
}

/// The scale that closures of weight over ½ are held against: by their own residuals, or by all
/// that is believed where that says more.
pub(super) fn scale_at<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    chi2: &[f64],
    weights: &[f64],
    otherwise: f64,
    widest: f64,
) -> f64 {
    let taken: Vec<f64> =
        believed.closures().filter(|&k| weights[k] > 0.5).map(|k| chi2[k]).collect();
    if taken.len() < FEWEST {
        return otherwise;
    }
    let own = scale_of_closures(taken, D).unwrap_or(0.0);
    let all = believed.chi2_per_degree(chi2, weights).unwrap_or(0.0);
    let scale = own.max(all.min(widest * own));
    if scale > 0.0 && scale.is_finite() { scale } else { otherwise }
}

/// Closures that were told apart, and what follows.
pub(super) struct Settled<P> {
    pub solution: Solution<P>,
    /// The largest `χ²` that is believed.
    pub gate: f64,
    pub iterations: usize,
}

/// Takes closures below the gate and leaves the others out, optimises, and asks again, until nothing
/// changes; then tries to do without each that had been left out before.
///
/// `weights` are those that a method came to; closures of less than ½ are the doubted ones.
pub(super) fn settle<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    mut poses: Vec<P>,
    weights: &[f64],
    otherwise: f64,
    probe: &mut impl for<'e> probe::Probe<OptimizerEvent<'e, P>>,
) -> Settled<P> {
    let doubted: Vec<usize> = believed.closures().filter(|&k| weights[k] < 0.5).collect();
    let mut weights = weights.to_vec();
    let mut iterations = 0;
    let mut limit = 0.0;
    let mut earlier: Vec<Vec<f64>> = Vec::new();
    for round in 0..ROUNDS {
        let slack = SLACK.max(SECOND_CHANCE / SLACK.powi(round));
        let chi2 = believed.chi2(&poses);
        limit = slack * gate(scale_at(believed, &chi2, &weights, otherwise, WIDEST), D);
        weights.clone_from(&believed.trusting);
        for index in believed.closures().filter(|&index| chi2[index] > limit) {
            weights[index] = 0.0;
        }
        // Nothing changes, or it goes round in circles.
        if slack == SLACK && earlier.contains(&weights) {
            break;
        }
        earlier.push(weights.clone());
        let (moved, done) = believed.descend(&poses, &weights, &believed.options);
        poses = moved;
        iterations += done;
    }
    iterations += do_without(believed, &mut poses, &mut weights, &doubted, otherwise);
    let solution = believed.finish(&poses, &weights, probe);
    iterations += solution.report.iterations.len();
    Settled { solution, gate: limit, iterations }
}

/// Leaves out each doubted closure that costs more than the gate: its own `χ²` is no measure where the
/// map gives way to it. The iterations done.
fn do_without<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    poses: &mut Vec<P>,
    weights: &mut [f64],
    doubted: &[usize],
    otherwise: f64,
) -> usize {
    let options = Options { max_iterations: 10, relative_decrease: 1e-4, ..believed.options };
    let mut chi2 = believed.chi2(poses);
    let mut taken: Vec<usize> = doubted.iter().copied().filter(|&k| weights[k] > 0.5).collect();
    taken.sort_by(|&a, &b| chi2[b].total_cmp(&chi2[a]));
    taken.truncate(TRIALS);
    let sum = |chi2: &[f64], weights: &[f64]| -> f64 {
        chi2.iter().zip(weights).map(|(chi2, weight)| chi2 * weight).sum()
    };
    let mut iterations = 0;
    for index in taken {
        let with = sum(&chi2, weights);
        weights[index] = 0.0;
        let (moved, done) = believed.descend(poses, weights, &options);
        iterations += done;
        let without = believed.chi2(&moved);
        let limit = WORTH * gate(scale_at(believed, &without, weights, otherwise, WIDEST), D);
        if with - sum(&without, weights) > limit {
            *poses = moved;
            chi2 = without;
        } else {
            weights[index] = believed.trusting[index];
        }
    }
    iterations
}
