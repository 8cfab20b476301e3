//! Labelled overlay beside the engine's own, which knows no labels: pairs of 60-vertex views.

use std::hint::black_box;

use criterion::Criterion;
use geometry::Point2;
use geometry::planar::overlay::{EdgeLabel, Region, RingEdge, union, union_all};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::Overlay;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

/// A view with 60 vertices between 1.5 and 3 m, around a point.
fn view(seed: u32, x: f64, y: f64) -> Vec<Point2> {
    (0..60)
        .map(|i| {
            let bearing = f64::from(i) / 60.0 * std::f64::consts::TAU;
            let range = 2.25 + 0.75 * (f64::from(seed) * 1.7 + f64::from(i) * 2.9).sin();
            Point2::new(x + range * bearing.cos(), y + range * bearing.sin())
        })
        .collect()
}

fn region(points: &[Point2]) -> Region<u32> {
    let labels = [EdgeLabel::Obstacle, EdgeLabel::Frontier, EdgeLabel::Free];
    Region::from_ring(
        points
            .iter()
            .enumerate()
            .map(|(i, point)| (*point, RingEdge { label: labels[i % 3], data: i as u32 })),
    )
}

fn contour(points: &[Point2]) -> Vec<IntPoint<i32>> {
    let step = |v: f64| (v * 1e6).round() as i32;
    points.iter().map(|p| IntPoint::new(step(p.x), step(p.y))).collect()
}

/// Times 64 pairs at once.
fn benches(criterion: &mut Criterion) {
    let pairs: Vec<(Vec<Point2>, Vec<Point2>)> = (0..64)
        .map(|i| {
            let (x, y) = (1.0 + 0.7 * f64::from(i).sin(), 0.5 + 0.4 * f64::from(i).cos());
            (view(2 * i, 0.0, 0.0), view(2 * i + 1, x, y))
        })
        .collect();
    let labelled: Vec<_> = pairs.iter().map(|(a, b)| (region(a), region(b))).collect();
    let mut group = criterion.benchmark_group("union_64_pairs");
    group.bench_function("labelled", |bench| {
        bench.iter(|| {
            for (a, b) in &labelled {
                black_box(union(a, b)).expect("near the origin");
            }
        });
    });
    group.bench_function("unlabelled", |bench| {
        bench.iter(|| {
            for (a, b) in &pairs {
                let mut overlay = Overlay::from_subj_and_clip(&[contour(a)][..], &[contour(b)][..]);
                black_box(overlay.overlay(OverlayRule::Union, FillRule::NonZero));
            }
        });
    });
    group.finish();
    let walk: Vec<Region<u32>> = (0..1000)
        .map(|i| {
            let t = f64::from(i) * 0.1;
            region(&view(i, 40.0 * (t * 0.31).sin(), 40.0 * (t * 0.47).cos()))
        })
        .collect();
    let walk: Vec<&Region<u32>> = walk.iter().collect();
    criterion.bench_function("union_of_1000", |bench| {
        bench.iter(|| black_box(union_all(&walk)).expect("near the origin"));
    });
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    benches(&mut criterion);
    criterion.final_summary();
}
