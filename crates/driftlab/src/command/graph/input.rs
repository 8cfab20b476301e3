//! Reading a graph or a trajectory, whatever it is written in.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use formats::pose_graph::{self, AnyGraph, GraphFile, GraphFileReport};
use formats::tum::{self, Trajectory};
use formats::{FormatError, Kind};
use pose::Se3;
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::out::Out;

/// A file that was read.
pub(super) enum Input {
    Graph(GraphFile),
    Trajectory(Trajectory),
}

/// What was read, and how long it took.
pub(super) struct Timed<T> {
    pub read: T,
    pub secs: f64,
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| {
        Failure::Input(anyhow!("{}: {error}; expected a g2o, TORO or TUM file", path.display()))
    })
}

fn located(path: &Path) -> impl Fn(FormatError) -> Failure {
    move |error| Failure::Input(anyhow!("{}: {error}", path.display()))
}

/// Reads a graph; what was odd about it goes to standard error.
pub(super) fn graph(path: &Path, out: &Out) -> Result<Timed<GraphFile>, Failure> {
    let start = Instant::now();
    let bytes = bytes_of(path)?;
    let read = pose_graph::read(&bytes).map_err(located(path))?;
    let secs = start.elapsed().as_secs_f64();
    for message in read.report.messages() {
        out.note(&format!("warning: {}: {message}", path.display()));
    }
    Ok(Timed { read, secs })
}

/// Reads a graph or a trajectory.
pub(super) fn any(path: &Path, out: &Out) -> Result<Input, Failure> {
    let bytes = bytes_of(path)?;
    let extension = path.extension().and_then(|extension| extension.to_str());
    if formats::sniff(&bytes, extension) == Kind::Tum {
        return Ok(Input::Trajectory(tum::read(&bytes).map_err(located(path))?));
    }
    drop(bytes);
    Ok(Input::Graph(graph(path, out)?.read))
}

/// Poses of a graph or a trajectory.
pub(super) struct Poses {
    /// Every pose with its time; ids count as seconds, poses of the plane lie at height 0.
    pub trajectory: Trajectory,
    /// Of the graph that they come from; a trajectory does not tell.
    pub dimensions: Option<usize>,
}

/// Every pose of a file, of which there must be one.
pub(super) fn poses(path: &Path, out: &Out) -> Result<Poses, Failure> {
    let (trajectory, dimensions) = match any(path, out)? {
        Input::Trajectory(trajectory) => (trajectory, None),
        Input::Graph(file) => (trajectory_of(&file.graph), Some(file.graph.dimensions())),
    };
    if trajectory.poses.is_empty() {
        return Err(Failure::Input(anyhow!(
            "{}: found edges only, expected poses; `driftlab graph optimize` computes them",
            path.display()
        )));
    }
    Ok(Poses { trajectory, dimensions })
}

/// The start values of a graph as a trajectory, by their ids.
pub(super) fn trajectory_of(graph: &AnyGraph) -> Trajectory {
    let (ids, poses): (&[u64], Vec<Option<Se3>>) = match graph {
        AnyGraph::Plane(graph) => {
            let lift = |pose: &Option<pose::Se2>| pose.as_ref().map(lifted);
            (&graph.ids, graph.initial.iter().map(lift).collect())
        }
        AnyGraph::Space(graph) => (&graph.ids, graph.initial.clone()),
    };
    let with_pose = ids.iter().zip(poses).filter_map(|(&id, pose)| Some((id as f64, pose?)));
    let (stamps_secs, poses) = with_pose.unzip();
    Trajectory { stamps_secs, poses }
}

/// A pose of the plane z = 0.
fn lifted(pose: &pose::Se2) -> Se3 {
    let half = pose.angle() / 2.0;
    let rotation = pose::nalgebra::Quaternion::new(half.cos(), 0.0, 0.0, half.sin());
    let rotation = pose::nalgebra::UnitQuaternion::new_unchecked(rotation);
    Se3::new([pose.translation.x, pose.translation.y, 0.0].into(), rotation)
}

/// Unknown tags and warnings for `--json`.
pub(super) fn report_json(report: &GraphFileReport) -> (Value, Value) {
    let unknown = report.unknown_tags.iter().map(|unknown| {
        let tag = unknown.tag.trim_matches('`');
        json!({ "tag": tag, "count": unknown.count, "first_line": unknown.first_line })
    });
    let warnings = report.warnings.iter().map(|warning| {
        json!({
            "message": warning.to_string(),
            "count": warning.count,
            "first_line": warning.first_line,
        })
    });
    (unknown.collect(), warnings.collect())
}
