//! Clipping agrees with all crossings, sorted, and exact membership between them.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::config;
use common::oracle::{At, Fraction, Outline, Whole};
use common::places::{exact, roundings, scaled_up, spots, stars, whole};
use geometry::Point2;
use geometry::planar::{Interval, StarPolygon};
use num_rational::Ratio;
use num_traits::ToPrimitive;
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_clip.txt";

fn value<T: Whole>(t: &Fraction<T>) -> f64
where
    Ratio<T>: ToPrimitive,
{
    Ratio::new(t.over.clone(), t.under.clone()).to_f64().unwrap()
}

/// The same count, and every parameter within `1e-12`.
fn agree<T: Whole>(
    polygon: &StarPolygon,
    outline: &Outline<T>,
    (a, b): (&Point2, &Point2),
    (exact_a, exact_b): (&At<T>, &At<T>),
) -> Result<(), TestCaseError>
where
    Ratio<T>: ToPrimitive,
{
    let untouched = Interval::new(0.25, 0.5);
    let mut found = vec![untouched];
    polygon.clip(a, b, &mut found);
    prop_assert_eq!(found.remove(0), untouched);
    let expected: Vec<Interval> = outline
        .clip(exact_a, exact_b)
        .iter()
        .map(|(from, to)| Interval::new(value(from), value(to)))
        .collect();
    prop_assert_eq!(found.len(), expected.len(), "{:?} {:?} {:?}", (a, b), found, expected);
    let mut reached = 0.0;
    for (f, e) in found.iter().zip(&expected) {
        prop_assert!(reached <= f.from && f.from <= f.to && f.to <= 1.0, "{:?}", found);
        reached = f.to;
        let near = (f.from - e.from).abs() <= 1e-12 && (f.to - e.to).abs() <= 1e-12;
        prop_assert!(near, "{:?} {:?} {:?}", (a, b), found, expected);
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(2_000, SEEDS))]

    /// 40,000 segments on small grids: through vertices, the origin, along chords and spokes.
    #[test]
    fn clipping_is_exact_on_grids(
        star in stars(),
        queries in prop::collection::vec((spots(), spots()), 20),
    ) {
        let (polygon, outline) = (star.star(exact), star.outline());
        for (a, b) in queries {
            let (a, b) = (a.on(&star), b.on(&star));
            agree(&polygon, &outline, (&exact(a), &exact(b)), (&whole(a), &whole(b)))?;
        }
    }
}

proptest! {
    #![proptest_config(config(1_000, SEEDS))]

    /// Up to 10,000 segments that go through something but for the last bit.
    #[test]
    fn clipping_is_exact_beside_rounding(
        star in stars(),
        rounding in roundings(),
        queries in prop::collection::vec((spots(), spots()), 10),
    ) {
        let vertices: Vec<Point2> = star.vertices.iter().map(|&p| rounding.place(p)).collect();
        if let Ok(polygon) = StarPolygon::try_new(vertices.clone(), star.gap_after.clone()) {
            let ends: Vec<Point2> = queries
                .iter()
                .flat_map(|(a, b)| [a, b].map(|spot| rounding.place(spot.on(&star))))
                .collect();
            let all = scaled_up(&[vertices.as_slice(), &ends].concat());
            let (corners, exact_ends) = all.split_at(vertices.len());
            let outline = Outline::new(corners, &star.gap_after);
            for (ab, exact) in ends.chunks(2).zip(exact_ends.chunks(2)) {
                agree(&polygon, &outline, (&ab[0], &ab[1]), (&exact[0], &exact[1]))?;
            }
        }
    }
}
