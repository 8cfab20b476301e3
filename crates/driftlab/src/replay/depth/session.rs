//! The whole replay: images to maps, then the way to the nearest frontier.

use std::path::Path;
use std::time::Instant;

use explore::FlightEvent;
use geometry::Point3;
use instrument::{FlightRecorder, FlightStep};
use maps3d::{Hovering, Look};
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Probe, VertexId};
use solid::Polyhedron;
use worlds::CameraParams;

use super::super::ReplayError;
use super::frames::{DepthFrame, DepthFrames};
use super::maps::DepthMap;
use super::report::{DepthMapMetrics, DepthMapTiming, DepthMetrics, DepthTiming};
use super::way::to_frontier;
use crate::config::Config;
use crate::flight::create_recording;
use crate::run::{AtWork, RunError, TimedProbe, quantile, to_json};

/// What came of a replay of depth images.
#[derive(Clone, Debug)]
pub struct DepthReplayed {
    /// `metrics.json`.
    pub metrics: DepthMetrics,
    /// `timing.json`.
    pub timing: DepthTiming,
    /// The maps as labelled meshes in the frame of the log's poses, by name; none of cells.
    pub meshes: Vec<(&'static str, Polyhedron)>,
    /// When each image was taken, seconds, and from where.
    pub poses: Vec<(f64, Se3)>,
}

/// A map, who listens to it, and what it cost.
struct Side {
    name: &'static str,
    map: DepthMap,
    recorder: FlightRecorder,
    look_millis: Vec<f64>,
    refused: u64,
}

/// Feeds every depth image of a log to the maps of a config, and asks each for the way to the nearest
/// frontier; records it to `recording`.
///
/// The frame of a vertex is that of its camera, turned as a body's: x ahead, z up. Edges are what the poses of
/// the log say of one image to the next. The outcome but for the timing follows from config and log alone.
/// `on_frame` is told the share of the log that was read, where that is known, and how many images were taken.
///
/// # Errors
/// [`ReplayError`] where the log has no image with a pose, a map cannot be made, or the recording cannot be
/// written.
pub fn replay_depth(
    config: &Config,
    frames: &mut DepthFrames,
    recording: &Path,
    about: &str,
    on_frame: &mut dyn FnMut(f64, u64),
) -> Result<DepthReplayed, ReplayError> {
    let started = Instant::now();
    let settings = config.replay3d.clone().unwrap_or_default();
    let maps = DepthMap::all(config, &settings)?;
    let Some(first) = frames.next_frame()? else {
        let (images, poses) = frames.counts();
        let [without_pose, without_readings] = frames.left_out();
        let why = format!("{without_pose} have no pose, {without_readings} too few readings");
        let found = format!("found {images} depth images and {poses} poses; {why}");
        return Err(frames.refused(&format!("{found}; expected depth images with poses")));
    };
    // The first camera looks along x.
    let far_m = settings.far_m;
    let low = Point3::new(-0.1 * far_m, -0.5 * far_m, -0.4 * far_m);
    let high = Point3::new(0.9 * far_m, 0.5 * far_m, 0.3 * far_m);
    let recording = create_recording(config, recording, about, (low, high), false)?;
    let sides = maps.into_iter().map(|(name, map)| {
        let mut recorder = recording.recorder(name);
        recorder.without_place();
        Side { name, map, recorder, look_millis: Vec::new(), refused: 0 }
    });
    let mut course = Course::new(sides.collect());
    let mut next = Some(first);
    while let Some(frame) = next {
        course.take(&frame)?;
        on_frame(frames.share(), course.poses.len() as u64);
        next = frames.next_frame()?;
    }
    let ways = course.end(settings.body_radius_m);
    let metrics = course.metrics(config, frames, &ways);
    let mut timing = course.timing(&ways);
    let log_from_vertex = &course.log_from_vertex;
    let meshes = course.sides.iter();
    let meshes =
        meshes.filter_map(|side| Some((side.name, side.map.mesh(log_from_vertex)?))).collect();
    for side in &mut course.sides {
        side.recorder.send()?;
    }
    recording.finish(&to_json(&metrics).map_err(RunError::from)?)?;
    timing.wall_secs = started.elapsed().as_secs_f64();
    Ok(DepthReplayed { metrics, timing, meshes, poses: course.poses })
}

/// The images so far.
struct Course {
    sides: Vec<Side>,
    at_work: AtWork,
    graph: PoseGraph<Se3>,
    vertex_from_camera: Se3,
    log_from_vertex: Vec<Se3>,
    poses: Vec<(f64, Se3)>,
    distance_m: f64,
}

/// What a map came to, the way to the nearest frontier included; and how long that way took, milliseconds.
type Asked = (DepthMapMetrics, f64);

impl Course {
    fn new(sides: Vec<Side>) -> Self {
        Self {
            at_work: AtWork::new(sides.len()),
            sides,
            graph: PoseGraph::new(),
            vertex_from_camera: CameraParams::default().body_from_camera(),
            log_from_vertex: Vec::new(),
            poses: Vec::new(),
            distance_m: 0.0,
        }
    }

    fn hovering(&self) -> Option<Hovering> {
        let vertex = u32::try_from(self.log_from_vertex.len().checked_sub(1)?).ok()?;
        Some(Hovering { vertex: VertexId(vertex), vertex_from_body: Se3::identity() })
    }

