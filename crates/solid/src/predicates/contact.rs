//! Where a segment meets a triangle, and whether a point lies on one; borders belong to both.

use super::{facing_axis, orient_dropping, orient3, sign};
use crate::Point3;

/// How a segment and a triangle meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentContact {
    /// They have no point in common.
    Apart,
    /// The segment meets the triangle's plane in one point, and that point is on the triangle.
    Pierces,
    /// The segment lies in the triangle's plane and meets it.
    Coplanar,
}

/// Whether the closed segment `p`, `q` meets the closed triangle `a`, `b`, `c`, which must not be
/// flat; exact.
pub fn segment_meets_triangle(p: &Point3, q: &Point3, triangle: [&Point3; 3]) -> SegmentContact {
    let [a, b, c] = triangle;
    let above_p = sign(orient3(a, b, c, p));
    let above_q = sign(orient3(a, b, c, q));
    if above_p * above_q > 0 {
        return SegmentContact::Apart;
    }
    if above_p == 0 && above_q == 0 {
        let meets = coplanar_segment_meets_triangle(p, q, triangle);
        return if meets { SegmentContact::Coplanar } else { SegmentContact::Apart };
    }
    // The line crosses the plane once; inside the triangle the three turns do not disagree.
    let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| sign(orient3(p, q, from, to)));
    let inside = turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0);
    if inside { SegmentContact::Pierces } else { SegmentContact::Apart }
}

fn coplanar_segment_meets_triangle(p: &Point3, q: &Point3, triangle: [&Point3; 3]) -> bool {
    let [a, b, c] = triangle;
    let Some(axis) = facing_axis(a, b, c) else { return false };
    projected_in_triangle(axis, p, triangle)
        || projected_in_triangle(axis, q, triangle)
        || [(a, b), (b, c), (c, a)].iter().any(|(from, to)| segments_meet(axis, p, q, from, to))
}

/// Whether `p`, in the plane of the triangle, lies in it, seen along `axis`.
fn projected_in_triangle(axis: usize, p: &Point3, [a, b, c]: [&Point3; 3]) -> bool {
    let turns = [(a, b), (b, c), (c, a)].map(|(s, t)| sign(orient_dropping(axis, s, t, p)));
    turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0)
}

/// Whether two coplanar closed segments meet, seen along `axis`.
fn segments_meet(axis: usize, p: &Point3, q: &Point3, r: &Point3, s: &Point3) -> bool {
    let side = |a: &Point3, b: &Point3, c: &Point3| sign(orient_dropping(axis, a, b, c));
    let (pr, ps) = (side(p, q, r), side(p, q, s));
    let (rp, rq) = (side(r, s, p), side(r, s, q));
    if pr * ps < 0 && rp * rq < 0 {
        return true;
    }
    let between = |a: &Point3, b: &Point3, c: &Point3| {
        (0..3).filter(|&i| i != axis).all(|i| a[i].min(b[i]) <= c[i] && c[i] <= a[i].max(b[i]))
    };
    (pr == 0 && between(p, q, r))
        || (ps == 0 && between(p, q, s))
        || (rp == 0 && between(r, s, p))
        || (rq == 0 && between(r, s, q))
}

/// Whether `p` lies on the closed triangle, which must not be flat; exact.
pub fn in_triangle(p: &Point3, triangle: [&Point3; 3]) -> bool {
    let [a, b, c] = triangle;
    orient3(a, b, c, p) == 0.0
        && facing_axis(a, b, c).is_some_and(|axis| projected_in_triangle(axis, p, triangle))
}

/// Whether `p` lies on the closed segment `a`, `b`; exact.
pub fn on_segment(p: &Point3, a: &Point3, b: &Point3) -> bool {
    (0..3).all(|i| a[i].min(b[i]) <= p[i] && p[i] <= a[i].max(b[i]))
        && (0..3).all(|axis| orient_dropping(axis, a, b, p) == 0.0)
}
