//! One triangle against a ray, a moving ball, a point or a segment.

use crate::{Point3, Vector3};

/// Three corners, metres.
pub(super) type Triangle = [Point3; 3];

/// How far beside a triangle a ray still meets it, metres: no ray slips through where two meet.
pub(super) const SPACE_LEAK_M: f64 = 1e-9;

/// Distance along the ray to the triangle, `None` where they do not meet.
///
/// Two triangles that share an edge see the same volume for it with the opposite sign, bit for bit, so
/// that at least one of them is hit by a ray that passes the edge. A ray in the plane of the triangle
/// does not meet it: it meets its neighbours.
#[inline]
pub(super) fn ray_hit(origin: &Point3, direction: &Vector3, corners: &Triangle) -> Option<f64> {
    let [a, b, c] = [corners[0] - origin, corners[1] - origin, corners[2] - origin];
    let volumes =
        [direction.dot(&c.cross(&b)), direction.dot(&a.cross(&c)), direction.dot(&b.cross(&a))];
    let sides = [(c - b).norm(), (a - c).norm(), (b - a).norm()];
    let least = (0..3).all(|i| volumes[i] >= -SPACE_LEAK_M * sides[i]);
    let most = (0..3).all(|i| volumes[i] <= SPACE_LEAK_M * sides[i]);
    if !(least || most) {
        return None;
    }
    let sum = volumes[0] + volumes[1] + volumes[2];
    if sum == 0.0 {
        return None;
    }
    let along = [a.dot(direction), b.dot(direction), c.dot(direction)];
    let weighted = volumes[0] * along[0] + volumes[1] * along[1] + volumes[2] * along[2];
    let near = along[0].min(along[1]).min(along[2]);
    let far = along[0].max(along[1]).max(along[2]);
    let hit = (weighted / sum).clamp(near, far);
    (hit >= -SPACE_LEAK_M).then_some(hit.max(0.0))
}

/// The point of the triangle nearest to `point`.
pub(super) fn nearest_point(point: &Point3, corners: &Triangle) -> Point3 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let squared = normal.norm_squared();
    if squared > 0.0 {
        let inside = |p: &Point3, q: &Point3| (q - p).cross(&(point - p)).dot(&normal) >= 0.0;
        if inside(a, b) && inside(b, c) && inside(c, a) {
            return point - normal * ((point - a).dot(&normal) / squared);
        }
    }
    let mut best = nearest_on_segment(point, a, b);
    for (p, q) in [(b, c), (c, a)] {
        let other = nearest_on_segment(point, p, q);
        if (point - other).norm_squared() < (point - best).norm_squared() {
            best = other;
        }
    }
    best
}

fn nearest_on_segment(point: &Point3, a: &Point3, b: &Point3) -> Point3 {
    let edge = b - a;
    let squared = edge.norm_squared();
    if squared == 0.0 {
        return *a;
    }
    a + edge * ((point - a).dot(&edge) / squared).clamp(0.0, 1.0)
}

/// Distance between the segments `a`-`b` and `c`-`d`, 0 where they meet.
fn segments_distance(a: &Point3, b: &Point3, c: &Point3, d: &Point3) -> f64 {
    let (ab, cd, ca) = (b - a, d - c, a - c);
    let (aa, ee, f) = (ab.norm_squared(), cd.norm_squared(), cd.dot(&ca));
    let mut best = (a - nearest_on_segment(a, c, d))
        .norm()
        .min((b - nearest_on_segment(b, c, d)).norm())
        .min((c - nearest_on_segment(c, a, b)).norm())
        .min((d - nearest_on_segment(d, a, b)).norm());
    let across = ab.dot(&cd);
    let determinant = aa * ee - across * across;
    if determinant > 0.0 {
        let s = (across * f - ab.dot(&ca) * ee) / determinant;
        let t = (aa * f - ab.dot(&ca) * across) / determinant;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            best = best.min(((a + ab * s) - (c + cd * t)).norm());
        }
    }
    best
}

/// Distance between the segment `from`-`to` and the triangle, 0 where they meet.
pub(super) fn segment_distance(from: &Point3, to: &Point3, corners: &Triangle) -> f64 {
    let way = to - from;
    let length = way.norm();
    if length > 0.0 && ray_hit(from, &(way / length), corners).is_some_and(|along| along <= length)
    {
        return 0.0;
    }
    let [a, b, c] = corners;
    (from - nearest_point(from, corners))
        .norm()
        .min((to - nearest_point(to, corners)).norm())
        .min(segments_distance(from, to, a, b))
        .min(segments_distance(from, to, b, c))
        .min(segments_distance(from, to, c, a))
}

/// Distance that a ball can move along the ray until it touches the triangle.
///
/// A ball that touches it from the start is stopped at 0 when it moves nearer, and free when it does
/// not: the distance to a convex set is convex along a line.
pub(super) fn ball_hit(
    origin: &Point3,
    direction: &Vector3,
    radius_m: f64,
    corners: &Triangle,
) -> Option<f64> {
    if radius_m <= 0.0 {
        return ray_hit(origin, direction, corners);
    }
    let away = origin - nearest_point(origin, corners);
    if away.norm_squared() <= radius_m * radius_m {
        return (away.dot(direction) < 0.0).then_some(0.0);
    }
    let mut nearest: Option<f64> = None;
    let mut keep = |along: Option<f64>| {
        if let Some(along) = along.filter(|along| *along >= 0.0)
            && nearest.is_none_or(|best| along < best)
        {
            nearest = Some(along);
        }
    };
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let length = normal.norm();
    if length > 0.0 {
        let lift = normal * (radius_m / length);
        for side in [lift, -lift] {
            keep(ray_hit(origin, direction, &corners.map(|corner| corner + side)));
        }
    }
    for (p, q) in [(a, b), (b, c), (c, a)] {
        keep(rod_hit(origin, direction, radius_m, p, q));
    }
    for corner in corners {
        keep(ball_on_point(origin, direction, radius_m, corner));
    }
    nearest
}

/// Distance along the ray to where it enters a sphere, from outside.
fn ball_on_point(
    origin: &Point3,
    direction: &Vector3,
    radius_m: f64,
    centre: &Point3,
) -> Option<f64> {
    let to_centre = centre - origin;
    let along = to_centre.dot(direction);
    let half_chord = radius_m * radius_m - (to_centre - direction * along).norm_squared();
    (half_chord >= 0.0).then(|| along - half_chord.sqrt())
}

/// Distance along the ray to where it enters the cylinder around `p`-`q`, its ends left open.
fn rod_hit(
    origin: &Point3,
    direction: &Vector3,
    radius_m: f64,
    p: &Point3,
    q: &Point3,
) -> Option<f64> {
    let edge = q - p;
    let length = edge.norm();
    if length == 0.0 {
        return None;
    }
    let axis = edge / length;
    let start = origin - p;
    let across = direction - axis * direction.dot(&axis);
    let beside = start - axis * start.dot(&axis);
    let speed = across.norm_squared();
    if speed == 0.0 {
        return None;
    }
    let towards = -beside.dot(&across) / speed;
    let nearest = (beside + across * towards).norm_squared();
    let half_chord = (radius_m * radius_m - nearest) / speed;
    if half_chord < 0.0 {
        return None;
    }
    let along = towards - half_chord.sqrt();
    let at = (start + direction * along).dot(&axis);
    (0.0..=length).contains(&at).then_some(along)
}
