//! Rays, sweeps and distances against independent oracles, and against leaks.

use geometry::rays::SegmentCaster;
use geometry::{Point2, Vector2};
use proptest::prelude::*;

fn point(range: f64) -> impl Strategy<Value = Point2> {
    (-range..range, -range..range).prop_map(|(x, y)| Point2::new(x, y))
}

fn segments() -> impl Strategy<Value = Vec<(Point2, Point2)>> {
    prop::collection::vec((point(10.0), point(10.0)), 1..60)
}

/// Ray against segment by Cramer's rule, with no tolerance: another road than the kernel's.
fn oracle_hit(origin: &Point2, direction: &Vector2, a: &Point2, b: &Point2) -> Option<f64> {
    let edge = b - a;
    let determinant = direction.y * edge.x - direction.x * edge.y;
    let rhs = a - origin;
    let along = (rhs.y * edge.x - rhs.x * edge.y) / determinant;
    let share = (direction.x * rhs.y - direction.y * rhs.x) / determinant;
    (determinant != 0.0 && (0.0..=1.0).contains(&share) && along >= 0.0).then_some(along)
}

fn sampled_distance(point: &Point2, segments: &[(Point2, Point2)]) -> f64 {
    let mut best = f64::INFINITY;
    for (a, b) in segments {
        for i in 0..=1000 {
            let on = a + (b - a) * (f64::from(i) / 1000.0);
            best = best.min((point - on).norm());
        }
    }
    best
}

