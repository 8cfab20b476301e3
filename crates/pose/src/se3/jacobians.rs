//! Derivatives, all with respect to perturbations on the right, as for the plane.

use nalgebra::{Matrix3, Matrix3x6, Matrix6, Point3, Vector6};

use super::tangent::{Series, parts};
use crate::{Se3, So3};

impl Se3 {
    /// The adjoint: `self · exp(δ) · self⁻¹ = exp(Ad δ)`.
    ///
    /// Carries a tangent vector from the source frame, on the right, to the target frame, on the
    /// left.
    #[inline]
    pub fn adjoint(&self) -> Matrix6<f64> {
        let rotation = self.rotation_matrix();
        blocks(&rotation, &(So3::hat(&self.translation) * rotation), &rotation)
    }

    /// The left Jacobian of the exponential: `exp(ξ + δ) = exp(Jl(ξ) δ) · exp(ξ)` to first order
    /// (Barfoot 2017, State Estimation for Robotics, 7.85).
    pub fn left_jacobian(xi: &Vector6<f64>) -> Matrix6<f64> {
        let (_, phi) = parts(xi);
        let turn = So3::left_jacobian(&phi);
        blocks(&turn, &coupling(xi), &turn)
    }

    /// The right Jacobian of the exponential: `exp(ξ + δ) = exp(ξ) · exp(Jr(ξ) δ)` to first order.
    pub fn right_jacobian(xi: &Vector6<f64>) -> Matrix6<f64> {
        Self::left_jacobian(&-xi)
    }

    /// The inverse of [`left_jacobian`](Self::left_jacobian), for turns below a full one.
    #[inline]
    pub fn left_jacobian_inverse(xi: &Vector6<f64>) -> Matrix6<f64> {
        let (_, phi) = parts(xi);
        let back = So3::left_jacobian_inverse(&phi);
        blocks(&back, &-(back * coupling(xi) * back), &back)
    }

    /// The inverse of [`right_jacobian`](Self::right_jacobian): the derivative of
    /// [`log`](Self::log) where `xi` is that logarithm. For turns below a full one.
    #[inline]
    pub fn right_jacobian_inverse(xi: &Vector6<f64>) -> Matrix6<f64> {
        Self::left_jacobian_inverse(&-xi)
    }

    /// The Jacobians of `self · other` by `self` and by `other`.
    pub fn compose_jacobians(&self, other: &Self) -> (Matrix6<f64>, Matrix6<f64>) {
        (other.inverse().adjoint(), Matrix6::identity())
    }

    /// The Jacobian of [`inverse`](Self::inverse).
    pub fn inverse_jacobian(&self) -> Matrix6<f64> {
        -self.adjoint()
    }

    /// The Jacobians of [`inverse_mul`](Self::inverse_mul), `self⁻¹ · other`, by `self` and by
    /// `other`.
    pub fn inverse_mul_jacobians(&self, other: &Self) -> (Matrix6<f64>, Matrix6<f64>) {
        (-other.inverse_mul(self).adjoint(), Matrix6::identity())
    }

    /// The Jacobians of [`boxminus`](Self::boxminus), `log(base⁻¹ · self)`, by `self` and by `base`.
    pub fn boxminus_jacobians(&self, base: &Self) -> (Matrix6<f64>, Matrix6<f64>) {
        let xi = self.boxminus(base);
        (Self::right_jacobian_inverse(&xi), -Self::left_jacobian_inverse(&xi))
    }

    /// The Jacobians of [`transform`](Self::transform) by the motion and by the point.
    pub fn transform_jacobians(&self, point: &Point3<f64>) -> (Matrix3x6<f64>, Matrix3<f64>) {
        let rotation = self.rotation_matrix();
        let mut by_motion = Matrix3x6::zeros();
        by_motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&rotation);
        by_motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&-(rotation * So3::hat(&point.coords)));
        (by_motion, rotation)
    }
}

/// How a turn couples into the translation: the upper right block of the left Jacobian
/// (Barfoot 2017, 7.86b).
fn coupling(xi: &Vector6<f64>) -> Matrix3<f64> {
    let (rho, phi) = parts(xi);
    let (p, r) = (So3::hat(&phi), So3::hat(&rho));
    let Series { c, e, f, .. } = Series::new(phi.norm());
    let (pr, rp) = (p * r, r * p);
    let prp = pr * p;
    r * 0.5 + (pr + rp + prp) * c + (p * pr + rp * p - prp * 3.0) * e + (prp * p + p * prp) * f
}

/// The matrix `[a b; 0 d]`.
#[inline]
fn blocks(a: &Matrix3<f64>, b: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix6<f64> {
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(a);
    whole.fixed_view_mut::<3, 3>(0, 3).copy_from(b);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(d);
    whole
}
