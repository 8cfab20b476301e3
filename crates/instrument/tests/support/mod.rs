//! One simulated run, with whoever listens.

#![allow(dead_code, reason = "no test uses all of it")]

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use explore::{ExploreParams, Explorer, StepReport};
use instrument::{Every, Level, MapOptions, Recorder, Recording, RecordingOptions, StepEnd};
use maps2d::ExplorationMap;
use maps2d::active::{ActiveArea, ActiveAreaParams};
use maps2d::extended::{ExtendedMap, ExtendedParams};
use maps2d::grid::{GridMap, GridParams};
use maps2d::polygons::{CorrectedPolygons, CorrectedPolygonsParams};
use maps2d::relative::{RelativeMap, RelativeParams};
use metrics::{Coverage, CoverageParams, Witness};
use worlds::{RobotParams, SimRobot, World2d};

pub fn map(kind: &str) -> Box<dyn ExplorationMap + Send> {
    match kind {
        "grid" => Box::new(GridMap::new(GridParams::default())),
        "active_area" => Box::new(ActiveArea::new(ActiveAreaParams::default())),
        "extended" => Box::new(ExtendedMap::new(ExtendedParams::default())),
        "corrected_polygons" => {
            Box::new(CorrectedPolygons::new(CorrectedPolygonsParams::default()))
        }
        _ => Box::new(RelativeMap::new(RelativeParams::default())),
    }
}

pub fn options(path: &Path, level: Level, maps: &[&str], world: &World2d) -> RecordingOptions {
    RecordingOptions {
        path: path.to_owned(),
        name: format!("{} at full drift", world.name()),
        level,
        every: Every::STEP,
        maps: maps.iter().map(|kind| MapOptions::of_kind(kind)).collect(),
        about: "A robot whose odometry drifts explores an unknown place.".to_owned(),
        config: "name = \"example\"".to_owned(),
        bounds_in_world: world.bounds(),
        sight_m: 11.0,
        follow: false,
    }
}

/// Runs one map's robot; returns what it came to, and the time of each step with its recording.
pub fn explore(
    recorder: &mut Recorder,
    kind: &str,
    world: &Arc<World2d>,
    max_steps: u64,
) -> (StepReport, Witness, Vec<Duration>) {
    let coverage = Coverage::new(world, CoverageParams::default()).expect("a grid");
    recorder.place(world, &coverage).expect("the place can be drawn");
    let robot = SimRobot::new(world.clone(), RobotParams::default(), 1);
    let mut witness = Witness::new(robot, coverage);
    let params = ExploreParams { max_steps, ..ExploreParams::default() };
    let mut explorer = Explorer::new(vec![map(kind)], params);
    let mut times = Vec::new();
    let mut report = explorer.report();
    while report.ending.is_none() {
        let started = Instant::now();
        let distance_m = witness.tally().distance_m;
        recorder.begin_step(explorer.steps(), distance_m, distance_m);
        report = explorer.step(&mut witness, recorder);
        let newly_seen = witness.take_newly_seen();
        let tally = witness.tally();
        let numbers = [
            ("coverage", witness.coverage().fraction()),
            ("frontier_open_m", report.frontier.open_m),
            ("frontier_ignored_m", report.frontier.ignored_m),
        ];
        let end = StepEnd {
            standing: report.standing,
            distance_m: tally.distance_m,
            sim_time_secs: tally.distance_m,
            witness: Some(&witness),
            newly_seen: &newly_seen,
            numbers: &numbers,
        };
        recorder.end_step(&end).expect("rows fit together");
        times.push(started.elapsed());
    }
    (report, witness, times)
}

/// Records runs of the maps, one after the other, into one file.
pub fn record(
    path: &Path,
    level: Level,
    maps: &[&str],
    world: World2d,
    max_steps: u64,
) -> Vec<Vec<Duration>> {
    let recording = Recording::create(options(path, level, maps, &world)).expect("a new file");
    let world = Arc::new(world);
    let mut metrics = serde_json::Map::new();
    let mut times = Vec::new();
    for kind in maps {
        let mut recorder = recording.recorder(kind);
        let (report, witness, of_map) = explore(&mut recorder, kind, &world, max_steps);
        recorder.send().expect("rows fit together");
        times.push(of_map);
        let verdict = witness.verdict(report.ending == Some(explore::Ending::Complete));
        metrics.insert(
            (*kind).to_owned(),
            serde_json::json!({
                "believed_complete": verdict.believed_complete,
                "coverage": verdict.coverage,
                "distance_m": verdict.distance_m,
            }),
        );
    }
    recording.finish(&serde_json::json!({ "name": "example", "maps": metrics })).expect("a disk");
    times
}
