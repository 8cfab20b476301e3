//! Numbers that read back as the same bits.

use nalgebra::UnitComplex;
use pose::Se2;

/// Appends the shortest decimal that reads back as the same number.
pub(crate) fn push_number(out: &mut Vec<u8>, value: f64) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value);
    out.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

/// An angle whose sine and cosine are those of the rotation, bit for bit, where there is one.
///
/// For a rotation that was read from an angle there is: rounding moves the arc tangent away from it
/// by a few units in the last place at most. Other rotations get the arc tangent itself, within an
/// ulp of the truth.
pub(super) fn angle_of(pose: &Se2) -> f64 {
    const REACH: usize = 4;
    let is_it = |angle: f64| UnitComplex::new(angle) == pose.rotation;
    let angle = pose.angle();
    if is_it(angle) {
        return angle;
    }
    let (mut up, mut down) = (angle, angle);
    for _ in 0..REACH {
        (up, down) = (up.next_up(), down.next_down());
        for near in [up, down] {
            if is_it(near) && near.abs() <= std::f64::consts::PI {
                return near;
            }
        }
    }
    angle
}
