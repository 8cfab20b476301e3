//! Factors of the plane.

use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};

use super::{Curvature, ErrorKind, Linearized, Manifold};

impl Manifold<3> for Se2 {
    fn identity() -> Self {
        Self::identity()
    }

    #[inline]
    fn compose(&self, other: &Self) -> Self {
        *self * *other
    }

    #[inline]
    fn inverse(&self) -> Self {
        self.inverse()
    }

    #[inline]
    fn between(&self, other: &Self) -> Self {
        self.inverse_mul(other)
    }

    #[inline]
    fn retract(&self, step: &Vector3<f64>) -> Self {
        self.boxplus(step)
    }

    fn local(&self, other: &Self) -> Vector3<f64> {
        other.boxminus(self)
    }

    fn adjoint(&self) -> Matrix3<f64> {
        self.adjoint()
    }

    fn is_finite(&self) -> bool {
        self.translation.iter().all(|x| x.is_finite())
            && self.rotation.re.is_finite()
            && self.rotation.im.is_finite()
    }

    #[inline]
    fn error(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> Vector3<f64> {
        let gap = measured.inverse_mul(&from.inverse_mul(to));
        match kind {
            ErrorKind::G2o | ErrorKind::Split => {
                Vector3::new(gap.translation.x, gap.translation.y, gap.angle())
            }
            ErrorKind::Log => gap.log(),
        }
    }

    #[inline]
    fn linearize(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> Linearized<3> {
        let from_from_to = from.inverse_mul(to);
        let gap = measured.inverse_mul(&from_from_to);
        match kind {
            ErrorKind::G2o | ErrorKind::Split => {
                // A step (ρ, φ) at `to` adds R_gap ρ; one at `from` adds R_Zᵀ (-ρ + φ (y, -x)) with
                // (x, y) where `from` sees `to`, and turns back by φ.
                let (zs, zc) = (measured.rotation.im, measured.rotation.re);
                let (gs, gc) = (gap.rotation.im, gap.rotation.re);
                let seen = from_from_to.translation;
                let (x, y) = (seen.y, -seen.x);
                Linearized {
                    error: Vector3::new(gap.translation.x, gap.translation.y, gap.angle()),
                    by_from: Matrix3::new(
                        -zc,
                        -zs,
                        zc * x + zs * y,
                        zs,
                        -zc,
                        zc * y - zs * x,
                        0.0,
                        0.0,
                        -1.0,
                    ),
                    by_to: Matrix3::new(gc, -gs, 0.0, gs, gc, 0.0, 0.0, 0.0, 1.0),
                }
            }
            ErrorKind::Log => {
                let error = gap.log();
                Linearized {
                    error,
                    by_from: -(Se2::left_jacobian_inverse(&error) * measured.inverse().adjoint()),
                    by_to: Se2::right_jacobian_inverse(&error),
                }
            }
        }
    }

    fn curvature(
        kind: ErrorKind,
        linearized: &Linearized<3>,
        information: &Matrix3<f64>,
    ) -> Option<Curvature<3>> {
        if kind == ErrorKind::Log {
            return None;
        }
        // A step (ρ, φ) moves the translation by R (ρ + ½ φ Jρ) to second order, J a quarter turn;
        // the commutator of two steps is (φ₁ Jρ₂ - φ₂ Jρ₁, 0). Both meet the gradient in R.
        let gradient = linearized.by_to.tr_mul(&(information * linearized.error));
        let (x, y) = (0.5 * gradient.y, -0.5 * gradient.x);
        Some(Curvature {
            along: Matrix3::new(0.0, 0.0, x, 0.0, 0.0, y, x, y, 0.0),
            commutator: Matrix3::new(0.0, 0.0, -x, 0.0, 0.0, -y, x, y, 0.0),
        })
    }
}
