//! Factors of space.

use pose::nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use pose::{Se3, So3};

use super::{Curvature, ErrorKind, Linearized, Manifold};

impl Manifold<6> for Se3 {
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
    fn retract(&self, step: &Vector6<f64>) -> Self {
        self.boxplus(step)
    }

    fn local(&self, other: &Self) -> Vector6<f64> {
        other.boxminus(self)
    }

    fn adjoint(&self) -> Matrix6<f64> {
        self.adjoint()
    }

    fn is_finite(&self) -> bool {
        self.translation.iter().chain(self.rotation.coords.iter()).all(|x| x.is_finite())
    }

    #[inline]
    fn error(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> Vector6<f64> {
        let gap = measured.inverse_mul(&from.inverse_mul(to));
        match kind {
            ErrorKind::G2o => stacked(&gap.translation, &imaginary(&gap.rotation).1),
            ErrorKind::Split => stacked(&gap.translation, &So3::log(&gap.rotation)),
            ErrorKind::Log => gap.log(),
        }
    }

    #[inline]
    fn linearize(kind: ErrorKind, measured: &Self, from: &Self, to: &Self) -> Linearized<6> {
        let from_from_to = from.inverse_mul(to);
        let gap = measured.inverse_mul(&from_from_to);
        // How a turn at the left (of `from`, carried behind the measurement) and at the right
        // change the rotation part of the error.
        let back = measured.rotation_matrix().transpose();
        let (rotation, by_left, by_right) = match kind {
            ErrorKind::G2o => {
                let (w, v) = imaginary(&gap.rotation);
                let (scalar, cross) = (Matrix3::from_diagonal_element(0.5 * w), So3::hat(&v) * 0.5);
                (v, cross - scalar, cross + scalar)
            }
            ErrorKind::Split => {
                let r = So3::log(&gap.rotation);
                (r, -So3::left_jacobian_inverse(&r), So3::right_jacobian_inverse(&r))
            }
            ErrorKind::Log => {
                let error = gap.log();
                let by_left = -Se3::left_jacobian_inverse(&error);
                return Linearized {
                    error,
                    by_from: by_left * measured.inverse().adjoint(),
                    by_to: Se3::right_jacobian_inverse(&error),
                };
            }
        };
        let seen = from_from_to.translation;
        let mut by_from = Matrix6::zeros();
        by_from.fixed_view_mut::<3, 3>(0, 0).copy_from(&-back);
        by_from.fixed_view_mut::<3, 3>(0, 3).copy_from(&(back * So3::hat(&seen)));
        by_from.fixed_view_mut::<3, 3>(3, 3).copy_from(&(by_left * back));
        let mut by_to = Matrix6::zeros();
        by_to.fixed_view_mut::<3, 3>(0, 0).copy_from(&gap.rotation_matrix());
        by_to.fixed_view_mut::<3, 3>(3, 3).copy_from(&by_right);
        Linearized { error: stacked(&gap.translation, &rotation), by_from, by_to }
    }

    fn curvature(
        kind: ErrorKind,
        linearized: &Linearized<6>,
        information: &Matrix6<f64>,
    ) -> Option<Curvature<6>> {
        if kind != ErrorKind::G2o {
            return None;
        }
        // A step (ρ, φ) moves the translation by R (ρ + ½ φ × ρ) to second order, and the vector
        // part v of the quaternion by its linear part less ⅛ |φ|² v.
        let weighted = information * linearized.error;
        let gradient = linearized.by_to.tr_mul(&weighted);
        let by_translation = So3::hat(&gradient.fixed_rows::<3>(0).into_owned()) * 0.5;
        let by_rotation = So3::hat(&gradient.fixed_rows::<3>(3).into_owned()) * 0.5;
        let bent = linearized.error.fixed_rows::<3>(3).dot(&weighted.fixed_rows::<3>(3));
        let mut along = Matrix6::zeros();
        along.fixed_view_mut::<3, 3>(0, 3).copy_from(&by_translation);
        along.fixed_view_mut::<3, 3>(3, 0).copy_from(&-by_translation);
        along.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(-0.25 * bent);
        // The commutator of two steps is (φ₁ × ρ₂ + ρ₁ × φ₂, φ₁ × φ₂).
        let mut commutator = Matrix6::zeros();
        commutator.fixed_view_mut::<3, 3>(0, 3).copy_from(&-by_translation);
        commutator.fixed_view_mut::<3, 3>(3, 0).copy_from(&-by_translation);
        commutator.fixed_view_mut::<3, 3>(3, 3).copy_from(&-by_rotation);
        Some(Curvature { along, commutator })
    }
}

/// Scalar and vector part of the quaternion of a rotation, of the two the one with `w ≥ 0`.
#[inline]
fn imaginary(rotation: &UnitQuaternion<f64>) -> (f64, Vector3<f64>) {
    let (w, v) = (rotation.w, rotation.imag());
    if w < 0.0 { (-w, -v) } else { (w, v) }
}

#[inline]
fn stacked(translation: &Vector3<f64>, rotation: &Vector3<f64>) -> Vector6<f64> {
    let (t, r) = (translation, rotation);
    Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z)
}
