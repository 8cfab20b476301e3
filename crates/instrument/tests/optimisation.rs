//! The recording of an optimisation: complete, countable, and without influence.

use instrument::{
    Inspection, InstrumentError, OPTIMIZER_EVENTS, OptimisationOptions, OptimisationRecording,
    inspect,
};
use posegraph::synthetic::{Sphere, manhattan, sphere};
use posegraph::{Options, Solver, initial, optimize, optimize_weighted, optimize_with};

fn options(path: &std::path::Path) -> OptimisationOptions {
    OptimisationOptions { path: path.to_owned(), name: "test".into(), about: "A test.".into() }
}

fn rows(held: &Inspection, path: &str) -> u64 {
    held.entities.iter().find(|entity| entity.path == path).map_or(0, |entity| entity.rows)
}

#[test]
fn every_event_and_iteration_is_there_and_nothing_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.rrd");
    let graph = sphere(&Sphere { rounds: 8, poses_per_round: 12, ..Sphere::default() }).graph;
    let start = initial::odometry(&graph);
    let how = Options { solver: Solver::LevenbergMarquardt, ..Options::default() };
    let mut recording = OptimisationRecording::create(&graph, options(&path)).expect("a file");
    let solution = optimize_with(&graph, &start, &how, &mut recording);
    recording.finish(&serde_json::json!({ "chi2": solution.report.chi2 })).expect("it ends");
    assert_eq!(solution, optimize(&graph, &start, &how));

    let held = inspect(&path).expect("a recording");
    assert_eq!((&held.damage, held.has_layout), (&None, true));
    let variants: Vec<&str> = held.events.iter().map(|event| event.variant.as_str()).collect();
    let mut declared = OPTIMIZER_EVENTS;
    declared.sort_unstable();
    assert_eq!(variants, declared);
    let iterations = solution.report.iterations.len() as u64;
    assert_eq!(held.events[1].count, iterations);
    for drawn in ["/graph/odometry", "/graph/closures", "/graph/rejected", "/edges/numbers"] {
        assert_eq!(rows(&held, drawn), iterations + 1, "{drawn}");
    }
    for plotted in ["log10_cost", "rejected_edges"] {
        assert_eq!(rows(&held, &format!("/plots/{plotted}")), iterations + 1, "{plotted}");
    }
    for plotted in ["log10_step_norm", "gain_ratio", "accepted"] {
        assert_eq!(rows(&held, &format!("/plots/{plotted}")), iterations, "{plotted}");
    }
    assert_eq!(held.metrics.map(|json| json["chi2"].clone()), Some(solution.report.chi2.into()));
}

#[test]
fn several_optimisations_in_a_row_go_on_counting() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.rrd");
    let graph = manhattan(120, 2).graph;
    let start = initial::odometry(&graph);
    let mut recording = OptimisationRecording::create(&graph, options(&path)).expect("a file");
    let first = optimize_with(&graph, &start, &Options::default(), &mut recording);
    // The last edge loses its say.
    let mut weights = vec![1.0; graph.factors.len()];
    weights[graph.factors.len() - 1] = 0.0;
    let how = Options::default();
    let second = optimize_weighted(&graph, &first.poses, &weights, &how, &mut recording);
    recording.finish(&serde_json::Value::Null).expect("it ends");

    let held = inspect(&path).expect("a recording");
    let states = first.report.iterations.len() + second.report.iterations.len() + 2;
    let timelines: Vec<_> = held.timelines.iter().map(|t| (t.name.as_str(), t.last)).collect();
    assert_eq!(timelines, [("iteration", states as i64 - 1)]);
    assert_eq!(rows(&held, "/graph/poses"), states as u64);
}

#[test]
fn a_file_that_cannot_be_made_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("missing/a.rrd");
    let graph = manhattan(5, 1).graph;
    let refused = OptimisationRecording::create(&graph, options(&path)).err();
    assert!(matches!(refused, Some(InstrumentError::Write { .. })), "{refused:?}");
}
