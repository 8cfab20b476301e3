//! Rays, sweeps and distances against triangles: independent oracles, and leaks.

use geometry::rays::MeshCaster;
use geometry::{Point3, Vector3};
use proptest::prelude::*;

fn point(range: f64) -> impl Strategy<Value = Point3> {
    (-range..range, -range..range, -range..range).prop_map(|(x, y, z)| Point3::new(x, y, z))
}

fn direction() -> impl Strategy<Value = Vector3> {
    point(1.0).prop_filter_map("has a direction", |p| {
        let length = p.coords.norm();
        (length > 0.1).then(|| p.coords / length)
    })
}

/// Triangles of a soup, every three points one.
fn soup(most: usize) -> impl Strategy<Value = (Vec<Point3>, Vec<[u32; 3]>)> {
    prop::collection::vec((point(5.0), point(1.5), point(1.5)), 1..most).prop_map(|drawn| {
        let mut vertices = Vec::new();
        for (a, b, c) in drawn {
            vertices.extend([a, a + b.coords, a + c.coords]);
        }
        let triangles = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        let triangles = triangles.collect();
        (vertices, triangles)
    })
}

/// Ray against plane, then shares of the corners by areas: another road than the kernel's.
fn oracle_hit(origin: &Point3, direction: &Vector3, corners: &[Point3; 3]) -> Option<f64> {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let along = (a - origin).dot(&normal) / direction.dot(&normal);
    let at = origin + direction * along;
    let area = |p: &Point3, q: &Point3| (p - at).cross(&(q - at)).dot(&normal);
    let inside = area(a, b) >= 0.0 && area(b, c) >= 0.0 && area(c, a) >= 0.0;
    (along.is_finite() && along >= 0.0 && inside).then_some(along)
}

/// Distance by samples of the triangle: never less than the true one, and by at most half a step more.
fn sampled_distance(point: &Point3, corners: &[Point3; 3]) -> f64 {
    let mut best = f64::INFINITY;
    for i in 0..=60 {
        for j in 0..=60 - i {
            let (s, t) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
            let on = corners[0] + (corners[1] - corners[0]) * s + (corners[2] - corners[0]) * t;
            best = best.min((point - on).norm());
        }
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn casts_agree_with_every_triangle_in_turn(
        (vertices, triangles) in soup(40), origin in point(7.0), direction in direction(), max_m in 1.0..30.0f64,
    ) {
        let caster = MeshCaster::new(&vertices, &triangles);
        let expected = caster
            .triangles()
            .iter()
            .filter_map(|corners| oracle_hit(&origin, &direction, corners))
            .filter(|&along| along < max_m)
            .min_by(f64::total_cmp);
        match (caster.cast(&origin, &direction, max_m), expected) {
            (Some(found), Some(expected)) => prop_assert!((found - expected).abs() < 1e-6),
            (found, expected) => prop_assert_eq!(found, expected),
        }
    }

    #[test]
    fn distances_agree_with_samples((vertices, triangles) in soup(6), at in point(7.0), to in point(7.0)) {
        let caster = MeshCaster::new(&vertices, &triangles);
        let found = caster.distance_to(&at);
        let sampled = |p: &Point3| {
            caster.triangles().iter().map(|c| sampled_distance(p, c)).fold(f64::INFINITY, f64::min)
        };
        let expected = sampled(&at);
        prop_assert!(found <= expected + 1e-9 && found > expected - 0.1, "{found} {expected}");
        let clearance = caster.clearance(&at, &to);
        let on_way = (0..=20).map(|i| caster.distance_to(&(at + (to - at) * (f64::from(i) / 20.0))));
        let on_way = on_way.fold(f64::INFINITY, f64::min);
        prop_assert!(clearance <= on_way + 1e-9 && clearance > on_way - (to - at).norm() / 20.0);
        prop_assert_eq!(clearance == 0.0, caster.blocked(&at, &to));
    }

    #[test]
    fn a_ball_stops_where_it_touches(
        (vertices, triangles) in soup(12), from in point(7.0), to in point(7.0), radius_m in 0.05..0.6f64,
    ) {
        let caster = MeshCaster::new(&vertices, &triangles);
        if caster.distance_to(&from) > radius_m + 1e-6 {
            match caster.sweep(&from, &to, radius_m) {
                None => prop_assert!(caster.clearance(&from, &to) > radius_m - 1e-7),
                Some(along_m) => {
                    let at = from + (to - from).normalize() * along_m;
                    prop_assert!((caster.distance_to(&at) - radius_m).abs() < 1e-6);
                    let before = caster.clearance(&from, &at);
                    prop_assert!(before > radius_m - 1e-6, "{before}");
                }
            }
        }
    }

    #[test]
    fn no_ray_leaves_a_closed_box(origin in point(0.9), directions in prop::collection::vec(direction(), 50)) {
        let corner = |i: usize| {
            let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            Point3::new(side(0), side(1), side(2))
        };
        let vertices: Vec<Point3> = (0..8).map(corner).collect();
        let mut triangles = Vec::new();
        for axis in 0..3 {
            let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            for side in [0, 1 << axis] {
                triangles.push([side, side + u, side + u + v]);
                triangles.push([side, side + u + v, side + v]);
            }
        }
        let caster = MeshCaster::new(&vertices, &triangles);
        // Corners and edges too: what a leak would pass through.
        let mut all = directions.clone();
        all.extend(vertices.iter().map(|v| (v - origin).normalize()));
        all.extend((0..8).map(|i| ((vertices[i].coords + vertices[i ^ 1].coords) * 0.5 - origin.coords).normalize()));
        let hits = caster.cast_all(&origin, &all, 10.0);
        prop_assert!(hits.iter().all(|hit| hit.is_finite()));
    }
}

#[test]
fn many_rays_are_the_same_as_each() {
    let vertices = [
        Point3::new(-3.0, -3.0, 2.0),
        Point3::new(3.0, -3.0, 2.5),
        Point3::new(0.0, 3.0, 2.0),
        Point3::new(f64::NAN, 0.0, 0.0),
    ];
    let caster = MeshCaster::new(&vertices, &[[0, 1, 2], [0, 1, 3], [0, 1, 9]]);
    assert_eq!(caster.triangles().len(), 1, "corners that are not finite or not there");
    let directions: Vec<Vector3> = (0..10_000)
        .map(|i| {
            Vector3::new((f64::from(i) * 0.37).sin(), (f64::from(i) * 0.11).cos(), 1.0).normalize()
        })
        .collect();
    let all = caster.cast_all(&Point3::origin(), &directions, 9.0);
    for (direction, hit_m) in directions.iter().zip(all) {
        let one = caster.cast(&Point3::origin(), direction, 9.0).unwrap_or(f64::INFINITY);
        assert_eq!(one.to_bits(), hit_m.to_bits());
    }
    let nothing = MeshCaster::new(&[], &[]);
    assert_eq!(nothing.distance_to(&Point3::origin()), f64::INFINITY);
    assert_eq!(nothing.cast(&Point3::origin(), &Vector3::x(), 1.0), None);
}
