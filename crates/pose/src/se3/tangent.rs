//! Between tangent vectors and motions of space: exponential, logarithm, perturbation.

use nalgebra::{Vector3, Vector6};

use super::group::renormalized;
use crate::{Se3, So3};

/// Below this angle the coefficients are summed as series: their closed forms cancel.
const SERIES_BELOW_RAD: f64 = 1.5;

/// Terms of a series; the first one left out is below rounding at the limit.
const TERMS: i32 = 12;

/// The coefficients of powers of a rotation vector's matrix in the Jacobians of SO(3) and SE(3).
#[derive(Clone, Copy, Debug)]
pub(super) struct Series {
    /// `(1 - cos θ) / θ²`.
    pub b: f64,
    /// `(θ - sin θ) / θ³`.
    pub c: f64,
    /// `(θ² + 2 cos θ - 2) / 2θ⁴`.
    pub e: f64,
    /// `(2θ - 3 sin θ + θ cos θ) / 2θ⁵`.
    pub f: f64,
}

impl Series {
    pub(super) fn new(theta: f64) -> Self {
        let square = theta * theta;
        if theta >= SERIES_BELOW_RAD {
            let (sin, cos) = theta.sin_cos();
            return Self {
                b: (1.0 - cos) / square,
                c: (theta - sin) / (square * theta),
                e: (0.5 * square + cos - 1.0) / (square * square),
                f: (2.0 * theta - 3.0 * sin + theta * cos) / (2.0 * square * square * theta),
            };
        }
        // Each is a sum over k of (-θ²)ᵏ / (2k + m)! with m = 2, 3, 4, and (k + 1) times that with
        // m = 5; summed from the inside out, each divisor the ratio of neighbouring factorials.
        let (mut b, mut c, mut e, mut f) = (1.0, 1.0, 1.0, 1.0);
        for k in (1..TERMS).rev().map(f64::from) {
            let n = 2.0 * k;
            b = 1.0 - b * square / ((n + 1.0) * (n + 2.0));
            c = 1.0 - c * square / ((n + 2.0) * (n + 3.0));
            e = 1.0 - e * square / ((n + 3.0) * (n + 4.0));
            f = 1.0 - f * square * (k + 1.0) / (k * (n + 4.0) * (n + 5.0));
        }
        Self { b: b / 2.0, c: c / 6.0, e: e / 24.0, f: f / 120.0 }
    }

    /// `(1 - θ/2 · cot θ/2) / θ²`, the coefficient of the square in the inverse Jacobians.
    #[inline]
    pub(super) fn inverse_square(theta: f64) -> f64 {
        let square = theta * theta;
        if theta >= 0.25 {
            let half = 0.5 * theta;
            return (1.0 - half / half.tan()) / square;
        }
        // Bernoulli numbers over factorials.
        1.0 / 12.0
            + square
                * (1.0 / 720.0
                    + square
                        * (1.0 / 30_240.0
                            + square
                                * (1.0 / 1_209_600.0
                                    + square
                                        * (1.0 / 47_900_160.0
                                            + square * 691.0 / 1_307_674_368_000.0))))
    }
}

impl Se3 {
    /// The motion reached after one second at the constant body velocity `xi`.
    ///
    /// `xi` is `[x_m, y_m, z_m, rx_rad, ry_rad, rz_rad]` in the source frame; turns beyond π wind
    /// round.
    #[inline]
    pub fn exp(xi: &Vector6<f64>) -> Self {
        let (rho, phi) = parts(xi);
        let Series { b, c, .. } = Series::new(phi.norm());
        let turned = phi.cross(&rho);
        Self { rotation: So3::exp(&phi), translation: rho + turned * b + phi.cross(&turned) * c }
    }

    /// The tangent vector whose [`exp`](Self::exp) is this motion, with a turn of at most π.
    ///
    /// At half a turn two vectors have the same exponential; rounding decides between them.
    #[inline]
    pub fn log(&self) -> Vector6<f64> {
        let phi = So3::log(&self.rotation);
        let turned = phi.cross(&self.translation);
        let rho = self.translation - turned * 0.5
            + phi.cross(&turned) * Series::inverse_square(phi.norm());
        Vector6::new(rho.x, rho.y, rho.z, phi.x, phi.y, phi.z)
    }

    /// This motion perturbed on the right: `self · exp(delta)`, with `delta` in the source frame.
    #[inline]
    pub fn boxplus(&self, delta: &Vector6<f64>) -> Self {
        *self * Self::exp(delta)
    }

    /// The perturbation that leads from `base` to this motion: `log(base⁻¹ · self)`.
    ///
    /// `base.boxplus(&self.boxminus(&base))` is `self`.
    pub fn boxminus(&self, base: &Self) -> Vector6<f64> {
        let base_from_self = base.inverse_mul(self);
        Self { rotation: renormalized(base_from_self.rotation), ..base_from_self }.log()
    }
}

/// The translation part and the rotation part of a tangent vector.
#[inline]
pub(super) fn parts(xi: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (xi.fixed_rows::<3>(0).into_owned(), xi.fixed_rows::<3>(3).into_owned())
}
