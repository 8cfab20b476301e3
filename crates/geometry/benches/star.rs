//! Membership and clipping of star polygons, beside the plain O(n) methods.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use geometry::Point2;
use geometry::planar::{Interval, StarPolygon};

/// A view over 240 degrees with ranges between 2 and 5 m.
fn view(n: usize) -> StarPolygon {
    let vertices = (0..n)
        .map(|i| {
            let bearing = 4.2 * i as f64 / n as f64 - 2.1;
            let range = 3.5 + 1.5 * (2.9 * i as f64).sin();
            Point2::new(range * bearing.cos(), range * bearing.sin())
        })
        .collect();
    let gap_after = (0..n).map(|i| i + 1 == n).collect();
    StarPolygon::try_new(vertices, gap_after).expect("bearings increase by less than half a turn")
}

/// Segments of about the length of a frontier edge, all over the view and a little beyond.
fn segments() -> Vec<(Point2, Point2)> {
    (0..1024)
        .map(|i| {
            let (t, u) = (f64::from(i) * 0.618_034, f64::from(i) * 0.414_214);
            let a = Point2::new(11.0 * t.fract() - 5.5, 11.0 * u.fract() - 5.5);
            let heading = f64::from(i) * 2.4;
            (a, Point2::new(a.x + 0.7 * heading.cos(), a.y + 0.7 * heading.sin()))
        })
        .collect()
}

/// Crossing numbers in plain floats.
fn contains_plainly(edges: &[(Point2, Point2)], p: &Point2) -> bool {
    let mut odd = false;
    for (c, d) in edges {
        if (c.y > p.y) != (d.y > p.y) && p.x < c.x + (p.y - c.y) / (d.y - c.y) * (d.x - c.x) {
            odd = !odd;
        }
    }
    odd
}

/// All crossings in plain floats, sorted, with a membership test between them.
fn clip_plainly(edges: &[(Point2, Point2)], a: &Point2, b: &Point2, out: &mut Vec<Interval>) {
    let along = b - a;
    let mut cuts = vec![0.0, 1.0];
    for (c, d) in edges {
        let edge = d - c;
        let slope = along.perp(&edge);
        let (t, u) = ((c - a).perp(&edge) / slope, (c - a).perp(&along) / slope);
        if (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u) {
            cuts.push(t);
        }
    }
    cuts.sort_by(f64::total_cmp);
    for pair in cuts.windows(2) {
        if contains_plainly(edges, &(a + along * (0.5 * (pair[0] + pair[1])))) {
            out.push(Interval::new(pair[0], pair[1]));
        }
    }
}

/// Times 1024 queries at once: divide by 1024 for one.
fn benches(criterion: &mut Criterion) {
    let segments = segments();
    let mut out = Vec::with_capacity(16);
    for n in [16, 64, 1024] {
        let polygon = view(n);
        let edges: Vec<_> = polygon.boundary().map(|e| (e.from, e.to)).collect();
        let mut contains = criterion.benchmark_group("contains_1024");
        contains.bench_with_input(BenchmarkId::new("star", n), &n, |bench, _| {
            bench.iter(|| segments.iter().filter(|(a, _)| polygon.contains(black_box(a))).count());
        });
        contains.bench_with_input(BenchmarkId::new("plain", n), &n, |bench, _| {
            bench.iter(|| {
                segments.iter().filter(|(a, _)| contains_plainly(&edges, black_box(a))).count()
            });
        });
        contains.finish();
        let mut clip = criterion.benchmark_group("clip_1024");
        clip.bench_with_input(BenchmarkId::new("star", n), &n, |bench, _| {
            bench.iter(|| {
                for (a, b) in &segments {
                    out.clear();
                    polygon.clip(black_box(a), black_box(b), &mut out);
                    black_box(&out);
                }
            });
        });
        clip.bench_with_input(BenchmarkId::new("plain", n), &n, |bench, _| {
            bench.iter(|| {
                for (a, b) in &segments {
                    out.clear();
                    clip_plainly(&edges, black_box(a), black_box(b), &mut out);
                    black_box(&out);
                }
            });
        });
        clip.finish();
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    benches(&mut criterion);
    criterion.final_summary();
}
