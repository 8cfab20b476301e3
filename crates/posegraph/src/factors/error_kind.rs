//! How the discrepancy of a factor becomes a vector.

/// How the discrepancy `D = Z⁻¹ · X_from⁻¹ · X_to` of a factor becomes a vector: translation first,
/// then rotation.
///
/// A cost without its convention means nothing: on noisy graphs in space they differ by a factor of
/// up to four. In the plane [`G2o`](Self::G2o) and [`Split`](Self::Split) are the same. All weigh
/// with the information matrix as it stands in the graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorKind {
    /// Translation of `D`; angle in the plane, vector part of the quaternion with `w ≥ 0` in space
    /// (g2o). About half the angle, so information files of g2o hold four times the rotation
    /// information per radian.
    #[default]
    G2o,
    /// The logarithm of `D` on the group (GTSAM).
    Log,
    /// Translation of `D` and the logarithm of its rotation (the usual choice with Ceres).
    Split,
}
