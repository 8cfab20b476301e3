//! Which of two directions comes first.

use std::cmp::Ordering;

use super::{cross, cross_sign};
use crate::Point2;

/// Compares the counter-clockwise angles, in `[0, 2 pi)`, from `first` to `a` and from `first` to
/// `b`; exact inside the envelope.
///
/// None of the three may be the origin: it has no bearing.
#[inline]
pub fn compare_bearing_from(first: &Point2, a: &Point2, b: &Point2) -> Ordering {
    let a_beyond = half_turn_or_more(first, a);
    let b_beyond = half_turn_or_more(first, b);
    a_beyond.cmp(&b_beyond).then_with(|| cross_sign(b, a))
}

/// Whether the counter-clockwise angle from `first` to `p` is at least half a turn.
#[inline]
pub(crate) fn half_turn_or_more(first: &Point2, p: &Point2) -> bool {
    let side = cross(first, p);
    side < 0.0 || (side == 0.0 && !same_direction(first, p))
}

/// Whether two points on one line through the origin lie on the same side of it.
///
/// They must be exactly collinear with the origin and neither may be the origin.
#[inline]
pub fn same_direction(a: &Point2, b: &Point2) -> bool {
    if a.x != 0.0 { (a.x > 0.0) == (b.x > 0.0) } else { (a.y > 0.0) == (b.y > 0.0) }
}

/// Sorts tagged points by bearing from the x axis, counter-clockwise in `[0, 2 pi)`; exact.
///
/// On one bearing the nearer point comes first, equal points keep their order, and points at the
/// origin, which have no bearing, come before all others.
pub fn sort_by_bearing<T>(points: &mut [(Point2, T)]) {
    let axis = Point2::new(1.0, 0.0);
    let zero = Point2::origin();
    points.sort_by(|(a, _), (b, _)| match (*a == zero, *b == zero) {
        (false, false) => compare_bearing_from(&axis, a, b).then_with(|| {
            let (nearer, farther) = (nearer_on_ray(a, b), nearer_on_ray(b, a));
            farther.cmp(&nearer)
        }),
        (a_is_zero, b_is_zero) => b_is_zero.cmp(&a_is_zero),
    });
}

/// Of two points exactly on one ray from the origin, whether the first is strictly nearer to it.
#[inline]
pub(crate) fn nearer_on_ray(p: &Point2, v: &Point2) -> bool {
    if v.x != 0.0 { p.x.abs() < v.x.abs() } else { p.y.abs() < v.y.abs() }
}
