//! Distances between points and segments, and what of a segment lies near another.
//!
//! These measure; they decide nothing about topology.

use super::Interval;
use crate::predicates::orient;
use crate::{Point2, Vector2};

/// The parameter of the point on `a` to `b` nearest to `p`; 0 for a segment of no length.
pub fn nearest_parameter(p: &Point2, a: &Point2, b: &Point2) -> f64 {
    let along = b - a;
    let length_squared = along.norm_squared();
    if length_squared > 0.0 { ((p - a).dot(&along) / length_squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The distance from `p` to the segment `a` to `b`, metres.
pub fn point_segment_distance(p: &Point2, a: &Point2, b: &Point2) -> f64 {
    let t = nearest_parameter(p, a, b);
    (p - (a + (b - a) * t)).norm()
}

/// The distance between the segments `a` to `b` and `c` to `d`, metres; 0 exactly if they share a
/// point.
pub fn segment_segment_distance(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> f64 {
    if segments_meet(a, b, c, d) {
        return 0.0;
    }
    point_segment_distance(a, c, d)
        .min(point_segment_distance(b, c, d))
        .min(point_segment_distance(c, a, b))
        .min(point_segment_distance(d, a, b))
}

/// A lower bound of the distance between the segments `a` to `b` and `c` to `d`, metres, at a
/// fraction of its cost: how far their boxes are apart along one axis; 0 or less if not at all.
pub fn box_gap(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> f64 {
    let gap = |x: f64, y: f64, z: f64, w: f64| (z.min(w) - x.max(y)).max(x.min(y) - z.max(w));
    gap(a.x, b.x, c.x, d.x).max(gap(a.y, b.y, c.y, d.y))
}

/// Whether two closed segments share a point; exact inside the envelope of the predicates.
pub fn segments_meet(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> bool {
    let apart = |x: f64, y: f64, z: f64, w: f64| x.max(y) < z.min(w) || z.max(w) < x.min(y);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let same_side = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    !same_side(orient(a, b, c), orient(a, b, d)) && !same_side(orient(c, d, a), orient(c, d, b))
}

/// The parameters along `a` to `b` that lie within `radius` of the segment `c` to `d`.
///
/// The points within a radius of a segment are convex, hence one stretch. A segment of no length
/// is whole or absent. Rounded; a segment that only grazes may be absent or a stretch of no length.
pub fn near_segment(
    a: &Point2,
    b: &Point2,
    c: &Point2,
    d: &Point2,
    radius: f64,
) -> Option<Interval> {
    if a == b {
        return (point_segment_distance(a, c, d) <= radius).then_some(Interval::WHOLE);
    }
    // A capsule is two discs and the slab between them.
    [in_disc(a, b, c, radius), in_disc(a, b, d, radius), in_slab(a, b, c, d, radius)]
        .into_iter()
        .flatten()
        .reduce(|x, y| Interval::new(x.from.min(y.from), x.to.max(y.to)))
}

/// The parameters along `a` to `b` within `radius` of `centre`.
fn in_disc(a: &Point2, b: &Point2, centre: &Point2, radius: f64) -> Option<Interval> {
    let along = b - a;
    let length_squared = along.norm_squared();
    let middle = (centre - a).dot(&along) / length_squared;
    let offset = (centre - (a + along * middle)).norm();
    if offset > radius || offset.is_nan() {
        return None;
    }
    let half = ((radius - offset) * (radius + offset) / length_squared).sqrt();
    cut(middle - half, middle + half)
}

/// The parameters along `a` to `b` in the rectangle with `c` to `d` as its middle line.
fn in_slab(a: &Point2, b: &Point2, c: &Point2, d: &Point2, radius: f64) -> Option<Interval> {
    let axis = d - c;
    let length = axis.norm();
    if length == 0.0 {
        return None;
    }
    let unit = axis / length;
    let normal = Vector2::new(-unit.y, unit.x);
    let (from_a, along) = (a - c, b - a);
    let lengthwise = between(from_a.dot(&unit), along.dot(&unit), 0.0, length)?;
    let sideways = between(from_a.dot(&normal), along.dot(&normal), -radius, radius)?;
    cut(lengthwise.from.max(sideways.from), lengthwise.to.min(sideways.to))
}

/// Where the linear function `at + slope t` lies between two bounds.
fn between(at: f64, slope: f64, low: f64, high: f64) -> Option<Interval> {
    if slope == 0.0 {
        let all = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        return (low <= at && at <= high).then_some(all);
    }
    let (t, u) = ((low - at) / slope, (high - at) / slope);
    Some(Interval::new(t.min(u), t.max(u)))
}

/// The interval cut to the segment.
fn cut(from: f64, to: f64) -> Option<Interval> {
    let (from, to) = (from.max(0.0), to.min(1.0));
    (from <= to).then_some(Interval::new(from, to))
}
