//! Whether two triangles have more in common than their common corners and edges; exact.
//!
//! What two triangles have in common is convex, and its corners lie where an edge of one meets the
//! other. With `k` common corners:
//!
//! - `k = 3`: the same triangle twice.
//! - `k = 2`: beyond the common edge only if they lie in one plane on the same side of it.
//! - `k = 1`: beyond the common corner only if the edge opposite to it, of one, meets the other.
//! - `k = 0`: if any edge of one meets the other.

use super::Contact;
use crate::Point3;
use crate::predicates::{
    SegmentContact, facing_axis, orient_dropping, orient3, segment_meets_triangle, sign,
};

type Triangle<'a> = [&'a Point3; 3];

/// How two triangles that are not flat meet beyond common corners and edges, and near where.
/// `*_places` name the corners' places: equal numbers, equal places.
pub(crate) fn meet(
    a: Triangle<'_>,
    a_places: [u32; 3],
    b: Triangle<'_>,
    b_places: [u32; 3],
) -> Option<(Contact, Point3)> {
    let common = |i: &usize| b_places.contains(&a_places[*i]);
    let count = (0..3).filter(common).count();
    match count {
        3 => Some((Contact::Overlap, middle(a))),
        2 => across_edge(a, a_places, b, b_places),
        1 => {
            let i = (0..3).find(common)?;
            let j = b_places.iter().position(|&place| place == a_places[i])?;
            let (opposite_a, opposite_b) = (opposite(a, i), opposite(b, j));
            let corner = a[i];
            if fan_out(corner, opposite_a, opposite_b)
                || beside(a, opposite_b)
                || beside(b, opposite_a)
            {
                return None;
            }
            let met = [(opposite_a, b), (opposite_b, a)];
            strongest(met.into_iter(), a, b)
        }
        _ => {
            if shadows_apart(a, b) || apart(a, b) {
                return None;
            }
            edges_meet(a, b)
        }
    }
}

/// The contact of two triangles without common corners.
fn edges_meet(a: Triangle<'_>, b: Triangle<'_>) -> Option<(Contact, Point3)> {
    let edges_a = (0..3).map(|i| (opposite(a, i), b));
    let edges_b = (0..3).map(|j| (opposite(b, j), a));
    strongest(edges_a.chain(edges_b), a, b)
}

/// Whether an edge of one has the other behind it by more than rounding, seen along the axis that `a` faces
/// most. Cheap, and says nothing where it fails: a wall that was seen from many places is thousands of long
/// triangles almost in one plane, whose boxes all touch, and needs exact numbers for few of them.
fn shadows_apart(a: Triangle<'_>, b: Triangle<'_>) -> bool {
    let axis = (a[1] - a[0]).cross(&(a[2] - a[0])).iamax();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let side = |from: &Point3, to: &Point3, p: &Point3| {
        let left = (from[u] - p[u]) * (to[v] - p[v]);
        let right = (from[v] - p[v]) * (to[u] - p[u]);
        // Off by less than 3.4e-16 of the sum (Shewchuk 1997, the first bound of the plane).
        let turn = left - right;
        if turn.abs() > 4e-16 * (left.abs() + right.abs()) { turn } else { f64::NAN }
    };
    let is_behind = |b: Triangle<'_>, a: Triangle<'_>| {
        (0..3).any(|i| {
            let [from, to] = opposite(a, i);
            let inner = side(from, to, a[i]);
            b.iter().all(|p| side(from, to, p) * inner < 0.0)
        })
    };
    is_behind(b, a) || is_behind(a, b)
}

fn middle([a, b, c]: Triangle<'_>) -> Point3 {
    Point3::from((a.coords + b.coords + c.coords) / 3.0)
}

/// The edge opposite to a corner.
fn opposite<'a>(triangle: Triangle<'a>, corner: usize) -> [&'a Point3; 2] {
    [triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]]
}

/// On which sides of the plane of `a` the corners of `b` lie.
fn sides(a: Triangle<'_>, b: Triangle<'_>) -> [i8; 3] {
    b.map(|p| sign(orient3(a[0], a[1], a[2], p)))
}

/// Whether the plane of one leaves the other wholly on one side.
fn apart(a: Triangle<'_>, b: Triangle<'_>) -> bool {
    let strictly = |s: [i8; 3]| s == [1; 3] || s == [-1; 3];
    strictly(sides(a, b)) || strictly(sides(b, a))
}

/// Whether an edge lies strictly on one side of a triangle's plane. What it and a corner in that plane
/// span has nothing but the corner in common with the triangle.
fn beside([a, b, c]: Triangle<'_>, edge: [&Point3; 2]) -> bool {
    let [from, to] = edge.map(|p| sign(orient3(a, b, c, p)));
    from != 0 && from == to
}

