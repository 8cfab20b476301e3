//! Errors of poses and of motions.

use pose::Se3;

/// What many errors come to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Number of errors.
    pub count: usize,
    /// Root of the mean square.
    pub rmse: f64,
    /// Mean.
    pub mean: f64,
    /// Median; the mean of the two in the middle of an even number.
    pub median: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

impl Statistics {
    /// Of any errors; all 0 where there are none.
    pub fn of(errors: &[f64]) -> Self {
        let mut sorted = errors.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let count = sorted.len();
        let (Some(&min), Some(&max)) = (sorted.first(), sorted.last()) else {
            return Self::default();
        };
        let mean = |of: fn(f64) -> f64| errors.iter().map(|&e| of(e)).sum::<f64>() / count as f64;
        let median = f64::midpoint(sorted[(count - 1) / 2], sorted[count / 2]);
        Self { count, rmse: mean(|e| e * e).sqrt(), mean: mean(|e| e), median, min, max }
    }
}

/// Errors in translation and in rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseErrors {
    /// Distances, metres.
    pub translation_m: Statistics,
    /// Angles, radians.
    pub rotation_rad: Statistics,
}

impl PoseErrors {
    fn of(errors: impl Iterator<Item = Se3>) -> Self {
        let (distances, angles): (Vec<f64>, Vec<f64>) =
            errors.map(|error| (error.distance(), error.rotation.angle())).unzip();
        Self { translation_m: Statistics::of(&distances), rotation_rad: Statistics::of(&angles) }
    }
}

/// The absolute error of each pose, `reference⁻¹ · estimate`; the estimate must be aligned.
pub fn absolute_errors(reference: &[Se3], estimate: &[Se3]) -> PoseErrors {
    PoseErrors::of(reference.iter().zip(estimate).map(|(r, e)| r.inverse_mul(e)))
}

/// The relative error of each motion over `delta` poses, from every pose that has one:
/// `(Q_i⁻¹ Q_{i+δ})⁻¹ (P_i⁻¹ P_{i+δ})` for reference `Q` and estimate `P`.
///
/// The same for every rigid alignment. A `delta` of 0 counts as 1.
pub fn relative_errors(reference: &[Se3], estimate: &[Se3], delta: usize) -> PoseErrors {
    let delta = delta.max(1);
    let count = reference.len().min(estimate.len());
    let errors = (delta..count).map(|end| {
        let start = end - delta;
        let truly = reference[start].inverse_mul(&reference[end]);
        truly.inverse_mul(&estimate[start].inverse_mul(&estimate[end]))
    });
    PoseErrors::of(errors)
}