    /// Hangs an image on a vertex of its own, and shows it to every map.
    fn take(&mut self, frame: &DepthFrame) -> Result<(), ReplayError> {
        let before = self.log_from_vertex.last().copied();
        let log_from_vertex = frame.log_from_camera * self.vertex_from_camera.inverse();
        let first = *self.log_from_vertex.first().unwrap_or(&log_from_vertex);
        self.log_from_vertex.push(log_from_vertex);
        self.poses.push((frame.stamp_secs, frame.log_from_camera));
        let vertex = self.graph.add_vertex();
        let edge = before.map(|before| {
            let step = before.inverse_mul(&log_from_vertex);
            self.distance_m += step.distance();
            (VertexId(vertex.0 - 1), step)
        });
        let edge = match edge {
            Some((last, step)) => {
                let edge = self.graph.add_edge(last, vertex, step, EdgeKind::Odometry);
                edge.ok().map(|edge| (edge, last, step))
            }
            None => None,
        };
        let odom_from_vertex = first.inverse_mul(&log_from_vertex);
        let hovering = Hovering { vertex, vertex_from_body: Se3::identity() };
        let vertex_from_camera = self.vertex_from_camera;
        let look = Look { vertex, vertex_from_camera, image: &frame.image };
        let step = u64::from(vertex.0);
        for (index, side) in self.sides.iter_mut().enumerate() {
            let recorder = &mut side.recorder;
            recorder.begin_step(step, self.distance_m);
            recorder.emit(FlightEvent::VertexAdded { vertex, odom_from_vertex });
            if let Some((edge, a, a_from_b)) = edge {
                let (kind, b) = (EdgeKind::Odometry, vertex);
                recorder.emit(FlightEvent::EdgeAdded { edge, kind, a, b, a_from_b });
            }
            let image = &frame.image;
            recorder.emit(FlightEvent::Looked { hovering, vertex_from_camera, image });
            let start = Instant::now();
            let mut heard = TimedProbe::new(&mut side.recorder, &self.at_work, index);
            let map = side.map.map();
            if let Some((edge, ..)) = edge {
                map.edges_added(&self.graph, &[edge], &mut heard);
            }
            let taken = map.looked(&look, &mut heard);
            let spent = start.elapsed().saturating_sub(heard.spent);
            side.look_millis.push(spent.as_secs_f64() * 1e3);
            side.refused += u64::from(taken.is_err());
            let left = map.tally();
            side.recorder.end_step(&FlightStep {
                hovering,
                odom_from_body: odom_from_vertex,
                distance_m: self.distance_m,
                witness: None,
                newly_seen: &[],
                numbers: &[
                    ("frontier_open_m2", left.open_m2),
                    ("frontier_ignored_m2", left.sliver_m2 + left.given_up_m2),
                    ("map_faces", left.faces as f64),
                ],
            })?;
        }
        Ok(())
    }

    /// Asks every map for the way to the nearest frontier; what it holds is told as it was before.
    fn end(&mut self, body_radius_m: f64) -> Vec<Asked> {
        let Some(hovering) = self.hovering() else { return Vec::new() };
        let step = self.log_from_vertex.len() as u64;
        let mut asked = Vec::new();
        for side in &mut self.sides {
            let left = side.map.asked().tally();
            side.recorder.begin_step(step, self.distance_m);
            let start = Instant::now();
            let way = to_frontier(
                side.map.map(),
                &hovering,
                body_radius_m,
                &self.log_from_vertex,
                &mut side.recorder,
            );
            let millis = start.elapsed().as_secs_f64() * 1e3;
            let work = side.map.asked().work();
            let bends = way.iter().flat_map(|way| &way.in_log).map(|p| [p.x, p.y, p.z]).collect();
            let metrics = DepthMapMetrics {
                refused_looks: side.refused,
                frontier_left_m2: left.open_m2,
                frontier_ignored_m2: left.sliver_m2 + left.given_up_m2,
                frontier_ignored_largest_m2: left.largest_sliver_m2,
                frontier_places: left.patches as u64,
                map_faces: left.faces as u64,
                map_volumes: left.volumes as u64,
                map_tetrahedra: (work.tetrahedra > 0).then_some(work.tetrahedra as u64),
                map_invalid: work.refused,
                way_m: way.map(|way| way.length_m),
                path_shortening: (work.paths_m > 0.0)
                    .then(|| 1.0 - work.shortened_m / work.paths_m),
                way: bends,
                termination: "end of log",
            };
            asked.push((metrics, millis));
        }
        asked
    }

    fn metrics(&self, config: &Config, frames: &DepthFrames, asked: &[Asked]) -> DepthMetrics {
        let maps = self.sides.iter().zip(asked);
        DepthMetrics {
            name: config.name.clone(),
            seed: config.seed,
            keyframes: self.poses.len() as u64,
            images: frames.counts().0,
            without_pose: frames.left_out()[0],
            without_readings: frames.left_out()[1],
            distance_m: self.distance_m,
            maps: maps.map(|(side, (map, _))| (side.name.to_owned(), map.clone())).collect(),
        }
    }

    fn timing(&self, asked: &[Asked]) -> DepthTiming {
        let frames = self.poses.len().max(1) as f64;
        let maps = self.sides.iter().zip(asked).map(|(side, (_, way_millis))| {
            let timing = DepthMapTiming {
                keyframe_millis_median: quantile(&side.look_millis, 0.5),
                keyframe_millis_p99: quantile(&side.look_millis, 0.99),
                way_millis: *way_millis,
                bytes_per_keyframe: side.map.asked().bytes() as f64 / frames,
            };
            (side.name.to_owned(), timing)
        });
        let (first, last) = (self.poses.first(), self.poses.last());
        let log_secs = first.zip(last).map_or(0.0, |(first, last)| last.0 - first.0);
        DepthTiming { wall_secs: 0.0, log_secs, maps: maps.collect() }
    }
}
