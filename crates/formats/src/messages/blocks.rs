//! What decoders of messages share: how they fail, and parts that are checked alike.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use pose::Se3;
use sensing::Scan;

/// Why the bytes of one message are no message of its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Malformed {
    /// Bytes from the start of the message.
    pub at: usize,
    /// What stands there.
    pub found: &'static str,
}

/// The most rays of a scan.
pub(crate) const MAX_RAYS: usize = 1 << 20;

/// The most transforms of one message.
pub(crate) const MAX_TRANSFORMS: usize = 1 << 16;

/// The most coefficients of a model of distortion.
pub(crate) const MAX_COEFFICIENTS: usize = 64;

/// A rotation from a quaternion of any length; `None` where it has no direction.
///
/// One of unit length, up to rounding, is kept as it is.
pub(crate) fn rotation(x: f64, y: f64, z: f64, w: f64) -> Option<UnitQuaternion<f64>> {
    let quaternion = Quaternion::new(w, x, y, z);
    let square = quaternion.norm_squared();
    if (square - 1.0).abs() < 1e-12 {
        return Some(UnitQuaternion::new_unchecked(quaternion));
    }
    let norm = quaternion.norm();
    (norm.is_finite() && norm > 1e-6).then(|| UnitQuaternion::new_unchecked(quaternion / norm))
}

/// A pose from the seven numbers of a message, checked.
pub(crate) fn pose(position: [f64; 3], xyzw: [f64; 4], at: usize) -> Result<Se3, Malformed> {
    if !position.iter().all(|x| x.is_finite()) {
        return Err(Malformed { at, found: "a position that is not finite" });
    }
    let [x, y, z, w] = xyzw;
    let rotation =
        rotation(x, y, z, w).ok_or(Malformed { at, found: "a quaternion without a direction" })?;
    Ok(Se3::new(Vector3::from(position), rotation))
}

/// A scan whose bearings run counter-clockwise, from one that may run the other way.
pub(crate) fn scan(
    first_rad: f64,
    step_rad: f64,
    mut ranges_m: Vec<f64>,
    range_max_m: f64,
    at: usize,
) -> Result<Scan, Malformed> {
    if !(first_rad.is_finite() && step_rad.is_finite()) {
        return Err(Malformed { at, found: "an angle that is not finite" });
    }
    if range_max_m.is_nan() || range_max_m <= 0.0 {
        return Err(Malformed { at, found: "a largest range that is not positive" });
    }
    if ranges_m.len() > 1 && step_rad == 0.0 {
        return Err(Malformed { at, found: "rays without an angle between them" });
    }
    if step_rad >= 0.0 {
        let step_rad = if step_rad > 0.0 { step_rad } else { 1.0 };
        return Ok(Scan::new(first_rad, step_rad, ranges_m, range_max_m));
    }
    let last_rad = first_rad + step_rad * ranges_m.len().saturating_sub(1) as f64;
    ranges_m.reverse();
    Ok(Scan::new(last_rad, -step_rad, ranges_m, range_max_m))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clockwise_scans_are_turned_round() {
        let turned = scan(1.0, -0.5, vec![1.0, 2.0, 3.0], 10.0, 0).expect("a scan");
        assert_eq!(turned, Scan::new(0.0, 0.5, vec![3.0, 2.0, 1.0], 10.0));
        assert!(scan(0.0, 0.0, vec![1.0, 2.0], 10.0, 4).is_err());
        assert_eq!(scan(0.0, 0.0, vec![1.0], 10.0, 4).expect("one ray").len(), 1);
        assert!(scan(0.0, f64::NAN, vec![1.0], 10.0, 4).is_err());
        assert!(scan(0.0, 1.0, vec![1.0], f64::NAN, 4).is_err());
    }

    #[test]
    fn quaternions_are_normalised_only_where_they_must_be() {
        let odd = rotation(0.0, 0.0, 0.1_f64.sin(), 0.1_f64.cos()).expect("a rotation");
        assert_eq!(odd.coords.z, 0.1_f64.sin());
        assert_eq!(rotation(0.0, 0.0, 0.0, 5.0), Some(UnitQuaternion::identity()));
        assert_eq!(rotation(0.0, 0.0, 0.0, 0.0), None);
        assert_eq!(rotation(f64::NAN, 0.0, 0.0, 1.0), None);
    }
}
