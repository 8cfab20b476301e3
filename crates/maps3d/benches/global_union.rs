//! Time per look of the united map, by stage, on simulated frames of 640 x 480; tetrahedra on demand apart.
//!
//! `cargo bench -p maps3d --bench global_union [-- --frames N --vertices N --out DIR --peer "PROGRAM SCRIPT"]`.
//! With `--out` the frames and their poses go to a folder, as `benches/peers/octomap_frames.py` reads them;
//! `--peer` runs that on them at once, in the same run. Seconds are those of one thread on a processor.

#[path = "../../solid/benches/clock/mod.rs"]
mod clock;

use std::io::Write as _;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use clock::secs;
use maps3d::reduce::Stop;
use maps3d::{
    ConsolidationEvent, DepthEvent, Look, Map3d, PlanEvent, UnionEvent, UnionMap, UnionParams,
};
use nalgebra::Vector3;
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Off, Probe, VertexId};
use sensing::{DepthImage, FlyingRobot};
use worlds::space::{Rooms3dParams, rooms};
use worlds::{FlyerParams, SimFlyer};

fn say(line: &str) {
    writeln!(std::io::stdout(), "{line}").expect("stdout takes text");
}

/// One frame and where it was taken.
struct Frame {
    vertex: VertexId,
    vertex_from_camera: Se3,
    image: DepthImage,
}

/// Looks of a robot without drift: four to each side of every place, then half a metre on.
fn fly(count: usize) -> (Vec<Frame>, PoseGraph<Se3>) {
    let mut params = FlyerParams::default();
    // Focal lengths of 576 and 578 pixels, as the peer's script takes for granted.
    (params.camera.columns, params.camera.rows) = (640, 480);
    params.camera.fov_across_rad = 2.0 * (319.5_f64 / 576.0).atan();
    params.camera.fov_down_rad = 2.0 * (239.5_f64 / 578.0).atan();
    params.odometry.scale = 0.0;
    let world = rooms(&Rooms3dParams::default()).expect("a place");
    let mut robot = SimFlyer::new(Arc::new(world), params, 1).expect("sound options");
    let mut graph = PoseGraph::new();
    let mut vertex = graph.add_vertex();
    let mut vertex_from_body = Se3::identity();
    let mut frames = Vec::new();
    while frames.len() < count {
        for _ in 0..4 {
            let vertex_from_camera = vertex_from_body * robot.body_from_camera();
            frames.push(Frame { vertex, vertex_from_camera, image: robot.look() });
            vertex_from_body =
                vertex_from_body * robot.turn(std::f64::consts::FRAC_PI_2).before_from_after;
        }
        // A wall ahead: another way.
        let mut flight = robot.fly(&Vector3::new(0.5, 0.0, 0.0));
        while flight.distance_m < 0.3 {
            vertex_from_body = vertex_from_body * flight.before_from_after;
            vertex_from_body = vertex_from_body * robot.turn(1.1).before_from_after;
            flight = robot.fly(&Vector3::new(0.5, 0.0, 0.0));
        }
        let next = graph.add_vertex();
        let step = vertex_from_body * flight.before_from_after;
        graph.add_edge(vertex, next, step, EdgeKind::Odometry).expect("vertices that exist");
        (vertex, vertex_from_body) = (next, Se3::identity());
    }
    frames.truncate(count);
    (frames, graph)
}

/// Seconds on the processor at the events that part the stages.
#[derive(Default)]
struct Stages {
    marks: Vec<(&'static str, f64)>,
}

impl Stages {
    fn mark(&mut self, name: &'static str) {
        // The clock tells what its work took: nothing, since it was started.
        self.marks.push((name, clock::now()));
    }

    /// Seconds from one event to another.
    fn between(&self, from: &str, to: &str) -> f64 {
        let at = |name: &str| self.marks.iter().find(|mark| mark.0 == name).map(|mark| mark.1);
        at(to).zip(at(from)).map_or(f64::NAN, |(to, from)| to - from)
    }
}

impl Probe<DepthEvent<'_>> for Stages {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, event: DepthEvent<'_>) {
        if let DepthEvent::Joined { .. } = event {
            self.mark("Joined");
        }
    }
}

