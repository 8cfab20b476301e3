//! Factors of space.

use pose::nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use pose::{Se3, So3};

use super::{Curvature, ErrorKind, Linearized, Manifold, NormalBlocks};

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

    /// By blocks of 3 × 3: `by_to` and `by_from` have no lower left one.
    #[inline]
    fn normal_blocks(linearized: &Linearized<6>, information: &Matrix6<f64>) -> NormalBlocks<6> {
        let Linearized { error, by_from, by_to } = linearized;
        let information = Blocks::of(information);
        let (from, to) = (Blocks::of(by_from), Blocks::of(by_to));
        let (weighted_from, weighted_to) =
            (information.times_upper(&from), information.times_upper(&to));
        let weighted_error = information.times(error);
        NormalBlocks {
            from_from: from.upper_transposed_times(&weighted_from),
            to_from: to.upper_transposed_times(&weighted_from),
            to_to: to.upper_transposed_times(&weighted_to),
            gradient_from: by_from.tr_mul(&weighted_error),
            gradient_to: by_to.tr_mul(&weighted_error),
        }
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

/// A 6 × 6 matrix as `[a b; c d]`.
#[derive(Clone, Copy)]
struct Blocks {
    a: Matrix3<f64>,
    b: Matrix3<f64>,
    c: Matrix3<f64>,
    d: Matrix3<f64>,
}

impl Blocks {
    #[inline]
    fn of(matrix: &Matrix6<f64>) -> Self {
        Self {
            a: matrix.fixed_view::<3, 3>(0, 0).into_owned(),
            b: matrix.fixed_view::<3, 3>(0, 3).into_owned(),
            c: matrix.fixed_view::<3, 3>(3, 0).into_owned(),
            d: matrix.fixed_view::<3, 3>(3, 3).into_owned(),
        }
    }

    /// The product with a matrix whose block `c` is 0.
    #[inline]
    fn times_upper(&self, upper: &Self) -> Self {
        Self {
            a: self.a * upper.a,
            b: self.a * upper.b + self.b * upper.d,
            c: self.c * upper.a,
            d: self.c * upper.b + self.d * upper.d,
        }
    }

    /// The product of the transpose of this matrix, whose block `c` is 0, with another.
    #[inline]
    fn upper_transposed_times(&self, other: &Self) -> Matrix6<f64> {
        let mut product = Matrix6::zeros();
        let (b, d) = (self.b.transpose(), self.d.transpose());
        let a = self.a.transpose();
        product.fixed_view_mut::<3, 3>(0, 0).copy_from(&(a * other.a));
        product.fixed_view_mut::<3, 3>(0, 3).copy_from(&(a * other.b));
        product.fixed_view_mut::<3, 3>(3, 0).copy_from(&(b * other.a + d * other.c));
        product.fixed_view_mut::<3, 3>(3, 3).copy_from(&(b * other.b + d * other.d));
        product
    }

    #[inline]
    fn times(&self, vector: &Vector6<f64>) -> Vector6<f64> {
        let top = vector.fixed_rows::<3>(0).into_owned();
        let bottom = vector.fixed_rows::<3>(3).into_owned();
        stacked(&(self.a * top + self.b * bottom), &(self.c * top + self.d * bottom))
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
