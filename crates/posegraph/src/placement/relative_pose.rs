//! What placement asks of poses.

use std::fmt::Debug;
use std::ops::Mul;

use pose::{Se2, Se3};

/// A rigid motion that edges measure and placement chains: [`Se2`] in the plane, [`Se3`] in space.
///
/// Named `target_from_source`; `a_from_b * b_from_c` is `a_from_c`.
pub trait RelativePose:
    Copy + PartialEq + Debug + Mul<Output = Self> + Send + Sync + 'static
{
    /// The motion that moves nothing.
    fn identity() -> Self;

    /// The motion back: `source_from_target`.
    fn inverse(&self) -> Self;

    /// Length of the translation, metres.
    fn distance(&self) -> f64;

    /// Whether every number in it is finite, and so is its length.
    fn is_finite(&self) -> bool;
}

impl RelativePose for Se2 {
    #[inline]
    fn identity() -> Self {
        Se2::identity()
    }

    #[inline]
    fn inverse(&self) -> Self {
        Se2::inverse(self)
    }

    #[inline]
    fn distance(&self) -> f64 {
        Se2::distance(self)
    }

    fn is_finite(&self) -> bool {
        Se2::distance(self).is_finite() && self.angle().is_finite()
    }
}

impl RelativePose for Se3 {
    #[inline]
    fn identity() -> Self {
        Se3::identity()
    }

    #[inline]
    fn inverse(&self) -> Self {
        Se3::inverse(self)
    }

    #[inline]
    fn distance(&self) -> f64 {
        Se3::distance(self)
    }

    fn is_finite(&self) -> bool {
        Se3::distance(self).is_finite() && self.rotation.coords.iter().all(|x| x.is_finite())
    }
}
