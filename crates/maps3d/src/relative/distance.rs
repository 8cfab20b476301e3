//! Distances of straight motions from triangles.

use nalgebra::{Point3, Vector3};

/// The least distance between two segments, squared.
fn segments_squared(p: [&Point3<f64>; 2], q: [&Point3<f64>; 2]) -> f64 {
    let (u, v, w) = (p[1] - p[0], q[1] - q[0], p[0] - q[0]);
    let (a, b, c, d, e) = (u.dot(&u), u.dot(&v), v.dot(&v), u.dot(&w), v.dot(&w));
    let clamp = |x: f64| x.clamp(0.0, 1.0);
    let share = |of: f64, all: f64| if all > 0.0 { clamp(of / all) } else { 0.0 };
    let across = a * c - b * b;
    // Parallel ones are nearest at an end of one of them: the start of the first will do.
    let mut s = if across > 1e-14 * a * c { clamp((b * e - c * d) / across) } else { 0.0 };
    let mut t = if c > 0.0 { (b * s + e) / c } else { 0.0 };
    if !(0.0..=1.0).contains(&t) {
        t = clamp(t);
        s = share(b * t - d, a);
    }
    (w + u * s - v * t).norm_squared()
}

/// The least distance of a point from a triangle, squared.
fn point_squared(p: &Point3<f64>, [a, b, c]: [&Point3<f64>; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let squared = normal.norm_squared();
    let is_inner = |x: &Point3<f64>, y: &Point3<f64>| normal.dot(&(y - x).cross(&(p - x))) >= 0.0;
    if squared > 0.0 && is_inner(a, b) && is_inner(b, c) && is_inner(c, a) {
        let height = normal.dot(&(p - a));
        return height * height / squared;
    }
    let at = [p, p];
    segments_squared(at, [a, b]).min(segments_squared(at, [b, c])).min(segments_squared(at, [c, a]))
}

/// Whether a segment goes through a triangle.
fn pierces(from: &Point3<f64>, to: &Point3<f64>, [a, b, c]: [&Point3<f64>; 3]) -> bool {
    let normal = (b - a).cross(&(c - a));
    let (of_from, of_to) = (normal.dot(&(from - a)), normal.dot(&(to - a)));
    if (of_from > 0.0) == (of_to > 0.0) {
        return false;
    }
    let way: Vector3<f64> = to - from;
    let side = |x: &Point3<f64>, y: &Point3<f64>| way.dot(&(x - from).cross(&(y - from)));
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}

/// The least distance of a point from a triangle, metres.
pub(super) fn point_triangle(p: &Point3<f64>, triangle: [&Point3<f64>; 3]) -> f64 {
    point_squared(p, triangle).sqrt()
}

/// The least distance of a straight motion from a triangle, metres; 0 where it goes through.
pub(super) fn motion_triangle(
    from: &Point3<f64>,
    to: &Point3<f64>,
    triangle: [&Point3<f64>; 3],
) -> f64 {
    if pierces(from, to, triangle) {
        return 0.0;
    }
    let [a, b, c] = triangle;
    let way = [from, to];
    let least = point_squared(from, triangle)
        .min(point_squared(to, triangle))
        .min(segments_squared(way, [a, b]))
        .min(segments_squared(way, [b, c]))
        .min(segments_squared(way, [c, a]));
    least.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least distance over points of both, from a fine raster.
    fn sampled(from: &Point3<f64>, to: &Point3<f64>, [a, b, c]: [&Point3<f64>; 3]) -> f64 {
        let n = 60;
        let mut least = f64::INFINITY;
        for i in 0..=n {
            let p = from + (to - from) * (f64::from(i) / f64::from(n));
            for j in 0..=n {
                for k in 0..=n - j {
                    let (s, t) = (f64::from(j) / f64::from(n), f64::from(k) / f64::from(n));
                    least = least.min((a + (b - a) * s + (c - a) * t - p).norm());
                }
            }
        }
        least
    }

    #[test]
    fn distances_agree_with_a_raster() {
        let mut seed = 11_u64;
        let mut next = move || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        for round in 0..60 {
            let mut point = || Point3::new(next(), next(), next());
            let [from, mut to, a, b, c] = [point(), point(), point(), point(), point()];
            if round % 7 == 0 {
                to = from;
            }
            let triangle = [&a, &b, &c];
            let exact = motion_triangle(&from, &to, triangle);
            let rough = sampled(&from, &to, triangle);
            assert!(exact <= rough + 1e-12 && rough <= exact + 0.06, "{exact} {rough}");
            let near = point_triangle(&from, triangle);
            assert!(exact <= near + 1e-12);
        }
    }
}
