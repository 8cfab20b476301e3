//! Who is believed in the end.

use std::f64::consts::TAU;

use super::believed::Believed;
use super::chance::{ball, errors};
use super::chi_square::chi_square_quantile;
use super::gate::{gate, scale_at};
use super::prediction::{Prediction, predictions};
use crate::factors::Manifold;
use crate::solvers::{OptimizerEvent, Solution};

/// In the end what is believed as a whole counts up to this many times the scale of closures: a graph
/// with few closures shows its noise in odometry only.
const WIDEST: f64 = 100.0;

/// Expected number of random closures, among all that are rejected, that may come within the limits by
/// chance.
const CHANCE: f64 = 0.02;

/// Up to here limits grow beyond the gate where chance allows it: real noise has tails.
const TAILS: f64 = 16.0;

/// A prediction may be off so many times as far as the closure and is still no matter of chance.
const LOOSE: f64 = 3.0;

/// A wrong closure that is taken where the prediction is looser counts this many times as much as
/// a genuine one left out: it moves the whole way that leads there.
const HARM: f64 = 200.0;

/// Probability with which a good closure passes there, were its noise Gaussian.
const THERE: f64 = 0.99;

/// Predictions are worked out up to this many times the largest limit that errors alone suggest.
const ROOM: f64 = 4.0;

/// Of closures to leave out those go first that are at least this share of the worst as far off: others
/// may only suffer from them.
const SHARE_OF_WORST: f64 = 0.25;

/// How often a closure may be left out before it stays out.
const LEAVINGS: usize = 2;

/// Rounds of judging and optimising again.
const ROUNDS: usize = 30;

/// Closures that were told apart, and what follows.
pub(super) struct Settled<P> {
    pub solution: Solution<P>,
    /// The `χ²` up to which a closure is believed wherever it is.
    pub gate: f64,
    pub iterations: usize,
}

/// Holds each closure against what the rest of the graph predicts, takes those that agree and leaves the
/// others out, optimises, and asks again, until nothing changes.
///
/// `weights` are those that a method came to; closures of less than ½ are left out at first.
pub(super) fn settle<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    mut poses: Vec<P>,
    weights: &[f64],
    otherwise: f64,
    probe: &mut impl for<'e> probe::Probe<OptimizerEvent<'e, P>>,
) -> Settled<P> {
    let mut weights: Vec<f64> = (weights.iter().zip(&believed.trusting))
        .map(|(weight, trusting)| if *weight < 0.5 { 0.0 } else { *trusting })
        .collect();
    let mut left = vec![0; weights.len()];
    let mut iterations = 0;
    let mut line = 0.0;
    for _ in 0..ROUNDS {
        let (moved, done) = believed.descend(&poses, &weights, &believed.options);
        poses = moved;
        iterations += done;
        let judged = judge(believed, &poses, &weights, otherwise);
        line = judged.gate;
        let worst = (judged.excess.iter())
            .filter(|(index, _)| weights[*index] > 0.0)
            .map(|(_, excess)| *excess)
            .fold(1.0, |worst, excess| f64::max(worst, SHARE_OF_WORST * excess));
        let mut changed = false;
        for (index, excess) in judged.excess {
            if weights[index] > 0.0 && excess > worst {
                weights[index] = 0.0;
                left[index] += 1;
                changed = true;
            } else if weights[index] == 0.0 && excess <= 1.0 && left[index] < LEAVINGS {
                weights[index] = believed.trusting[index];
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    let solution = believed.finish(&poses, &weights, probe);
    iterations += solution.report.iterations.len();
    Settled { solution, gate: line, iterations }
}

/// How far closures are beyond their limits.
struct Judged {
    /// Index, and `χ²` over the limit.
    excess: Vec<(usize, f64)>,
    gate: f64,
}

fn judge<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    poses: &[P],
    weights: &[f64],
    otherwise: f64,
) -> Judged {
    let own = believed.chi2(poses);
    let first = gate(scale_at(believed, &own, &own, weights, otherwise, WIDEST), D);
    let mut beyond = ROOM * TAILS * first;
    let (predicted, line) = loop {
        let Some(predicted) = predictions(believed, poses, weights, beyond) else {
            // Without predictions the errors themselves must do.
            let excess = believed.closures().map(|index| (index, own[index] / first)).collect();
            return Judged { excess, gate: first };
        };
        let mut told = own.clone();
        for prediction in &predicted {
            told[prediction.index] = prediction.chi2;
        }
        let line = gate(scale_at(believed, &own, &told, weights, otherwise, WIDEST), D);
        if TAILS * line <= beyond {
            break (predicted, line);
        }
        // Errors are smaller than what is predicted without them.
        beyond = ROOM * TAILS * line;
    };
    let rejected = predicted.iter().filter(|own| weights[own.index] == 0.0).count().max(1);
    let taken = (predicted.len() - rejected.min(predicted.len())).max(1);
    let limits = Limits {
        gate: line,
        scale: line / gate(1.0, D),
        volume: errors(poses, believed.options.error),
        rejected: rejected as f64,
        odds: taken as f64 / rejected as f64,
        least: chi_square_quantile(THERE, D) / gate(1.0, D) * line,
    };
    let excess =
        (predicted.iter()).map(|own| (own.index, own.chi2 / limits.of::<D>(own))).collect();
    Judged { excess, gate: line }
}

/// Up to which `χ²` closures are believed.
struct Limits {
    gate: f64,
    scale: f64,
    /// Of all errors that there can be.
    volume: f64,
    rejected: f64,
    /// Taken closures for each that is rejected.
    odds: f64,
    least: f64,
}

impl Limits {
    /// More than the gate where chance allows it, and less where the prediction is so loose that an error
    /// of this size is likelier by chance.
    fn of<const D: usize>(&self, own: &Prediction) -> f64 {
        let by_chance = CHANCE / self.rejected * self.volume / (ball(D) * own.spread);
        // Not `clamp`, which panics where a map is not finite.
        let least = if own.looseness < LOOSE {
            self.gate
        } else {
            self.even::<D>(own).max(self.least).min(self.gate)
        };
        by_chance.powf(2.0 / D as f64).max(least).min(TAILS * self.gate)
    }

    /// Where an error does as much harm, in the mean, by being taken as by being left out.
    fn even<const D: usize>(&self, own: &Prediction) -> f64 {
        let density = (TAU * self.scale).powf(0.5 * D as f64) * own.spread;
        2.0 * self.scale * (self.odds / HARM * self.volume / density).ln()
    }
}
