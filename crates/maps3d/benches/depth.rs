//! Reduction of a frame of 640 x 480 pixels: time by stage, and peak memory.
//!
//! `cargo bench -p maps3d`; `$DRIFTLAB_DEPTH` names a raw float frame of 640 x 480 to measure instead
//! of the synthetic one.

#![allow(missing_docs, reason = "criterion's macro writes a function without any")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use maps3d::image::{FilledImage, PrepareOptions, prepare};
use maps3d::reduce::{Contribution, HoleMethod, InverseDepth, Method, ReduceOptions, Stop, reduce};
use maps3d::triangulate::{FrontierSquares, Occlusion, label};
use maps3d::view::join;
use sensing::DepthImage;
use worlds::DepthRoom;

/// The synthetic room, or a frame of floats.
fn frame() -> FilledImage {
    let mut image = DepthRoom::default().image();
    if let Some(Ok(bytes)) = std::env::var_os("DRIFTLAB_DEPTH").map(std::fs::read) {
        let floats = bytes.as_chunks::<4>().0.iter().map(|&four| f32::from_le_bytes(four));
        image = DepthImage::new(640, image.camera, floats.collect());
    }
    prepare(&image, &PrepareOptions::default()).expect("640 x 480")
}

fn reductions(c: &mut Criterion) {
    let image = frame();
    let mut group = c.benchmark_group("640x480");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(12))
        .warm_up_time(Duration::from_secs(1));
    let removal = |contribution| Method::Removal { contribution, hole: HoleMethod::default() };
    let own = Method::InverseDepth(InverseDepth::default());
    let cases = [
        ("inverse_depth to 684", own, 684),
        ("inverse_depth to 10306", own, 10_306),
        ("centroid to 10", removal(Contribution::Centroid), 10),
        ("least_squares to 10", removal(Contribution::LeastSquares), 10),
        ("least_squares_vertical to 10", removal(Contribution::LeastSquaresVertical), 10),
        ("quadric to 10", Method::Quadric, 10),
    ];
    for (name, method, vertices) in cases {
        let options = ReduceOptions::new(method, Stop::Vertices(vertices));
        group.bench_function(name, |b| {
            b.iter(|| reduce(black_box(&image), &options).expect("valid options"));
        });
    }
    // What re-triangulation costs, by method: the thesis gives it a third.
    for hole in HoleMethod::ALL {
        let method = Method::Removal { contribution: Contribution::Centroid, hole };
        let options = ReduceOptions::new(method, Stop::Vertices(10));
        group.bench_function(format!("centroid to 10, {hole:?}"), |b| {
            b.iter(|| reduce(black_box(&image), &options).expect("valid options"));
        });
    }
    let options = ReduceOptions::new(own, Stop::Vertices(684));
    let mesh = reduce(&image, &options).expect("valid options");
    group.bench_function("label and join 684", |b| {
        b.iter(|| {
            let squares = FrontierSquares::of(&image, Some(&Occlusion::default()));
            let labels = label(&mesh, &squares, 0.0);
            join(&mesh, &labels, image.camera(), false).expect("labels fit")
        });
    });
    group.finish();
}

criterion_group!(benches, reductions);
criterion_main!(benches);
