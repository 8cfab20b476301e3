//! Membership agrees with exact crossing numbers.

mod common;

use common::config;
use common::oracle::Outline;
use common::places::{exact, roundings, scaled_up, spots, stars, whole};
use geometry::Point2;
use geometry::planar::StarPolygon;
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_membership.txt";

proptest! {
    #![proptest_config(config(3_000, SEEDS))]

    /// 60,000 points on small grids, most of them on something.
    #[test]
    fn membership_is_exact_on_grids(star in stars(), queries in prop::collection::vec(spots(), 20)) {
        let (polygon, outline) = (star.star(exact), star.outline());
        for query in queries {
            let p = query.on(&star);
            prop_assert_eq!(polygon.contains(&exact(p)), outline.contains(&whole(p)), "{:?}", p);
        }
    }
}

proptest! {
    #![proptest_config(config(1_000, SEEDS))]

    /// Up to 10,000 points that are on something but for the last bit.
    #[test]
    fn membership_is_exact_beside_rounding(
        star in stars(),
        rounding in roundings(),
        queries in prop::collection::vec(spots(), 10),
    ) {
        let vertices: Vec<Point2> = star.vertices.iter().map(|&p| rounding.place(p)).collect();
        // Rounding may make a chord too wide; then there is no polygon.
        if let Ok(polygon) = StarPolygon::try_new(vertices.clone(), star.gap_after.clone()) {
            let points: Vec<Point2> = queries.iter().map(|q| rounding.place(q.on(&star))).collect();
            let all = scaled_up(&[vertices.as_slice(), &points].concat());
            let (corners, exact_points) = all.split_at(vertices.len());
            let outline = Outline::new(corners, &star.gap_after);
            for (p, exact) in points.iter().zip(exact_points) {
                prop_assert_eq!(polygon.contains(p), outline.contains(exact), "{:?}", p);
            }
        }
    }
}
