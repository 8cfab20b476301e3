//! How likely a random pose is where a good one would be.

use std::f64::consts::{PI, TAU};

use pose::nalgebra::SVector;

use crate::factors::{ErrorKind, Manifold};

/// A side of the box that is shorter than this share of the longest counts as this.
const FLAT: f64 = 1e-3;

/// The volume of the ball of radius 1 in 3 or 6 dimensions.
pub(super) fn ball(degrees: usize) -> f64 {
    if degrees == 3 { 4.0 / 3.0 * PI } else { PI.powi(3) / 6.0 }
}

/// The volume of all relative poses of a map, as tangents: the box around its positions, and every turn.
pub(super) fn tangents<P: Manifold<D>, const D: usize>(poses: &[P]) -> f64 {
    let at = |pose: &P| P::error(ErrorKind::Split, &P::identity(), &P::identity(), pose);
    let axes = if D == 3 { 2 } else { 3 };
    let mut low = SVector::<f64, D>::repeat(f64::INFINITY);
    let mut high = SVector::<f64, D>::repeat(f64::NEG_INFINITY);
    for place in poses.iter().map(at) {
        low = low.inf(&place);
        high = high.sup(&place);
    }
    let sides = high - low;
    let longest = (0..axes).map(|k| sides[k]).fold(0.0, f64::max);
    let box_volume: f64 = (0..axes).map(|k| sides[k].max(FLAT * longest)).product();
    box_volume * if D == 3 { TAU } else { 2.0 * TAU.powi(2) }
}

/// The same, as errors of this kind.
pub(super) fn errors<P: Manifold<D>, const D: usize>(poses: &[P], kind: ErrorKind) -> f64 {
    // The vector part of a quaternion is half of the angle.
    let half = if D == 6 && kind == ErrorKind::G2o { 0.125 } else { 1.0 };
    half * tangents(poses)
}
