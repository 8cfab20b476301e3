//! A first set of closures where neighbours are too few to be witnesses.

use super::believed::Believed;
use super::chance::{ball, errors};
use super::chi_square::chi_square_quantile;
use super::gate::gate;
use super::prediction::predictions;
use crate::factors::Manifold;

/// Probability with which a good closure is within what is predicted.
const WITHIN: f64 = 0.99;

/// Chance of a random closure to be there, at most: at first, ...
const FIRST_CHANCE: f64 = 0.005;

/// ... and in the end.
const LAST_CHANCE: f64 = 0.3;

/// Rounds, at most.
const ROUNDS: usize = 50;

/// Closures that agree with what odometry and the closures taken before predict, the surest first.
///
/// 1. From odometry alone every closure is predicted, with the covariance of the prediction.
/// 2. Those within it are taken where a random pose would hardly be: the ellipsoid is a small part of
///    all relative poses. The graph is optimised with them, and what it predicts is surer now.
/// 3. Where none is left the chance may be twice as large. Closures that the others speak against are
///    left out for good.
pub(super) fn grown<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    start: &[P],
    scale: f64,
) -> Vec<bool> {
    let within = chi_square_quantile(WITHIN, D) * scale;
    let mut weights = believed.trusting.clone();
    for index in believed.closures() {
        weights[index] = 0.0;
    }
    let mut out = vec![false; weights.len()];
    let mut poses = start.to_vec();
    let mut chance = FIRST_CHANCE;
    for _ in 0..ROUNDS {
        poses = believed.descend(&poses, &weights, &believed.options).0;
        let Some(predicted) = predictions(believed, &poses, &weights, within) else {
            break;
        };
        let all = errors(&poses, believed.options.error);
        let ellipsoid = ball(D) * within.powi(D as i32).sqrt();
        let mut changed = false;
        while !changed && chance <= LAST_CHANCE {
            for own in &predicted {
                let index = own.index;
                let unlikely = ellipsoid * own.spread <= chance * all;
                if weights[index] > 0.0 && own.chi2 > gate(scale, D) {
                    (weights[index], out[index]) = (0.0, true);
                    changed = true;
                } else if weights[index] == 0.0 && !out[index] && own.chi2 <= within && unlikely {
                    weights[index] = believed.trusting[index];
                    changed = true;
                }
            }
            if !changed {
                chance *= 2.0;
            }
        }
        if !changed {
            break;
        }
    }
    let mut taken = vec![false; weights.len()];
    for index in believed.closures() {
        taken[index] = weights[index] > 0.0;
    }
    taken
}
