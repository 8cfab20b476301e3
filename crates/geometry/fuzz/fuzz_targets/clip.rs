//! Membership and clipping on a small grid, against exact crossing numbers.
#![no_main]

#[path = "../../tests/common/oracle.rs"]
mod oracle;

use geometry::Point2;
use geometry::planar::{Interval, StarPolygon};
use libfuzzer_sys::fuzz_target;
use oracle::{At, Outline};

type Grid = (i8, i8);

fn float(p: Grid) -> Point2 {
    Point2::new(f64::from(p.0), f64::from(p.1))
}

fn whole(p: Grid) -> At<i128> {
    At { x: p.0.into(), y: p.1.into() }
}

fuzz_target!(|data: (Vec<(Grid, bool)>, Vec<(Grid, Grid)>)| {
    let (drawn, segments) = data;
    // A wrong order is refused; most inputs must not end there, hence the sorting.
    let mut tagged: Vec<(Point2, (Grid, bool))> =
        drawn.into_iter().filter(|(p, _)| *p != (0, 0)).map(|d| (float(d.0), d)).collect();
    geometry::predicates::sort_by_bearing(&mut tagged);
    let (vertices, tags): (Vec<Point2>, Vec<(Grid, bool)>) = tagged.into_iter().unzip();
    let gap_after: Vec<bool> = tags.iter().map(|(_, gap)| *gap).collect();
    let Ok(polygon) = StarPolygon::try_new(vertices, gap_after.clone()) else { return };
    let corners: Vec<At<i128>> = tags.iter().map(|(p, _)| whole(*p)).collect();
    let outline = Outline::new(&corners, &gap_after);
    for (a, b) in segments {
        assert_eq!(polygon.contains(&float(a)), outline.contains(&whole(a)), "{a:?}");
        let mut found = Vec::new();
        polygon.clip(&float(a), &float(b), &mut found);
        let expected: Vec<Interval> = outline
            .clip(&whole(a), &whole(b))
            .iter()
            .map(|(s, t)| {
                let value = |f: &oracle::Fraction<i128>| f.over as f64 / f.under as f64;
                Interval::new(value(s), value(t))
            })
            .collect();
        assert_eq!(found.len(), expected.len(), "{a:?} {b:?} {found:?} {expected:?}");
        for (f, e) in found.iter().zip(&expected) {
            assert!((f.from - e.from).abs() < 1e-12 && (f.to - e.to).abs() < 1e-12, "{a:?} {b:?}");
        }
    }
});
