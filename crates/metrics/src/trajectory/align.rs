//! Laying one trajectory onto another (Umeyama 1991).

use pose::Se3;
use pose::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// How an estimate may be moved before it is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alignment {
    /// Not at all: both are in one frame.
    None,
    /// So that the first poses coincide.
    Origin,
    /// Moved and turned so that the squared distances of positions are least.
    #[default]
    Rigid,
    /// As [`Rigid`](Self::Rigid), and scaled.
    Similarity,
}

/// A rigid motion and a scale: `p -> scale · (R p) + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Rotation, and translation after scaling: `reference_from_estimate`.
    pub motion: Se3,
    /// Scale; 1 for rigid alignments.
    pub scale: f64,
}

impl Similarity {
    /// What moves nothing.
    pub fn identity() -> Self {
        Self { motion: Se3::identity(), scale: 1.0 }
    }

    /// A pose of the estimate in the frame of the reference.
    pub fn apply(&self, pose: &Se3) -> Se3 {
        let translation = self.motion.rotation * (pose.translation * self.scale);
        let rotation = self.motion.rotation * pose.rotation;
        Se3::new(translation + self.motion.translation, rotation)
    }
}

/// The motion that lays `estimate` onto `reference`, pose by pose; the shorter one ends it.
///
/// Where all poses lie in the plane z = 0 the motion stays in that plane. For poses on a line the
/// turn around it is arbitrary, but always the same one. Without poses nothing moves.
pub fn align(reference: &[Se3], estimate: &[Se3], how: Alignment) -> Similarity {
    let pairs: Vec<Pair> =
        reference.iter().zip(estimate).map(|(r, e)| (r.translation, e.translation)).collect();
    let (Some(first), Some(start)) = (reference.first(), estimate.first()) else {
        return Similarity::identity();
    };
    match how {
        Alignment::None => Similarity::identity(),
        Alignment::Origin => {
            let motion = *first * start.inverse();
            Similarity { motion, scale: 1.0 }
        }
        Alignment::Rigid => umeyama(&pairs, false),
        Alignment::Similarity => umeyama(&pairs, true),
    }
}

/// Where a pose is in the reference and in the estimate.
type Pair = (Vector3<f64>, Vector3<f64>);

fn umeyama(pairs: &[Pair], scaled: bool) -> Similarity {
    let count = pairs.len() as f64;
    let sum = pairs.iter().fold((Vector3::zeros(), Vector3::zeros()), |(to, from), pair| {
        (to + pair.0, from + pair.1)
    });
    let (to, from) = (sum.0 / count, sum.1 / count);
    let mut covariance = Matrix3::zeros();
    let mut spread = 0.0;
    for (reference, estimate) in pairs {
        covariance += (reference - to) * (estimate - from).transpose();
        spread += (estimate - from).norm_squared();
    }
    let planar = pairs.iter().all(|(r, e)| r.z == 0.0 && e.z == 0.0);
    let rotation = if planar {
        let c = &covariance;
        let angle = (c[(1, 0)] - c[(0, 1)]).atan2(c[(0, 0)] + c[(1, 1)]);
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
    } else {
        nearest_rotation(&covariance)
    };
    let turned = rotation.to_rotation_matrix();
    let scale = if scaled && spread > 0.0 {
        (turned.matrix().transpose() * covariance).trace() / spread
    } else {
        1.0
    };
    let translation = to - rotation * from * scale;
    Similarity { motion: Se3::new(translation, rotation), scale }
}

/// The rotation `R` for which the trace of `R⊤ matrix` is largest.
fn nearest_rotation(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let svd = matrix.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return UnitQuaternion::identity() };
    let mut signs = Vector3::repeat(1.0);
    // Singular values descend: the last direction is the one that matters least.
    signs.z = (u.determinant() * v_t.determinant()).signum();
    let rotation = u * Matrix3::from_diagonal(&signs) * v_t;
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation))
}
