//! One segment against a ray, a moving disc, a point or another segment.

use crate::{Point2, Vector2};

/// How far beside a segment a ray still meets it, metres.
///
/// Each segment is longer by this at both ends, so that no ray slips through where two segments
/// meet, whatever the rounding.
pub(super) const LEAK_TOLERANCE_M: f64 = 1e-9;

/// The z component of the cross product.
#[inline]
pub(super) fn cross(a: &Vector2, b: &Vector2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Distance along the ray to the segment `a`-`b`, `None` where they do not meet.
///
/// Two segments that share an end see the same side of the ray for it, bit for bit, so at least
/// one of them is hit by a ray that separates their other ends.
#[inline]
pub(super) fn ray_hit(origin: &Point2, direction: &Vector2, a: &Point2, b: &Point2) -> Option<f64> {
    let to_a = a - origin;
    let to_b = b - origin;
    let side_a = cross(direction, &to_a);
    let side_b = cross(direction, &to_b);
    let eps = LEAK_TOLERANCE_M;
    if (side_a > eps && side_b > eps) || (side_a < -eps && side_b < -eps) {
        return None;
    }
    let along_a = direction.dot(&to_a);
    let along_b = direction.dot(&to_b);
    let along = if side_a.abs() <= eps && side_b.abs() <= eps {
        let (near, far) = if along_a < along_b { (along_a, along_b) } else { (along_b, along_a) };
        if near < 0.0 && far > 0.0 { 0.0 } else { near }
    } else {
        let share = (side_a / (side_a - side_b)).clamp(0.0, 1.0);
        along_a + share * (along_b - along_a)
    };
    (along >= -eps).then_some(along.max(0.0))
}

/// The point of the segment `a`-`b` nearest to `point`.
#[inline]
pub(super) fn nearest_point(point: &Point2, a: &Point2, b: &Point2) -> Point2 {
    let edge = b - a;
    let length_squared = edge.norm_squared();
    if length_squared == 0.0 {
        return *a;
    }
    let share = ((point - a).dot(&edge) / length_squared).clamp(0.0, 1.0);
    a + edge * share
}

/// Distance from a point to the segment `a`-`b`.
#[inline]
pub(super) fn point_distance(point: &Point2, a: &Point2, b: &Point2) -> f64 {
    (point - nearest_point(point, a, b)).norm()
}

/// Distance between the segments `a`-`b` and `c`-`d`, 0 where they meet.
pub(super) fn segment_distance(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> f64 {
    let ab = b - a;
    let cd = d - c;
    let (c_side, d_side) = (cross(&ab, &(c - a)), cross(&ab, &(d - a)));
    let (a_side, b_side) = (cross(&cd, &(a - c)), cross(&cd, &(b - c)));
    let split = |p: f64, q: f64| (p <= 0.0 && q >= 0.0) || (p >= 0.0 && q <= 0.0);
    let collinear = c_side == 0.0 && d_side == 0.0;
    if !collinear && split(c_side, d_side) && split(a_side, b_side) {
        return 0.0;
    }
    point_distance(a, c, d)
        .min(point_distance(b, c, d))
        .min(point_distance(c, a, b))
        .min(point_distance(d, a, b))
}

/// Distance that a disc can move along the ray until it touches the segment `a`-`b`.
///
/// A disc that touches it from the start is stopped at 0 when it moves nearer, and free when it
/// does not: the distance to a segment is convex along a line.
pub(super) fn disc_hit(
    origin: &Point2,
    direction: &Vector2,
    radius_m: f64,
    a: &Point2,
    b: &Point2,
) -> Option<f64> {
    if radius_m <= 0.0 {
        return ray_hit(origin, direction, a, b);
    }
    let away = origin - nearest_point(origin, a, b);
    if away.norm_squared() <= radius_m * radius_m {
        return (away.dot(direction) < 0.0).then_some(0.0);
    }
    let edge = b - a;
    let length = edge.norm();
    let mut nearest: Option<f64> = None;
    let mut keep = |along: f64| {
        if along >= 0.0 && nearest.is_none_or(|best| along < best) {
            nearest = Some(along);
        }
    };
    if length > 0.0 {
        let normal = Vector2::new(-edge.y, edge.x) * (radius_m / length);
        for side in [normal, -normal] {
            if let Some(along) = ray_hit(origin, direction, &(a + side), &(b + side)) {
                keep(along);
            }
        }
    }
    for end in [a, b] {
        if let Some(along) = circle_hit(origin, direction, radius_m, end) {
            keep(along);
        }
    }
    nearest
}

/// Distance along the ray to where it enters a circle, from outside.
fn circle_hit(origin: &Point2, direction: &Vector2, radius_m: f64, centre: &Point2) -> Option<f64> {
    let to_centre = centre - origin;
    let along = to_centre.dot(direction);
    let beside = cross(direction, &to_centre);
    let half_chord_squared = radius_m * radius_m - beside * beside;
    (half_chord_squared >= 0.0).then(|| along - half_chord_squared.sqrt())
}
