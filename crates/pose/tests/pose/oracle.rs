//! The independent side of every comparison, and where the difficult angles are.

use std::f64::consts::PI;

use pose::Se2;
use pose::nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use proptest::prelude::*;

/// The matrix of a tangent vector, by definition of the order of its entries.
pub fn hat(xi: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -xi.z, xi.x, xi.z, 0.0, xi.y, 0.0, 0.0, 0.0)
}

/// The exponential of a matrix: its power series after scaling, then squaring.
pub fn matrix_exp<const N: usize>(matrix: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    let mut halvings = 0;
    let mut scaled = *matrix;
    while scaled.amax() > 0.125 {
        scaled *= 0.5;
        halvings += 1;
    }
    let mut sum = SMatrix::<f64, N, N>::identity();
    let mut term = SMatrix::<f64, N, N>::identity();
    for k in 1..16 {
        term = term * scaled / f64::from(k);
        sum += term;
    }
    for _ in 0..halvings {
        sum = sum * sum;
    }
    sum
}

/// Fails unless two matrices agree within `tolerance`, relative to their largest entry if that is
/// above 1.
#[track_caller]
pub fn assert_close<const R: usize, const C: usize>(
    left: &SMatrix<f64, R, C>,
    right: &SMatrix<f64, R, C>,
    tolerance: f64,
) {
    let scale = right.amax().max(1.0);
    let error = (left - right).amax();
    assert!(error <= tolerance * scale, "{left} differs from {right} by {error:e}");
}

/// The derivative of `f`, a function of a perturbation, at 0 by central differences.
pub fn central<const R: usize, const C: usize>(
    f: impl Fn(SVector<f64, C>) -> SVector<f64, R>,
) -> SMatrix<f64, R, C> {
    let step = 1e-5;
    SMatrix::from_columns(&std::array::from_fn::<_, C, _>(|column| {
        let mut delta = SVector::<f64, C>::zeros();
        delta[column] = step;
        (f(delta) - f(-delta)) / (2.0 * step)
    }))
}

/// Angles of all sizes and both signs, crowded near 0 and near half a turn.
pub fn angle() -> impl Strategy<Value = f64> {
    let magnitude = (-17.0f64..0.0).prop_map(|exponent| 10f64.powf(exponent));
    let sized = prop_oneof![
        3 => 0.0..PI,
        2 => magnitude.clone(),
        2 => magnitude.prop_map(|below| PI - below),
        1 => prop_oneof![Just(0.0), Just(PI), Just(f64::MIN_POSITIVE), Just(0.5)],
    ];
    (sized, any::<bool>()).prop_map(|(angle, negative)| if negative { -angle } else { angle })
}

/// Tangent vectors with the angles of [`angle`].
pub fn tangent() -> impl Strategy<Value = Vector3<f64>> {
    (-10.0..10.0, -10.0..10.0, angle()).prop_map(|(x, y, theta)| Vector3::new(x, y, theta))
}

/// Motions with the angles of [`angle`].
pub fn motion() -> impl Strategy<Value = Se2> {
    (-10.0..10.0, -10.0..10.0, angle()).prop_map(|(x, y, theta)| Se2::new(x, y, theta))
}

/// The same tangent vector with the size of its angle cut down to `limit_rad`.
pub fn turning_at_most(xi: Vector3<f64>, limit_rad: f64) -> Vector3<f64> {
    Vector3::new(xi.x, xi.y, xi.z.clamp(-limit_rad, limit_rad))
}
