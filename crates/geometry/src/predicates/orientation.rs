//! On which side of a line a point lies.

use std::cmp::Ordering;

use robust::Coord;

use crate::Point2;

/// The largest magnitude of a coordinate for which the predicates are exact.
pub const LARGEST: f64 = 1e100;
/// The smallest magnitude, zero apart, of a coordinate for which the predicates are exact.
pub const SMALLEST: f64 = 1e-100;

/// Shewchuk's bound `(3 + 16 u) u` for the plain determinant, `u = 2^-53`.
const FILTER: f64 = 3.330_669_073_875_471_6e-16;

/// Whether both coordinates lie where the predicates are exact; false for NaN and infinities.
#[inline]
pub fn in_envelope(p: &Point2) -> bool {
    let fits = |c: f64| c == 0.0 || (SMALLEST..=LARGEST).contains(&c.abs());
    fits(p.x) && fits(p.y)
}

/// Twice the signed area of the triangle `a`, `b`, `c`: positive when they turn counter-clockwise.
///
/// The sign is exact inside the envelope. The value is off by at most a few units in the last
/// place of the two products that it subtracts; [`orient_precise`](super::orient_precise) measures
/// better. A few nanoseconds unless the points are nearly collinear.
#[inline]
pub fn orient(a: &Point2, b: &Point2, c: &Point2) -> f64 {
    let left = (a.x - c.x) * (b.y - c.y);
    let right = (a.y - c.y) * (b.x - c.x);
    let det = left - right;
    if det.abs() > FILTER * (left.abs() + right.abs()) { det } else { adaptive(a, b, c) }
}

/// The cross product `a x b` of two points seen as vectors: positive when `b` is counter-clockwise
/// of `a` by less than half a turn.
///
/// Equals `orient(origin, a, b)`; sign and value as there.
#[inline]
pub fn cross(a: &Point2, b: &Point2) -> f64 {
    let left = a.x * b.y;
    let right = a.y * b.x;
    let det = left - right;
    if det.abs() > FILTER * (left.abs() + right.abs()) {
        det
    } else {
        adaptive(a, b, &Point2::origin())
    }
}

/// The exact sign of `a x b`: `Greater` when `b` is counter-clockwise of `a`.
#[inline]
pub fn cross_sign(a: &Point2, b: &Point2) -> Ordering {
    sign(cross(a, b))
}

/// The sign of a determinant as an ordering against zero; NaN counts as zero.
#[inline]
pub fn sign(determinant: f64) -> Ordering {
    determinant.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

#[cold]
#[inline(never)]
fn adaptive(a: &Point2, b: &Point2, c: &Point2) -> f64 {
    let coord = |p: &Point2| Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}
