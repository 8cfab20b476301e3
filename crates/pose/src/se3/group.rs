//! SE(3): the rigid motions of space.

use std::ops::Mul;

use nalgebra::{Matrix3, Matrix4, Point3, Quaternion, UnitQuaternion, Vector3};

/// A rigid motion of space, named `target_from_source`: it maps coordinates in the source frame to
/// coordinates in the target frame.
///
/// Tangent order is `[x_m, y_m, z_m, rx_rad, ry_rad, rz_rad]`, translation first; perturbations act
/// on the right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Se3 {
    /// Rotation part.
    pub rotation: UnitQuaternion<f64>,
    /// Origin of the source frame in the target frame, metres.
    pub translation: Vector3<f64>,
}

impl Se3 {
    /// The motion that moves nothing.
    pub fn identity() -> Self {
        Self { rotation: UnitQuaternion::identity(), translation: Vector3::zeros() }
    }

    /// From a translation in metres and a rotation.
    pub fn new(translation: Vector3<f64>, rotation: UnitQuaternion<f64>) -> Self {
        Self { rotation, translation }
    }

    /// The motion back: `source_from_target`.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// `self⁻¹ · other` without building the inverse.
    #[inline]
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

    /// The rotation as a 3 × 3 matrix.
    #[inline]
    pub fn rotation_matrix(&self) -> Matrix3<f64> {
        self.rotation.to_rotation_matrix().into_inner()
    }

    /// Maps a point of the source frame into the target frame.
    #[inline]
    pub fn transform(&self, point: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.rotation * point.coords + self.translation)
    }

    /// Maps a point of the target frame back into the source frame.
    #[inline]
    pub fn inverse_transform(&self, point: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.rotation.inverse() * (point.coords - self.translation))
    }
}

impl Default for Se3 {
    fn default() -> Self {
        Self::identity()
    }
}

impl Mul for Se3 {
    type Output = Se3;
    #[inline]
    fn mul(self, rhs: Se3) -> Se3 {
        Se3 {
            rotation: renormalized(self.rotation * rhs.rotation),
            translation: self.rotation * rhs.translation + self.translation,
        }
    }
}

/// The unit quaternion next to one that rounding has led a little off the sphere.
#[inline]
pub(super) fn renormalized(rotation: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let q: Quaternion<f64> = rotation.into_inner();
    // One Newton step towards the inverse root: exact to rounding this near to the sphere.
    UnitQuaternion::new_unchecked(q * (1.5 - 0.5 * q.norm_squared()))
}

/// The 4 × 4 homogeneous matrix of a motion.
impl From<Se3> for Matrix4<f64> {
    fn from(motion: Se3) -> Self {
        let mut matrix = motion.rotation.to_homogeneous();
        matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&motion.translation);
        matrix
    }
}
