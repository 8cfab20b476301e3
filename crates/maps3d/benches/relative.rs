//! A walk of simulated frames of 640 x 480 pixels: processor time per frame from depth to updated map, and memory per
//! view, of the relative map beside the voxel map.
//!
//! `cargo bench -p maps3d --bench relative -- [FRAMES] [FOLDER]`; 60 frames where no number is given. With a
//! folder the frames are written there, as `benches/peers/octomap_frames.py` reads them for OctoMap; it must be
//! new or empty, since frames of the same numbers would be written over. With `read` for the number the frames of
//! the folder are taken (`benches/peers/frames_of_folder.py` makes some of real depth images). From 500 frames on
//! the last line says how much the time per frame grew.

#![allow(missing_docs, reason = "a program")]
#![expect(clippy::print_stdout, reason = "a bench that prints its table")]
#![expect(clippy::print_stderr, reason = "a bench that says what is wrong with its arguments")]

use std::path::Path;
use std::time::Instant;

use maps3d::{Look, Map3d, RelativeMap, RelativeParams, VoxelMap, VoxelParams};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Off, VertexId};
use sensing::{Camera, DepthImage};

const COLUMNS: usize = 640;
const ROWS: usize = 480;

/// A hall of 10 by 8 by 3 m with pillars, shelves and a table: the hall from within, the rest from without.
const BOXES: [([f64; 3], [f64; 3]); 8] = [
    ([-5.0, -4.0, -1.5], [5.0, 4.0, 1.5]),
    ([-0.4, -0.4, -1.5], [0.4, 0.4, 1.5]),
    ([-3.0, 1.0, -1.5], [-2.5, 1.5, 1.5]),
    ([2.2, -2.0, -1.5], [2.7, -1.5, 1.5]),
    ([-5.0, -1.0, -1.5], [-4.6, 1.0, 0.3]),
    ([0.5, 3.6, -1.5], [2.5, 4.0, 0.5]),
    ([-2.0, -1.8, -0.8], [-0.9, -1.0, -0.7]),
    ([4.5, 0.5, -1.5], [5.0, 2.5, -0.2]),
];

/// Where the camera is in the hall at a frame: round and round, half as fast round itself.
fn world_from_camera(frame: usize) -> Se3 {
    let turn = frame as f64 * 0.06;
    let place = Vector3::new(3.2 * turn.cos(), 2.4 * turn.sin(), 0.15 * (1.7 * turn).sin());
    let upright = Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
    let upright = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(upright));
    let heading = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 1.5 * turn + 1.0);
    Se3::new(place, heading * upright)
}

/// What the camera sees: noise of a structured-light camera, and pixels without a reading.
fn image(frame: usize) -> DepthImage {
    let camera = Camera::new(576.0, 578.0, 319.5, 239.5);
    let pose = world_from_camera(frame);
    let mut seed = 0x9E37_79B9_u32.wrapping_mul(frame as u32 + 1);
    let mut depths_m = Vec::with_capacity(COLUMNS * ROWS);
    for at in 0..COLUMNS * ROWS {
        let [x, y] = camera.slope_of((at % COLUMNS) as f64, (at / COLUMNS) as f64);
        let way = pose.rotation * Vector3::new(x, y, 1.0);
        let mut depth_m = f64::INFINITY;
        for (number, (low, high)) in BOXES.iter().enumerate() {
            let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
            for axis in 0..3 {
                let [a, b] =
                    [low, high].map(|side| (side[axis] - pose.translation[axis]) / way[axis]);
                (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
            }
            let meets_m = if number == 0 { leave } else { enter };
            if enter <= leave && meets_m > 0.0 {
                depth_m = depth_m.min(meets_m);
            }
        }
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (f64::from(seed >> 16) / 65_536.0 - 0.5) * 0.004 * depth_m * depth_m;
        depths_m.push(if seed >> 24 == 0 { f32::NAN } else { (depth_m + noise) as f32 });
    }
    DepthImage::new(COLUMNS, camera, depths_m)
}

/// Makes a folder to write to; says what is wrong where something is in it already.
fn make(folder: &Path) -> Result<(), String> {
    let name = folder.display();
    if folder.exists() {
        let mut inside = std::fs::read_dir(folder)
            .map_err(|error| format!("{name}: expected a folder to write frames to: {error}"))?;
        if inside.next().is_some() {
            let advice = "`read` for the number takes the frames of a folder";
            return Err(format!(
                "{name}: is not empty, and frames would be written to it; {advice}"
            ));
        }
    }
    std::fs::create_dir_all(folder).map_err(|error| format!("{name}: cannot be made: {error}"))
}

/// Writes a frame, its pose and the camera for a peer.
fn write(folder: &Path, frame: usize, image: &DepthImage) -> std::io::Result<()> {
    let camera = image.camera;
    let text = format!(
        "{} {} {} {} {} {}\n",
        image.columns,
        image.rows(),
        camera.fx,
        camera.fy,
        camera.cx,
        camera.cy
    );
    std::fs::write(folder.join("camera"), text)?;
    let bytes: Vec<u8> = image.depths_m.iter().flat_map(|depth_m| depth_m.to_le_bytes()).collect();
    std::fs::write(folder.join(format!("{frame:04}.f32")), bytes)?;
    let pose = world_from_camera(frame);
    let (t, q) = (pose.translation, pose.rotation.coords);
    let text = format!("{} {} {} {} {} {} {}\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w);
    std::fs::write(folder.join(format!("{frame:04}.pose")), text)
}

/// The numbers of a text.
fn numbers(path: &Path) -> std::io::Result<Vec<f64>> {
    let text = std::fs::read_to_string(path)?;
    Ok(text.split_whitespace().filter_map(|word| word.parse().ok()).collect())
}

/// The frames of a folder and their poses, in order.
fn read(folder: &Path) -> std::io::Result<Vec<(Se3, DepthImage)>> {
    let camera = numbers(&folder.join("camera"))?;
    let mut paths: Vec<_> =
        std::fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "f32"));
    paths.sort();
    let mut frames = Vec::new();
    for path in paths {
        let bytes = std::fs::read(&path)?;
        let depths = bytes.as_chunks::<4>().0.iter().map(|&four| f32::from_le_bytes(four));
        let pinhole = Camera::new(camera[2], camera[3], camera[4], camera[5]);
        let image = DepthImage::new(camera[0] as usize, pinhole, depths.collect());
        let p = numbers(&path.with_extension("pose"))?;
        let turn =
            UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(p[6], p[3], p[4], p[5]));
        frames.push((Se3::new(Vector3::new(p[0], p[1], p[2]), turn), image));
    }
    Ok(frames)
}