/// A closed ring whose vertices are at random ranges around the origin.
fn ring(radii: &[f64], turn: f64) -> Vec<(Point2, Point2)> {
    let at = |i: usize| {
        let angle = turn + std::f64::consts::TAU * (i % radii.len()) as f64 / radii.len() as f64;
        Point2::new(radii[i % radii.len()] * angle.cos(), radii[i % radii.len()] * angle.sin())
    };
    (0..radii.len()).map(|i| (at(i), at(i + 1))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn casts_agree_with_every_segment_in_turn(
        segments in segments(), origin in point(12.0), angle in -4.0..4.0f64, max_m in 0.1..30.0f64,
    ) {
        let caster = SegmentCaster::new(&segments);
        let direction = Vector2::new(angle.cos(), angle.sin());
        let expected = segments
            .iter()
            .filter_map(|(a, b)| oracle_hit(&origin, &direction, a, b))
            .filter(|&along| along < max_m)
            .min_by(f64::total_cmp);
        match (caster.cast(&origin, &direction, max_m), expected) {
            (Some(found), Some(expected)) => prop_assert!((found - expected).abs() < 1e-7),
            (None, None) => {}
            // They may differ only where a ray grazes an end or the limit.
            (found, expected) => {
                let at = origin + direction * found.or(expected).unwrap();
                let graze = segments.iter().flat_map(|(a, b)| [a, b])
                    .any(|end| (end - at).norm() < 1e-6);
                let limit = (found.or(expected).unwrap() - max_m).abs() < 1e-6;
                prop_assert!(graze || limit, "{found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn no_ray_leaves_a_closed_ring(
        radii in prop::collection::vec(0.5..20.0f64, 3..40),
        turn in 0.0..6.0f64,
        angles in prop::collection::vec(0.0..7.0f64, 50),
        shift in point(1e4),
    ) {
        let walls: Vec<_> = ring(&radii, turn).into_iter()
            .map(|(a, b)| (a + shift.coords, b + shift.coords)).collect();
        // With three corners or more, equally spaced in angle, and the origin inside.
        prop_assume!(radii.len() > 4);
        let caster = SegmentCaster::new(&walls);
        for angle in angles {
            let direction = Vector2::new(angle.cos(), angle.sin());
            prop_assert!(caster.cast(&shift, &direction, 100.0).is_some());
        }
        // The hardest rays: aimed at the corners themselves.
        for (corner, _) in &walls {
            let direction = (corner - shift).normalize();
            let hit = caster.cast(&shift, &direction, 100.0);
            prop_assert!(hit.is_some_and(|hit| hit <= (corner - shift).norm() + 1e-6));
            prop_assert!(caster.blocked(&shift, &(shift + direction * 100.0)));
        }
    }

    #[test]
    fn distances_agree_with_samples(segments in segments(), from in point(12.0), to in point(12.0)) {
        let caster = SegmentCaster::new(&segments);
        let expected = sampled_distance(&from, &segments);
        let found = caster.distance_to(&from);
        // Samples are up to 0.015 m apart from the nearest point along segments of up to 28.3 m.
        prop_assert!(found <= expected + 1e-12 && found >= expected - 0.015);
        let least = (0..=200)
            .map(|i| caster.distance_to(&(from + (to - from) * (f64::from(i) / 200.0))))
            .fold(f64::INFINITY, f64::min);
        let clearance = caster.clearance(&from, &to);
        let spacing = (to - from).norm() / 400.0;
        prop_assert!(clearance <= least + 1e-9 && clearance >= least - spacing - 1e-9);
        prop_assert_eq!(caster.blocked(&from, &to), clearance == 0.0);
    }

    #[test]
    fn a_swept_disc_stops_where_it_first_touches(
        segments in segments(), from in point(12.0), to in point(12.0), radius_m in 0.01..1.0f64,
    ) {
        let caster = SegmentCaster::new(&segments);
        prop_assume!(caster.distance_to(&from) > radius_m);
        let way = to - from;
        match caster.sweep(&from, &to, radius_m) {
            None => prop_assert!(caster.clearance(&from, &to) > radius_m - 1e-8),
            Some(along) => {
                prop_assert!(along <= way.norm());
                let stop = from + way * (along / way.norm());
                prop_assert!((caster.distance_to(&stop) - radius_m).abs() < 1e-6);
                prop_assert!(caster.clearance(&from, &stop) > radius_m - 1e-6);
            }
        }
    }
}

#[test]
fn a_touching_disc_may_leave_but_not_press_on() {
    let wall = [(Point2::new(-5.0, 0.0), Point2::new(5.0, 0.0))];
    let caster = SegmentCaster::new(&wall);
    let at = Point2::new(0.0, 0.2);
    assert_eq!(caster.sweep(&at, &Point2::new(0.0, 3.0), 0.25), None);
    assert_eq!(caster.sweep(&at, &Point2::new(3.0, 0.2), 0.25), None);
    assert_eq!(caster.sweep(&at, &Point2::new(3.0, 0.1), 0.25), Some(0.0));
}

#[test]
fn a_ray_along_a_segment_hits_its_near_end() {
    let caster = SegmentCaster::new(&[(Point2::new(2.0, 1.0), Point2::new(4.0, 1.0))]);
    let x = Vector2::new(1.0, 0.0);
    assert_eq!(caster.cast(&Point2::new(0.0, 1.0), &x, 10.0), Some(2.0));
    assert_eq!(caster.cast(&Point2::new(3.0, 1.0), &x, 10.0), Some(0.0));
    assert_eq!(caster.cast(&Point2::new(9.0, 1.0), &-x, 10.0), Some(5.0));
    assert_eq!(caster.cast(&Point2::new(5.0, 1.0), &x, 10.0), None);
}

#[test]
fn degenerate_scenes_answer_plainly() {
    let origin = Point2::origin();
    let x = Vector2::new(1.0, 0.0);
    let empty = SegmentCaster::new(&[]);
    assert_eq!(empty.cast(&origin, &x, 10.0), None);
    assert_eq!(empty.distance_to(&origin), f64::INFINITY);
    assert_eq!(empty.clearance(&origin, &Point2::new(1.0, 0.0)), f64::INFINITY);
    assert!(!empty.blocked(&origin, &Point2::new(1.0, 0.0)));

    let dot = Point2::new(3.0, 0.0);
    let single = SegmentCaster::new(&[(dot, dot)]);
    assert_eq!(single.cast(&origin, &x, 10.0), Some(3.0));
    assert_eq!(single.cast(&origin, &x, 3.0), None, "the limit itself is out of range");
    assert_eq!(single.distance_to(&origin), 3.0);
    assert!(single.blocked(&origin, &dot), "the end of the way belongs to it");
    assert!(!single.blocked(&origin, &origin), "a way of no length meets nothing");

    let broken = SegmentCaster::new(&[(Point2::new(f64::NAN, 0.0), dot), (dot, dot)]);
    assert_eq!(broken.segments().len(), 1);
    assert_eq!(broken.cast(&origin, &x, 10.0), Some(3.0));
}

#[test]
fn many_threads_may_share_one() {
    fn shared<T: Send + Sync>() {}
    shared::<SegmentCaster>();
}
