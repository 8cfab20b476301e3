//! Whether matches agree: with the graph, and with each other.

use pose::nalgebra::Matrix3;
use pose::{Se2, covariance_of_compose, covariance_of_inverse};

use crate::{Measured, Seen};

/// Squared length of a deviation in units of its covariance; infinite where that is singular.
pub fn squared_deviation(expected: &Se2, measured: &Se2, covariance: &Matrix3<f64>) -> f64 {
    let error = measured.boxminus(expected);
    match covariance.cholesky() {
        Some(factor) => error.dot(&factor.solve(&error)),
        None => f64::INFINITY,
    }
}

/// How far a match is from where the graph has the known keyframe, `current_from_known`, in units of
/// both covariances, squared.
pub fn against_graph(matched: &Measured, seen: &Seen) -> f64 {
    // Both as the current keyframe in the known one's frame.
    let expected = seen.root_from_keyframe.inverse();
    let covariance = covariance_of_inverse(&seen.root_from_keyframe, &seen.covariance);
    squared_deviation(&expected, &matched.from_from_to, &(covariance + matched.covariance))
}

/// How far two matches are from closing a loop, in units of all covariances on it, squared; with the
/// deviation itself (Mangelson et al. 2018).
///
/// `between_known` is the second's known keyframe seen from the first's, `between_current` the same for
/// the current ones.
pub fn against_each_other(
    first: &Measured,
    second: &Measured,
    between_known: &Seen,
    between_current: &Seen,
) -> (f64, Se2) {
    // known1 -> current1 -> current2, and known1 -> known2 -> current2.
    let one = first.from_from_to * between_current.root_from_keyframe;
    let cov_one = covariance_of_compose(
        &first.covariance,
        &between_current.root_from_keyframe,
        &between_current.covariance,
    );
    let other = between_known.root_from_keyframe * second.from_from_to;
    let cov_other =
        covariance_of_compose(&between_known.covariance, &second.from_from_to, &second.covariance);
    (squared_deviation(&one, &other, &(cov_one + cov_other)), one.inverse_mul(&other))
}
