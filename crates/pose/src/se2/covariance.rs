//! How uncertainty travels along a chain of motions, to first order.
//!
//! `cov_of_b_in_b` belongs to a motion `a_from_b`: it is the covariance of the δ in
//! `a_from_b · exp(δ)`, a perturbation in the source frame b. Order `[x_m, y_m, theta_rad]`.

use nalgebra::Matrix3;

use crate::Se2;

/// `cov_of_c_in_c` of `a_from_c = a_from_b · b_from_c`, from the covariances of both factors.
///
/// `step_cov_of_c_in_c` is the covariance of `b_from_c`. The errors of the factors must be
/// independent. First order: good while the angle's deviation is well below 1 rad. The result is
/// symmetric exactly.
pub fn covariance_of_compose(
    cov_of_b_in_b: &Matrix3<f64>,
    b_from_c: &Se2,
    step_cov_of_c_in_c: &Matrix3<f64>,
) -> Matrix3<f64> {
    symmetric(carried(&b_from_c.inverse().adjoint(), cov_of_b_in_b) + step_cov_of_c_in_c)
}

/// `cov_of_a_in_a` of `b_from_a`, from the covariance of its inverse `a_from_b`.
///
/// First order and symmetric as [`covariance_of_compose`].
pub fn covariance_of_inverse(a_from_b: &Se2, cov_of_b_in_b: &Matrix3<f64>) -> Matrix3<f64> {
    symmetric(carried(&a_from_b.adjoint(), cov_of_b_in_b))
}

fn carried(by: &Matrix3<f64>, covariance: &Matrix3<f64>) -> Matrix3<f64> {
    by * covariance * by.transpose()
}

fn symmetric(matrix: Matrix3<f64>) -> Matrix3<f64> {
    (matrix + matrix.transpose()) * 0.5
}
