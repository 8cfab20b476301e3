//! Time, memory and quality of every method: one line per frame, method and number of vertices.
//!
//! ```text
//! cargo run --release -p maps3d --example measure -- [FRAME.raw FX,FY,CX,CY]... [--out FOLDER]
//! ```
//!
//! A frame is 640 x 480 little-endian floats, metres, 0 where nothing was measured; without one, a
//! synthetic room is made. Time is that of the processor, not of the clock on the wall. Memory is the
//! most that the process ever held, itself and the frame included: give it one method by name in `ONLY`.
//! `VERTICES=684,684` measures other numbers of vertices, as often as they are named. With `--out`, each mesh is written
//! as OFF, for others to judge.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use maps3d::image::{FilledImage, PrepareOptions, prepare};
use maps3d::quality::measure;
use maps3d::reduce::{Contribution, HoleMethod, InverseDepth, Method, ReduceOptions, Stop, reduce};
use maps3d::triangulate::{FrontierSquares, ImageMesh, Occlusion, label};
use maps3d::view::join;
use sensing::{Camera, DepthImage};
use worlds::DepthRoom;

const SIZES: [usize; 5] = [10_306, 2_060, 684, 113, 10];

/// Seconds of processor time of this thread so far.
fn cpu_secs() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanos = text.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    nanos.map_or(f64::NAN, |nanos| nanos * 1e-9)
}

/// A number of bytes that the kernel tells of this process.
fn told_bytes(key: &str) -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix(key));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()).and_then(|w| w.parse().ok());
    kilobytes.map_or(f64::NAN, |kilobytes: f64| kilobytes * 1024.0)
}

fn methods() -> Vec<(&'static str, Method)> {
    let removal = |contribution| Method::Removal { contribution, hole: HoleMethod::EarClipping };
    vec![
        ("inverse_depth", Method::InverseDepth(InverseDepth::default())),
        ("centroid", removal(Contribution::Centroid)),
        ("least_squares", removal(Contribution::LeastSquares)),
        ("least_squares_vertical", removal(Contribution::LeastSquaresVertical)),
        ("quadric", Method::Quadric),
    ]
}

fn off(mesh: &ImageMesh, image: &FilledImage) -> String {
    let mut text = format!("OFF\n{} {} 0\n", mesh.pixels.len(), mesh.triangles.len());
    for p in mesh.points_in_camera(image.camera()) {
        let _ = writeln!(text, "{} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

fn frame(name: &str, image: &DepthImage, out: Option<&Path>) {
    let only = std::env::var("ONLY").unwrap_or_default();
    let chosen = std::env::var("VERTICES").unwrap_or_default();
    let mut sizes: Vec<usize> = chosen.split(',').filter_map(|word| word.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = SIZES.to_vec();
    }
    for (method_name, method) in methods().into_iter().filter(|(n, _)| n.contains(&only)) {
        for &vertices in &sizes {
            let started = cpu_secs();
            let filled = prepare(image, &PrepareOptions::default()).expect("640 x 480");
            let squares = FrontierSquares::of(&filled, Some(&Occlusion::default()));
            let prepared = cpu_secs();
            let options = ReduceOptions::new(method, Stop::Vertices(vertices));
            let mesh = reduce(&filled, &options).expect("valid options");
            let reduced = cpu_secs();
            let labels = label(&mesh, &squares, 0.0);
            join(&mesh, &labels, filled.camera(), false).expect("labels fit");
            let joined = cpu_secs();
            let bytes = told_bytes("VmHWM:") / image.depths_m.len() as f64;
            let quality = measure(&filled, &mesh);
            let (plane, ray) = (&quality.plane, &quality.ray);
            #[expect(clippy::print_stdout, reason = "a program that tells")]
            {
                println!(
                    "{name:10} {method_name:22} {:6} ms {:7.1} {:7.1} {:6.1}  B/px {bytes:5.0}  \
                     plane rms {:.4} p95 {:.4} max {:.3}  ray p95 {:.4}  uncovered {}",
                    mesh.pixels.len(),
                    1e3 * (prepared - started),
                    1e3 * (reduced - prepared),
                    1e3 * (joined - reduced),
                    plane.rms_m,
                    plane.p95_m,
                    plane.max_m,
                    ray.p95_m,
                    quality.uncovered_share
                );
            }
            if let Some(out) = out {
                let path = out.join(format!("{name}.{method_name}.{vertices}.off"));
                std::fs::write(path, off(&mesh, &filled)).expect("writable");
            }
        }
    }
}

fn main() {
    let mut words = std::env::args().skip(1);
    let (mut frames, mut out) = (Vec::new(), None);
    while let Some(word) = words.next() {
        if word == "--out" {
            out = words.next().map(PathBuf::from);
            continue;
        }
        let camera = words.next().expect("FX,FY,CX,CY after each frame");
        let numbers: Vec<f64> = camera.split(',').map(|x| x.parse().expect("a number")).collect();
        let [fx, fy, cx, cy] = numbers[..] else { panic!("four numbers") };
        let bytes = std::fs::read(&word).expect("readable");
        let depths =
            bytes.as_chunks::<4>().0.iter().map(|&four| f32::from_le_bytes(four)).collect();
        let name = Path::new(&word).file_stem().map(|s| s.to_string_lossy().into_owned());
        let image = DepthImage::new(640, Camera::new(fx, fy, cx, cy), depths);
        frames.push((name.unwrap_or_default(), image));
    }
    if frames.is_empty() {
        frames.push(("room".to_owned(), DepthRoom::default().image()));
    }
    for (name, image) in frames {
        frame(&name, &image, out.as_deref());
    }
}
