//! Correction: poses that place edges pull to the truth, and the grid that follows them.

use std::sync::Arc;

use maps2d::correction::{Correction, CorrectionParams, GivenPoses};
use maps2d::grid::{CellState, CorrectedGrid, GridMap, GridParams};
use maps2d::{ExplorationMap, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use proptest::prelude::*;

use super::config;
use super::drive::{Done, Drive, Mix, stories};
use super::room::{Room, Sensor};
use super::told::Told;

const MIX: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

fn room() -> (Room, Sensor) {
    let room = Room { width_m: 12.0, height_m: 9.0, pillars: vec![[4.0, 3.0, 2.0, 2.0]] };
    (room, Sensor { fov_rad: 2.0, rays: 24, range_m: 4.0 })
}

/// A round trip: true poses, and odometry that turns a little too far with every step.
fn round_trip() -> (Vec<Se2>, Vec<Se2>) {
    let corners = [(2.0, 1.5), (10.0, 1.5), (10.0, 7.5), (2.0, 7.5), (2.0, 2.5)];
    let mut truth = Vec::new();
    for pair in corners.windows(2) {
        let (dx, dy): (f64, f64) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let steps = dx.hypot(dy).round();
        for k in 0..steps as usize {
            let share = k as f64 / steps;
            let heading = dy.atan2(dx);
            truth.push(Se2::new(pair[0].0 + share * dx, pair[0].1 + share * dy, heading));
        }
    }
    let drift = Se2::new(0.03, -0.01, 0.02);
    let steps = truth.windows(2).map(|pair| pair[0].inverse_mul(&pair[1]) * drift).collect();
    (truth, steps)
}

/// Drives the round trip; every `every`-th vertex recognises the first one.
fn drive(every: usize, map: &mut dyn ExplorationMap) -> (PoseGraph, Vec<EdgeId>) {
    let (room, sensor) = room();
    let (truth, steps) = round_trip();
    let mut graph = PoseGraph::new();
    let mut places = Vec::new();
    for (i, pose) in truth.iter().enumerate() {
        let vertex = graph.add_vertex();
        let mut edges = Vec::new();
        if i > 0 {
            let before = VertexId(i as u32 - 1);
            edges.push(graph.add_edge(before, vertex, steps[i - 1], EdgeKind::Odometry).unwrap());
        }
        if i > 0 && i % every == 0 {
            let known_from_here = truth[0].inverse_mul(pose);
            let known = VertexId(0);
            let place = graph.add_edge(known, vertex, known_from_here, EdgeKind::Place).unwrap();
            edges.push(place);
            places.push(place);
        }
        map.edges_added(&graph, &edges, &mut Off);
        let standing = Standing { vertex, vertex_from_body: Se2::identity() };
        map.scanned(&standing, &room.scan(pose, &sensor), &mut Off);
    }
    (graph, places)
}

#[derive(Debug)]
struct Truth(Vec<Se2>);

impl GivenPoses for Truth {
    fn map_from_vertex(&self, vertex: VertexId) -> Option<Se2> {
        let pose = self.0.get(vertex.0 as usize)?;
        Some(self.0[0].inverse_mul(pose))
    }
}

fn believed(grid: &GridMap) -> Vec<(i32, i32, CellState)> {
    let cells = grid.cells();
    let mut all: Vec<_> = (0..cells.slots())
        .map(|slot| cells.cell(slot))
        .map(|cell| (cell.column, cell.row, cells.state(cell)))
        .filter(|cell| cell.2 != CellState::Unknown)
        .collect();
    all.sort_by_key(|cell| (cell.0, cell.1));
    all
}

/// Where every pose is tied to the truth, the corrected grid is the one on true poses, though the
/// plain one is far off.
#[test]
fn exact_places_undo_the_drift() {
    let params = GridParams { cell_m: 0.5, ..GridParams::default() };
    let sure = CorrectionParams {
        place_sigma_m: 1e-4,
        place_sigma_rotation_rad: 1e-4,
        ..CorrectionParams::default()
    };
    let mut corrected = CorrectedGrid::new(params, sure);
    let mut plain = GridMap::new(params);
    let mut given = GridMap::with_poses(params, Arc::new(Truth(round_trip().0)));
    drive(1, &mut corrected);
    drive(1, &mut plain);
    drive(1, &mut given);
    assert_eq!(believed(corrected.grid()), believed(&given));
    assert_ne!(believed(&plain), believed(&given));
    assert!(corrected.correction().count() > 20);
}

/// One loop closure pulls the end of the way to where it started.
#[test]
fn a_closed_loop_is_nearer_to_the_truth() {
    let (truth, _) = round_trip();
    let mut corrected = CorrectedGrid::new(GridParams::default(), CorrectionParams::default());
    let (graph, places) = drive(truth.len() - 1, &mut corrected);
    assert_eq!(places.len(), 1);
    let error = |poses: &[Se2]| -> f64 {
        let off = poses.iter().zip(&truth).map(|(pose, truth_pose)| {
            (truth[0].inverse_mul(truth_pose).translation - pose.translation).norm_squared()
        });
        (off.sum::<f64>() / truth.len() as f64).sqrt()
    };
    let after = error(corrected.correction().poses());
    // The place is taken back: odometry is left, as if it had never been.
    let mut graph = graph;
    graph.withdraw(places[0]).unwrap();
    corrected.edge_withdrawn(&graph, places[0], &mut Off);
    let before = error(corrected.correction().poses());
    assert!(after < 0.5 * before, "{after} m after, {before} m before");
    let mut plain = GridMap::new(GridParams::default());
    drive(truth.len() - 1, &mut plain);
    assert_eq!(believed(corrected.grid()), believed(&plain));
}

#[test]
fn a_graph_that_is_no_graph_leaves_poses_alone() {
    let mut correction = Correction::new(CorrectionParams::default());
    assert!(correction.optimise(&PoseGraph::new(), 0, &mut Off) || correction.poses().is_empty());
    let mut graph = PoseGraph::new();
    let (a, b) = (graph.add_vertex(), graph.add_vertex());
    let edge = graph.add_edge(a, b, Se2::new(0.0, 0.0, 0.0), EdgeKind::Place).unwrap();
    // Two vertices in one place, joined by a place edge alone.
    assert!(correction.edges_added(&graph, &[edge], &mut Off));
    assert_eq!(correction.poses().len(), 2);
}

proptest! {
    #![proptest_config(config(24, "proptest-regressions/corrected.txt"))]

    /// Whoever listens changes nothing, and a robot without noise needs no correction.
    #[test]
    fn heard_or_not_and_without_noise_nothing_moves(story in stories(MIX, 1..24)) {
        let params = (GridParams::default(), CorrectionParams::default());
        let mut quiet = CorrectedGrid::new(params.0, params.1);
        let mut heard = CorrectedGrid::new(params.0, params.1);
        let mut told: Vec<Told> = Vec::new();
        let mut one = Drive::new(&story.room, &story.sensor);
        let mut other = Drive::new(&story.room, &story.sensor);
        for op in &story.ops {
            let done = one.act(op, &mut [&mut quiet]);
            other.act_with(op, &mut [&mut heard], &mut told);
            if done == Done::Nothing {
                continue;
            }
            prop_assert_eq!(quiet.correction().poses(), heard.correction().poses());
            prop_assert_eq!(believed(quiet.grid()), believed(heard.grid()));
            prop_assert_eq!(quiet.frontier(), heard.frontier());
            let first = one.world_from(VertexId(0));
            for (i, pose) in quiet.correction().poses().iter().enumerate() {
                let truth = first.inverse_mul(&one.world_from(VertexId(i as u32)));
                prop_assert!((truth.translation - pose.translation).norm() < 1e-6);
            }
        }
    }
}