/// Processor time of this thread so far, milliseconds; wall time where the system does not tell it.
fn cpu_ms(started: &Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanos = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanos.map_or_else(|| 1e3 * started.elapsed().as_secs_f64(), |nanos| nanos * 1e-6)
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let mut folder = args.get(1).map(Path::new);
    let taken = match (args.first(), folder) {
        (Some(word), Some(from)) if word == "read" => {
            folder = None;
            Some(read(from).expect("frames"))
        }
        _ => None,
    };
    if let Some(folder) = folder
        && let Err(message) = make(folder)
    {
        eprintln!("{message}");
        std::process::exit(2);
    }
    let asked = args.first().and_then(|arg| arg.parse().ok()).unwrap_or(60);
    let frames: usize = taken.as_ref().map_or(asked, Vec::len);
    let voxels_too = frames <= 100;
    let mut relative = RelativeMap::new(RelativeParams::default()).expect("defaults");
    let mut voxels = VoxelMap::new(VoxelParams::default()).expect("defaults");
    let mut graph: PoseGraph<Se3> = PoseGraph::new();
    let started = Instant::now();
    let mut times: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    let mut before = Se3::identity();
    for frame in 0..frames {
        let (pose, image) = match &taken {
            Some(taken) => taken[frame].clone(),
            None => (world_from_camera(frame), image(frame)),
        };
        if let Some(folder) = folder {
            write(folder, frame, &image).expect("a folder to write to");
        }
        let vertex = graph.add_vertex();
        let mut edges = Vec::new();
        if frame > 0 {
            let step = before.inverse_mul(&pose);
            let last = VertexId(vertex.0 - 1);
            edges.push(graph.add_edge(last, vertex, step, EdgeKind::Odometry).expect("an edge"));
        }
        before = pose;
        let look = Look { vertex, vertex_from_camera: Se3::identity(), image: &image };
        let maps: [&mut dyn Map3d; 2] = [&mut relative, &mut voxels];
        for (map, times) in maps.into_iter().zip(&mut times).take(1 + usize::from(voxels_too)) {
            let before_ms = cpu_ms(&started);
            map.edges_added(&graph, &edges, &mut Off);
            map.looked(&look, &mut Off).expect("a view");
            times.push(cpu_ms(&started) - before_ms);
        }
        let window = (frames / 10).max(1);
        if (frame + 1) % window == 0 {
            let late = |times: &Vec<f64>| median(&times[times.len().saturating_sub(window)..]);
            let kib = |map: &dyn Map3d| map.bytes() as f64 / 1024.0;
            println!(
                "frame {:4}: relative {:7.1} ms ({:3} active, {:5.1} KiB per view), voxels {:7.1} ms ({:8.0} KiB)",
                frame + 1,
                late(&times[0]),
                relative.active_count(),
                kib(&relative) / (frame + 1) as f64,
                late(&times[1]),
                kib(&voxels),
            );
        }
    }
    println!(
        "median of {frames} frames: relative {:.1} ms, voxels {:.1} ms; {} patches, {:.2} m2 open",
        median(&times[0]),
        median(&times[1]),
        relative.tally().patches,
        relative.tally().open_m2,
    );
    if times[0].len() >= 500 {
        let early = median(&times[0][50..100]);
        let late = median(&times[0][times[0].len() - 50..]);
        println!(
            "frames 50 to 100: {early:.1} ms, the last 50: {late:.1} ms, {:.2} times",
            late / early
        );
    }
}
