//! `driftlab graph convert`: the same graph in another format.

use formats::pose_graph::AnyGraph;
use formats::tum::{self, Trajectory};
use posegraph::FactorGraph3;
use serde_json::json;

use super::super::failure::Failure;
use super::super::out::Out;
use super::args::{ConvertArgs, FileFormat};
use super::input::{self, Input};
use super::output::Target;

pub(super) fn convert(args: &ConvertArgs, out: &Out) -> Result<(), Failure> {
    let target = Target::new(&args.output, args.to, args.force)?;
    let (poses, edges, lost) = match input::any(&args.input, out)? {
        Input::Trajectory(trajectory) if target.format == FileFormat::Tum => {
            target.write_bytes(&tum::write(&trajectory))?;
            (trajectory.poses.len(), 0, None)
        }
        Input::Trajectory(trajectory) => {
            let (graph, kept) = graph_of(&trajectory);
            target.write(&AnyGraph::Space(graph))?;
            let lost = (!kept).then_some("the times: poses are numbered from 0");
            (trajectory.poses.len(), 0, lost)
        }
        Input::Graph(file) => {
            let (graph, fixed) = match &file.graph {
                AnyGraph::Plane(graph) => (&file.graph, graph.fixed.len()),
                AnyGraph::Space(graph) => (&file.graph, graph.fixed.len()),
            };
            let with_pose = input::trajectory_of(graph).poses.len();
            let lost = match target.format {
                FileFormat::Tum if with_pose == 0 => {
                    // Says what to do instead.
                    return input::poses(&args.input, out).map(drop);
                }
                FileFormat::Tum if with_pose < graph.vertices() => {
                    Some("the edges, and the vertices without poses")
                }
                FileFormat::Tum if graph.edges() > 0 => Some("the edges"),
                FileFormat::Toro if fixed > 0 => Some("which vertices are held (FIX)"),
                _ => None,
            };
            target.write(graph)?;
            match target.format {
                FileFormat::Tum => (with_pose, 0, lost),
                _ => (graph.vertices(), graph.edges(), lost),
            }
        }
    };
    let file = args.output.display().to_string();
    if let Some(lost) = lost {
        out.note(&format!("warning: {file}: the format cannot hold {lost}"));
    }
    let text = format!("{file}: {poses} poses, {edges} edges\n");
    out.result(&json!({ "file": file, "poses": poses, "edges": edges, "lost": lost }), &text)
}

/// The poses as vertices without edges, and whether their times became ids.
fn graph_of(trajectory: &Trajectory) -> (FactorGraph3, bool) {
    /// Up to here every integer is a float.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let stamps = &trajectory.stamps_secs;
    let whole = stamps.iter().all(|stamp| (0.0..EXACT).contains(stamp) && stamp.fract() == 0.0);
    let kept = whole && stamps.is_sorted_by(|a, b| a < b);
    let ids = if kept {
        stamps.iter().map(|&stamp| stamp as u64).collect()
    } else {
        (0..stamps.len() as u64).collect()
    };
    let initial = trajectory.poses.iter().copied().map(Some).collect();
    (FactorGraph3 { ids, initial, fixed: Vec::new(), factors: Vec::new() }, kept)
}
