//! Casting rays, against scenes of growing size.

use criterion::{BenchmarkId, Criterion};
use geometry::rays::SegmentCaster;
use geometry::{Point2, Vector2};
use std::hint::black_box;

/// Square pillars on squared paper, `side` by `side` of them, 4 m apart and 0.4 m wide.
fn pillars(side: usize) -> Vec<(Point2, Point2)> {
    let mut segments = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let low = Vector2::new(4.0 * column as f64, 4.0 * row as f64);
            let corner = |i: usize| {
                let (x, y) = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)][i % 4];
                Point2::new(low.x + x, low.y + y)
            };
            segments.extend((0..4).map(|i| (corner(i), corner(i + 1))));
        }
    }
    segments
}

fn casts(c: &mut Criterion) {
    let mut group = c.benchmark_group("rays");
    group.sample_size(20);
    for side in [50usize, 500] {
        let segments = pillars(side);
        let caster = SegmentCaster::new(&segments);
        let middle = Point2::new(2.0 * side as f64 + 2.0, 2.0 * side as f64 + 2.0);
        for range_m in [5.0, 30.0] {
            let name = BenchmarkId::new(format!("cast_{range_m}m"), segments.len());
            group.bench_function(name, |b| {
                let mut angle = 0.0f64;
                b.iter(|| {
                    angle += 0.618;
                    let direction = Vector2::new(angle.cos(), angle.sin());
                    caster.cast(black_box(&middle), &direction, range_m)
                });
            });
        }
        group.bench_function(BenchmarkId::new("distance_to", segments.len()), |b| {
            b.iter(|| caster.distance_to(black_box(&middle)));
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    casts(&mut criterion);
    criterion.final_summary();
}
