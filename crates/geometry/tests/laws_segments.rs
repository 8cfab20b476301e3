//! Distances and capsules against sampling.

mod common;

use common::config;
use geometry::Point2;
use geometry::planar::{
    box_gap, near_segment, point_segment_distance, segment_segment_distance, segments_meet,
};
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_segments.txt";

fn points() -> impl Strategy<Value = Point2> {
    prop_oneof![
        (-3_i32..=3, -3_i32..=3).prop_map(|(x, y)| Point2::new(f64::from(x), f64::from(y))),
        (-3.0..3.0_f64, -3.0..3.0_f64).prop_map(|(x, y)| Point2::new(x, y)),
    ]
}

fn samples(a: Point2, b: Point2) -> impl Iterator<Item = (f64, Point2)> {
    (0..=200).map(move |k| {
        let t = f64::from(k) / 200.0;
        (t, a + (b - a) * t)
    })
}

proptest! {
    #![proptest_config(config(2_000, SEEDS))]

    #[test]
    fn a_point_is_as_far_as_the_nearest_sample(p in points(), a in points(), b in points()) {
        let distance = point_segment_distance(&p, &a, &b);
        let sampled = samples(a, b).map(|(_, s)| (p - s).norm()).fold(f64::INFINITY, f64::min);
        prop_assert!(distance <= sampled + 1e-12);
        prop_assert!(distance >= sampled - (b - a).norm() / 400.0 - 1e-12);
    }

    #[test]
    fn two_segments_are_as_far_as_their_nearest_samples(
        (a, b) in (points(), points()),
        (c, d) in (points(), points()),
    ) {
        let distance = segment_segment_distance(&a, &b, &c, &d);
        let sampled = samples(a, b)
            .map(|(_, s)| point_segment_distance(&s, &c, &d))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(distance <= sampled + 1e-12);
        prop_assert!(distance >= sampled - (b - a).norm() / 400.0 - 1e-12);
        prop_assert!(box_gap(&a, &b, &c, &d) <= distance + 1e-12);
        prop_assert_eq!(segments_meet(&a, &b, &c, &d), distance == 0.0);
        prop_assert_eq!(distance == 0.0, segment_segment_distance(&d, &c, &a, &b) == 0.0);
    }

    #[test]
    fn near_is_what_lies_in_the_capsule(
        (a, b) in (points(), points()),
        (c, d) in (points(), points()),
        radius in prop_oneof![Just(0.0), Just(1.0), 0.01..3.0_f64],
    ) {
        let near = near_segment(&a, &b, &c, &d, radius);
        if let Some(near) = near {
            prop_assert!(0.0 <= near.from && near.from <= near.to && near.to <= 1.0);
        }
        for (t, s) in samples(a, b) {
            let distance = point_segment_distance(&s, &c, &d);
            if near.is_some_and(|near| near.from <= t && t <= near.to) {
                prop_assert!(distance <= radius + 1e-7, "{} {}", t, distance);
            } else {
                prop_assert!(distance >= radius - 1e-7, "{} {}", t, distance);
            }
        }
    }
}
