//! Areas of unions, intersections and differences against a library that shares nothing with ours
//! or with the engine beneath: a port of Clipper2, which sweeps in 64-bit integers.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use clipper2_rust::core::{FillRule, Path64, Point64, area_paths};
use clipper2_rust::{difference_64, intersect_64, union_64};
use common::views::{self, Draw};
use geometry::planar::overlay::{LATTICE_M, Operation, Region, overlay};

/// Steps of the other library's lattice: a thousand of them to one of ours.
const STEPS_PER_M: f64 = 1e9;

fn paths(region: &Region<u32>) -> Vec<Path64> {
    let step = |metres: f64| (metres * STEPS_PER_M).round() as i64;
    let ring = |points: &Vec<geometry::Point2>| {
        points.iter().map(|p| Point64::new(step(p.x), step(p.y))).collect()
    };
    region.rings.iter().map(|part| ring(&part.points)).collect()
}

fn perimeter_m(region: &Region<u32>) -> f64 {
    region.edges().map(|edge| (edge.to - edge.from).norm()).sum()
}

#[test]
fn areas_of_ten_thousand_pairs_are_those_of_another_library() {
    let mut draw = Draw::new(20_181);
    let mut met = [0_u32; views::KINDS];
    let mut judged = 0;
    for case in 0..10_000 {
        let (a, b, kind) = views::pair(&mut draw, case);
        met[kind] += 1;
        let (first, second) = (paths(&a), paths(&b));
        // Half a step of our lattice to either side, along all of the boundary.
        let slack_m2 = LATTICE_M * (perimeter_m(&a) + perimeter_m(&b)) + 1e-9;
        for operation in [Operation::Union, Operation::Intersection, Operation::Difference] {
            let rule = FillRule::NonZero;
            let theirs = match operation {
                Operation::Union => union_64(&first, &second, rule),
                Operation::Intersection => intersect_64(&first, &second, rule),
                Operation::Difference => difference_64(&first, &second, rule),
            };
            let expected_m2 = area_paths(&theirs) / (STEPS_PER_M * STEPS_PER_M);
            let area_m2 = overlay(&a, &b, operation).unwrap().region.area_m2();
            let off_m2 = (area_m2 - expected_m2).abs();
            assert!(
                off_m2 <= slack_m2,
                "case {case}, kind {kind}, {operation:?}: {area_m2} for {expected_m2}"
            );
            judged += usize::from(expected_m2 > 0.1);
        }
    }
    assert!(met.iter().all(|&count| count >= 1000), "{met:?}");
    assert!(judged > 15_000, "only {judged} results have an inside");
}
