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
use sensing::{Camera, DepthImage};

/// A room with boxes, noise of 0.3 %, shadows and speckle; or a frame of floats.
fn frame() -> FilledImage {
    let camera = Camera::new(576.0, 578.0, 319.5, 239.5);
    let depths_m = match std::env::var_os("DRIFTLAB_DEPTH").map(std::fs::read) {
        Some(Ok(bytes)) => {
            bytes.as_chunks::<4>().0.iter().map(|&four| f32::from_le_bytes(four)).collect()
        }
        _ => room(&camera),
    };
    let image = DepthImage::new(640, camera, depths_m);
    prepare(&image, &PrepareOptions::default()).expect("640 x 480")
}

fn room(camera: &Camera) -> Vec<f32> {
    let mut seed = 1_u32;
    let mut next = move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    let boxes = [
        ([-0.9, 0.2], [-0.2, 1.0], 2.2),
        ([0.4, -0.3], [1.1, 1.0], 3.1),
        ([-0.1, 0.5], [0.3, 1.0], 1.4),
    ];
    (0..640 * 480)
        .map(|i| {
            let [x, y] = camera.slope_of((i % 640) as f64, (i / 640) as f64);
            // Walls at x = 2 and -1.5, floor and ceiling at y = 1.1 and -1.2, a back wall.
            let sides = [2.0 / x, -1.5 / x, 1.1 / y, -1.2 / y];
            let walls = sides.into_iter().filter(|z| *z > 0.0).fold(5.2, f64::min);
            let front = boxes.iter().filter(|(low, high, z)| {
                let (px, py) = (x * z, y * z);
                px > low[0] && px < high[0] && py > low[1] && py < high[1]
            });
            let z = front.map(|(_, _, z)| *z).fold(walls, f64::min);
            let noise = next() + next() + next() + next() - 2.0;
            let missing = next() < 0.002 || (x - 0.1).hypot(y + 0.2) < 0.06;
            if missing { f32::NAN } else { (z * (1.0 + 0.005 * noise)) as f32 }
        })
        .collect()
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