/// Whether the plane through a corner, halfway between two edges as seen from there, has one on each
/// side by more than rounding. Cheap, and says nothing where it fails: so neighbours in a fan of many
/// triangles that lie almost in one plane need no exact numbers.
fn fan_out(corner: &Point3, a: [&Point3; 2], b: [&Point3; 2]) -> bool {
    let towards = |edge: [&Point3; 2]| {
        let middle = nalgebra::center(edge[0], edge[1]) - corner;
        middle / middle.norm()
    };
    let across = towards(a) - towards(b);
    // Differences and products of six numbers are off by less than 16 units in the last place.
    let reach = |p: &Point3| p.coords.amax() + corner.coords.amax();
    let above = |p: &Point3| {
        let height = across.dot(&(p - corner));
        if height.abs() > 1e-14 * across.lp_norm(1) * reach(p) { height } else { f64::NAN }
    };
    a.iter().all(|p| above(p) > 0.0) && b.iter().all(|p| above(p) < 0.0)
}

fn across_edge(
    a: Triangle<'_>,
    a_places: [u32; 3],
    b: Triangle<'_>,
    b_places: [u32; 3],
) -> Option<(Contact, Point3)> {
    let i = (0..3).find(|&i| !b_places.contains(&a_places[i]))?;
    let j = (0..3).find(|&j| !a_places.contains(&b_places[j]))?;
    if orient3(a[0], a[1], a[2], b[j]) != 0.0 {
        return None;
    }
    let axis = facing_axis(a[0], a[1], a[2])?;
    let [from, to] = opposite(a, i);
    let side = |p: &Point3| sign(orient_dropping(axis, from, to, p));
    let overlaps = side(a[i]) * side(b[j]) > 0;
    overlaps.then(|| {
        let edge = nalgebra::center(from, to);
        (Contact::Overlap, nalgebra::center(&edge, &nalgebra::center(a[i], b[j])))
    })
}

/// Of the contacts of edges with triangles the one that says most, and near where it is.
fn strongest<'a>(
    tests: impl Iterator<Item = ([&'a Point3; 2], Triangle<'a>)>,
    a: Triangle<'_>,
    b: Triangle<'_>,
) -> Option<(Contact, Point3)> {
    let mut points: Vec<Point3> = Vec::new();
    for ([p, q], triangle) in tests {
        match segment_meets_triangle(p, q, triangle) {
            SegmentContact::Apart => {}
            SegmentContact::Pierces => points.push(pierced(p, q, triangle)),
            SegmentContact::Coplanar => points.push(nalgebra::center(p, q)),
        }
    }
    if points.is_empty() {
        return None;
    }
    let sum = points.iter().fold(nalgebra::Vector3::zeros(), |sum, p| sum + p.coords);
    let at = Point3::from(sum / points.len() as f64);
    let coplanar = sides(a, b) == [0; 3];
    let passes = |s: [i8; 3]| s.contains(&1) && s.contains(&-1);
    let contact = if coplanar && share_area(a, b) {
        Contact::Overlap
    } else if passes(sides(a, b)) && passes(sides(b, a)) {
        Contact::Cross
    } else {
        Contact::Touch
    };
    Some((contact, at))
}

/// Whether two coplanar triangles have an area in common: no edge of one has the other behind it.
fn share_area(a: Triangle<'_>, b: Triangle<'_>) -> bool {
    let Some(axis) = facing_axis(a[0], a[1], a[2]) else { return false };
    let separated_by_edge_of = |a: Triangle<'_>, b: Triangle<'_>| {
        (0..3).any(|i| {
            let [from, to] = opposite(a, i);
            let side = |p: &Point3| sign(orient_dropping(axis, from, to, p));
            b.iter().all(|p| side(p) * side(a[i]) <= 0)
        })
    };
    !separated_by_edge_of(a, b) && !separated_by_edge_of(b, a)
}

/// Where the segment goes through the triangle's plane, to rounding.
fn pierced(p: &Point3, q: &Point3, [a, b, c]: Triangle<'_>) -> Point3 {
    let normal = (b - a).cross(&(c - a));
    let (above_p, above_q) = (normal.dot(&(p - a)), normal.dot(&(q - a)));
    let step = above_p - above_q;
    let share = if step == 0.0 { 0.5 } else { (above_p / step).clamp(0.0, 1.0) };
    p + (q - p) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of whole numbers, a half of them in one plane, against the exact look at their edges.
    #[test]
    fn triangles_with_shadows_apart_do_not_meet() {
        let mut seed = 5_u32;
        let mut next = move |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from((seed >> 8) % n)
        };
        let (mut told, mut missed) = (0, 0);
        for round in 0..20_000 {
            let height = if round % 2 == 0 { 1 } else { 4 };
            let points: [Point3; 6] =
                std::array::from_fn(|_| Point3::new(next(6), next(6), 0.1 * next(height)));
            let [a, b] =
                [[&points[0], &points[1], &points[2]], [&points[3], &points[4], &points[5]]];
            if [a, b].iter().any(|t| facing_axis(t[0], t[1], t[2]).is_none()) {
                continue;
            }
            let meeting = edges_meet(a, b);
            if shadows_apart(a, b) {
                told += 1;
                assert_eq!(meeting, None, "{points:?}");
            } else {
                missed += usize::from(meeting.is_none());
            }
        }
        assert!(told > 2000 && missed > 0, "{told} {missed}");
    }
}