impl Probe<UnionEvent<'_>> for Stages {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, event: UnionEvent<'_>) {
        self.mark(event.variant());
    }
}

impl Probe<PlanEvent<'_>> for Stages {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, _: PlanEvent<'_>) {}
}

impl Probe<ConsolidationEvent<'_>> for Stages {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, _: ConsolidationEvent<'_>) {}
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Frames as raw floats, each with its pose: place and quaternion, the scalar last.
fn write(folder: &Path, frames: &[Frame], map: &UnionMap) {
    std::fs::create_dir_all(folder).expect("a folder");
    for (i, frame) in frames.iter().enumerate() {
        let bytes: Vec<u8> = frame.image.depths_m.iter().flat_map(|d| d.to_le_bytes()).collect();
        std::fs::write(folder.join(format!("{i:04}.f32")), bytes).expect("a file");
        let pose = map.map_from_vertex()[frame.vertex.0 as usize] * frame.vertex_from_camera;
        let (t, q) = (pose.translation, pose.rotation.coords);
        let text = format!("{} {} {} {} {} {} {}\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w);
        std::fs::write(folder.join(format!("{i:04}.pose")), text).expect("a file");
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let value = |name: &str| {
        words.iter().position(|word| word == name).and_then(|at| words.get(at + 1)).cloned()
    };
    let number = |name, or| value(name).map_or(or, |text| text.parse().expect("a count"));
    let (count, vertices) = (number("--frames", 50), number("--vertices", 684));
    let mut params = UnionParams::default();
    if let Some(reduce) = &mut params.view.reduce {
        reduce.stop = Stop::Vertices(vertices);
    }
    let (frames, graph) = fly(count);
    let mut map = UnionMap::new(params).expect("usual options");
    let edges: Vec<_> = graph.edges().map(|(edge, _)| edge).collect();
    map.edges_added(&graph, &edges, &mut Off);
    let (mut views, mut unions, mut wholes) = (vec![], vec![], vec![]);
    for (i, frame) in frames.iter().enumerate() {
        let &Frame { vertex, vertex_from_camera, ref image } = frame;
        let mut stages = Stages::default();
        let (_, whole) = secs(|| {
            map.looked(&Look { vertex, vertex_from_camera, image }, &mut stages).expect("sound");
        });
        unions.push(1e3 * stages.between("Joined", "Sorted"));
        views.push(1e3 * whole - unions[i]);
        wholes.push(1e3 * whole);
        if [1, 5, 10, 20, 30, 40, 50].contains(&(i + 1)) {
            let (tetrahedra, filled) = secs(|| map.fill(&mut Off));
            say(&format!(
                "after {:2} looks: union {:.1} ms (last), {} faces, {:.1} MB; {tetrahedra} tetrahedra on demand in \
                 {:.0} ms",
                i + 1,
                unions[i],
                map.polyhedron().faces().len(),
                map.bytes() as f64 / 1e6,
                1e3 * filled,
            ));
        }
    }
    let counts = map.counts();
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    say(&format!(
        "{count} looks of 640 x 480 at {vertices} points: depth to polyhedron {:.1} ms, union {:.1} ms (mean; median \
         {:.1}), together {:.1} ms; {} refused, {} fillings refused",
        mean(&views),
        mean(&unions),
        median(unions.iter().copied()),
        mean(&wholes),
        counts.refused,
        counts.refused_fillings,
    ));
    if let Some(folder) = value("--out") {
        write(Path::new(&folder), &frames, &map);
        if let Some(peer) = value("--peer") {
            let mut parts = peer.split_whitespace();
            let mut command = Command::new(parts.next().expect("a program"));
            let output = command.args(parts).arg(&folder).output().expect("the peer runs");
            say(String::from_utf8_lossy(&output.stdout).trim_end());
            say(String::from_utf8_lossy(&output.stderr).trim_end());
        }
    }
}
