//! SE(2): the rigid motions of the plane.

use std::ops::Mul;

use nalgebra::{Matrix3, Point2, UnitComplex, Vector2, Vector3};

/// A rigid motion of the plane, named `target_from_source`: it maps coordinates in the
/// source frame to coordinates in the target frame.
///
/// Tangent order is `[x_m, y_m, theta_rad]`, translation first; perturbations act on the right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Se2 {
    /// Rotation part.
    pub rotation: UnitComplex<f64>,
    /// Origin of the source frame in the target frame, metres.
    pub translation: Vector2<f64>,
}

impl Se2 {
    /// The motion that moves nothing.
    pub fn identity() -> Self {
        Self { rotation: UnitComplex::identity(), translation: Vector2::zeros() }
    }

    /// From a translation in metres and an angle in radians.
    pub fn new(x_m: f64, y_m: f64, theta_rad: f64) -> Self {
        Self { rotation: UnitComplex::new(theta_rad), translation: Vector2::new(x_m, y_m) }
    }

    /// A turn in place.
    pub fn from_angle(theta_rad: f64) -> Self {
        Self::new(0.0, 0.0, theta_rad)
    }

    /// The rotation angle in (-π, π].
    pub fn angle(&self) -> f64 {
        self.rotation.angle()
    }

    /// The motion back: `source_from_target`.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// `self⁻¹ · other` without building the inverse.
    pub fn inverse_mul(&self, other: &Self) -> Self {
        let back = self.rotation.inverse();
        Self {
            rotation: back * other.rotation,
            translation: back * (other.translation - self.translation),
        }
    }

    /// Length of the translation, metres.
    pub fn distance(&self) -> f64 {
        self.translation.norm()
    }

    /// Maps a point of the source frame into the target frame.
    #[inline]
    pub fn transform(&self, point: &Point2<f64>) -> Point2<f64> {
        Point2::from(self.rotation * point.coords + self.translation)
    }

    /// Maps a point of the target frame back into the source frame.
    #[inline]
    pub fn inverse_transform(&self, point: &Point2<f64>) -> Point2<f64> {
        Point2::from(self.rotation.inverse() * (point.coords - self.translation))
    }
}

impl Default for Se2 {
    fn default() -> Self {
        Self::identity()
    }
}

impl Mul for Se2 {
    type Output = Se2;
    #[inline]
    fn mul(self, rhs: Se2) -> Se2 {
        let mut rotation = self.rotation * rhs.rotation;
        // Long chains of products would leave the unit circle by rounding.
        rotation.renormalize_fast();
        Se2 { rotation, translation: self.rotation * rhs.translation + self.translation }
    }
}

/// The same direction as an angle in (-π, π]; exact for the `f64` nearest to a full turn.
pub fn wrap_angle(angle_rad: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    // The remainder and both differences are free of rounding.
    let rest = angle_rad % TAU;
    if rest > PI {
        rest - TAU
    } else if rest <= -PI {
        rest + TAU
    } else {
        rest
    }
}

/// The 3 × 3 homogeneous matrix of a motion.
impl From<Se2> for Matrix3<f64> {
    fn from(motion: Se2) -> Self {
        motion.rotation.to_homogeneous()
            + Matrix3::from_columns(&[
                Vector3::zeros(),
                Vector3::zeros(),
                Vector3::new(motion.translation.x, motion.translation.y, 0.0),
            ])
    }
}
