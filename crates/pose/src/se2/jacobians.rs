//! Derivatives, all with respect to perturbations on the right.
//!
//! The Jacobian of `f` at `T` is the `J` with `f(T · exp(δ)) = f(T) · exp(J δ)` to first order,
//! where a result that is no motion is perturbed by adding.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Point2, Vector2, Vector3};

use super::tangent::{Turning, Unturning};
use crate::Se2;

/// Below this angle the difference between angle and sine is summed as a series.
const SERIES_BELOW_RAD: f64 = 0.5;

impl Se2 {
    /// The adjoint: `self · exp(δ) · self⁻¹ = exp(Ad δ)`.
    ///
    /// Carries a tangent vector from the source frame, on the right, to the target frame, on the
    /// left.
    pub fn adjoint(&self) -> Matrix3<f64> {
        let (sin, cos) = (self.rotation.im, self.rotation.re);
        let t = self.translation;
        Matrix3::new(cos, -sin, t.y, sin, cos, -t.x, 0.0, 0.0, 1.0)
    }

    /// The right Jacobian of the exponential: `exp(ξ + δ) = exp(ξ) · exp(Jr(ξ) δ)` to first order.
    pub fn right_jacobian(xi: &Vector3<f64>) -> Matrix3<f64> {
        Self::left_jacobian(&-xi)
    }

    /// The left Jacobian of the exponential: `exp(ξ + δ) = exp(Jl(ξ) δ) · exp(ξ)` to first order.
    pub fn left_jacobian(xi: &Vector3<f64>) -> Matrix3<f64> {
        let Turning { a, b } = Turning::new(xi.z);
        let c = turning_column(xi);
        Matrix3::new(a, -b, c.x, b, a, c.y, 0.0, 0.0, 1.0)
    }

    /// The inverse of [`right_jacobian`](Self::right_jacobian): the derivative of
    /// [`log`](Self::log) where `xi` is that logarithm.
    ///
    /// The angle must lie within (-2π, 2π): a full turn has no inverse.
    pub fn right_jacobian_inverse(xi: &Vector3<f64>) -> Matrix3<f64> {
        Self::left_jacobian_inverse(&-xi)
    }

    /// The inverse of [`left_jacobian`](Self::left_jacobian).
    ///
    /// The angle must lie within (-2π, 2π): a full turn has no inverse.
    pub fn left_jacobian_inverse(xi: &Vector3<f64>) -> Matrix3<f64> {
        let unturning = Unturning::new(xi.z);
        let c = -unturning.apply(turning_column(xi));
        let Unturning { a, b } = unturning;
        Matrix3::new(a, b, c.x, -b, a, c.y, 0.0, 0.0, 1.0)
    }

    /// The Jacobians of `self · other` by `self` and by `other`.
    pub fn compose_jacobians(&self, other: &Self) -> (Matrix3<f64>, Matrix3<f64>) {
        (other.inverse().adjoint(), Matrix3::identity())
    }

    /// The Jacobian of [`inverse`](Self::inverse).
    pub fn inverse_jacobian(&self) -> Matrix3<f64> {
        -self.adjoint()
    }

    /// The Jacobians of [`inverse_mul`](Self::inverse_mul), `self⁻¹ · other`, by `self` and by
    /// `other`.
    pub fn inverse_mul_jacobians(&self, other: &Self) -> (Matrix3<f64>, Matrix3<f64>) {
        (-other.inverse_mul(self).adjoint(), Matrix3::identity())
    }

    /// The Jacobians of [`boxminus`](Self::boxminus), `log(base⁻¹ · self)`, by `self` and by `base`.
    pub fn boxminus_jacobians(&self, base: &Self) -> (Matrix3<f64>, Matrix3<f64>) {
        let xi = self.boxminus(base);
        (Self::right_jacobian_inverse(&xi), -Self::left_jacobian_inverse(&xi))
    }

    /// The Jacobians of [`transform`](Self::transform) by the motion and by the point.
    pub fn transform_jacobians(&self, point: &Point2<f64>) -> (Matrix2x3<f64>, Matrix2<f64>) {
        let rotation = self.rotation.to_rotation_matrix().into_inner();
        let turn = rotation * Vector2::new(-point.y, point.x);
        (
            Matrix2x3::from_columns(&[rotation.column(0).into(), rotation.column(1).into(), turn]),
            rotation,
        )
    }

    /// The Jacobians of [`inverse_transform`](Self::inverse_transform) by the motion and by the
    /// point.
    pub fn inverse_transform_jacobians(
        &self,
        point: &Point2<f64>,
    ) -> (Matrix2x3<f64>, Matrix2<f64>) {
        let seen = self.inverse_transform(point);
        let by_motion = Matrix2x3::new(-1.0, 0.0, seen.y, 0.0, -1.0, -seen.x);
        (by_motion, self.rotation.to_rotation_matrix().into_inner().transpose())
    }
}

/// The last column of the left Jacobian: what a change of the angle does to the translation.
fn turning_column(xi: &Vector3<f64>) -> Vector2<f64> {
    let theta = xi.z;
    let half = Turning::new(0.5 * theta);
    // One minus the cosine over the angle squared, by half angles.
    let even = 0.5 * half.a * half.a;
    let odd = lag_of_sine(theta);
    Vector2::new(odd * xi.x + even * xi.y, odd * xi.y - even * xi.x)
}

/// `(θ - sin θ) / θ²`.
fn lag_of_sine(theta: f64) -> f64 {
    if theta.abs() >= SERIES_BELOW_RAD {
        return (theta - theta.sin()) / (theta * theta);
    }
    let square = theta * theta;
    // θ/3! - θ³/5! + θ⁵/7! - ... from the inside out. Each divisor is the ratio of neighbouring
    // factorials; the first term left out is below rounding at the limit.
    let mut sum = 1.0;
    for ratio in [14.0 * 15.0, 12.0 * 13.0, 10.0 * 11.0, 8.0 * 9.0, 6.0 * 7.0, 4.0 * 5.0] {
        sum = 1.0 - sum * square / ratio;
    }
    theta / 6.0 * sum
}
