//! The line between closures that are believed and those that are not.

use super::believed::Believed;
use super::chi_square::chi_square_quantile;
use super::noise::scale_of_closures;
use crate::factors::Manifold;

/// Probability with which a good closure passes, were its noise Gaussian: real tails are heavier, and
/// wrong closures are seldom near.
const GATE: f64 = 1.0 - 1e-6;

/// Scales of fewer closures are not believed.
const FEWEST: usize = 5;

/// What a method without a settled map rejects may be this many gates off.
pub(super) const SLACK: f64 = 4.0;

/// The largest `χ²` at which a closure of `degrees` dimensions is believed.
pub(super) fn gate(scale: f64, degrees: usize) -> f64 {
    chi_square_quantile(GATE, degrees) * scale
}

/// The scale that closures of weight over ½ are held against: by `told`, the `χ²` of each closure, or by
/// the `own` of all that is believed where that says more.
pub(super) fn scale_at<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    own: &[f64],
    told: &[f64],
    weights: &[f64],
    otherwise: f64,
    widest: f64,
) -> f64 {
    let taken: Vec<f64> =
        believed.closures().filter(|&k| weights[k] > 0.5).map(|k| told[k]).collect();
    if taken.len() < FEWEST {
        return otherwise;
    }
    let closures = scale_of_closures(taken, D).unwrap_or(0.0);
    let all = believed.chi2_per_degree(own, weights).unwrap_or(0.0);
    let scale = closures.max(all.min(widest * closures));
    if scale > 0.0 && scale.is_finite() { scale } else { otherwise }
}
