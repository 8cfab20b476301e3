//! SO(3): exponential, logarithm and their Jacobians.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::tangent::Series;

/// What belongs to rotations of space alone; the rotations themselves are unit quaternions.
///
/// Tangent vectors are rotation vectors, radians.
#[derive(Clone, Copy, Debug)]
pub struct So3;

impl So3 {
    /// The rotation by the length of `phi` about its direction; full precision for every length.
    #[inline]
    pub fn exp(phi: &Vector3<f64>) -> UnitQuaternion<f64> {
        let half = 0.5 * phi.norm();
        let (sin, cos) = half.sin_cos();
        let scale = if half == 0.0 { 0.5 } else { 0.5 * sin / half };
        UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, phi * scale))
    }

    /// The rotation vector of length at most π, but for rounding, whose [`exp`](Self::exp) is this rotation.
    ///
    /// Precise to rounding for every angle. At half a turn two vectors have the same exponential;
    /// rounding decides between them.
    #[inline]
    pub fn log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
        let v = rotation.imag();
        let sin = v.norm();
        if sin == 0.0 {
            return v * 2.0;
        }
        // Of the two quaternions of a rotation, the one with the angle within half a turn.
        let angle = if rotation.w < 0.0 { sin.atan2(-rotation.w) } else { sin.atan2(rotation.w) };
        v * (if rotation.w < 0.0 { -2.0 } else { 2.0 } * angle / sin)
    }

    /// The matrix of the cross product: `hat(v) · x = v × x`.
    #[inline]
    pub fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
        Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
    }

    /// The left Jacobian of the exponential: `exp(φ + δ) = exp(Jl(φ) δ) · exp(φ)` to first order.
    pub fn left_jacobian(phi: &Vector3<f64>) -> Matrix3<f64> {
        let Series { b, c, .. } = Series::new(phi.norm());
        let hat = Self::hat(phi);
        Matrix3::identity() + hat * b + hat * hat * c
    }

    /// The right Jacobian of the exponential: `exp(φ + δ) = exp(φ) · exp(Jr(φ) δ)` to first order.
    pub fn right_jacobian(phi: &Vector3<f64>) -> Matrix3<f64> {
        Self::left_jacobian(&-phi)
    }

    /// The inverse of [`left_jacobian`](Self::left_jacobian), for lengths below a full turn.
    #[inline]
    pub fn left_jacobian_inverse(phi: &Vector3<f64>) -> Matrix3<f64> {
        let hat = Self::hat(phi);
        Matrix3::identity() - hat * 0.5 + hat * hat * Series::inverse_square(phi.norm())
    }

    /// The inverse of [`right_jacobian`](Self::right_jacobian), for lengths below a full turn.
    #[inline]
    pub fn right_jacobian_inverse(phi: &Vector3<f64>) -> Matrix3<f64> {
        Self::left_jacobian_inverse(&-phi)
    }
}
