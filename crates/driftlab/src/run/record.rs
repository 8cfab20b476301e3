//! The recording of a run.

use std::path::Path;

use geometry::Point2;
use instrument::{
    Every, Family, InstrumentError, Level, MapOptions, Quarrel, Recorder, Recording,
    RecordingOptions, StepEnd,
};
use metrics::Coverage;
use worlds::World2d;

use super::{Experiment, RunError, StepSeen, Watch};
use crate::config::{self, plain_toml};

/// Starts the recording of an experiment; at level `off` no file is made.
///
/// `about` is what the text page says first.
///
/// # Errors
/// Where the file cannot be created.
pub fn start_recording(
    experiment: &Experiment,
    path: &Path,
    about: &str,
) -> Result<Recording, RunError> {
    let config = &experiment.config;
    let scope_m = config.map.relative.as_ref().map_or(0.0, |map| map.consolidation_radius_m);
    Ok(Recording::create(RecordingOptions {
        path: path.to_owned(),
        name: config.name.clone(),
        level: level_of(config.record.level),
        every: every_of(&config.record.every),
        maps: experiment.robots().iter().flatten().map(|kind| MapOptions::of_kind(kind)).collect(),
        about: about.to_owned(),
        config: plain_toml(config)?,
        bounds_in_world: experiment.place.world.bounds(),
        follow: false,
        sight_m: scope_m.min(20.0) + config.sensor.range_m,
    })?)
}

/// How much a config asks to be recorded.
pub(crate) fn level_of(level: config::Level) -> Level {
    match level {
        config::Level::Off => Level::Off,
        config::Level::Summary => Level::Summary,
        config::Level::Full => Level::Full,
    }
}

/// Which steps of which family a config asks to be recorded.
pub(crate) fn every_of(every: &config::Every) -> Every {
    let config::Every {
        sensing,
        pose_graph,
        consolidation,
        grid,
        planner,
        correction,
        polygons,
        tetrahedra,
        truth,
    } = *every;
    Every::STEP
        .with(Family::Sensing, sensing)
        .with(Family::PoseGraph, pose_graph)
        .with(Family::Consolidation, consolidation)
        .with(Family::Grid, grid)
        .with(Family::Planner, planner)
        .with(Family::Correction, correction)
        .with(Family::Polygons, polygons)
        .with(Family::Tetrahedra, tetrahedra)
        .with(Family::Truth, truth)
}

impl Watch for Recorder {
    type Error = InstrumentError;

    fn place(&mut self, world: &World2d, coverage: &Coverage) -> Result<(), InstrumentError> {
        Recorder::place(self, world, coverage)
    }

    fn step_begins(&mut self, step: u64, distance_m: f64, sim_time_secs: f64) {
        self.begin_step(step, distance_m, sim_time_secs);
    }

    fn step_ends(&mut self, end: &StepSeen<'_>) -> Result<(), InstrumentError> {
        let Some(row) = end.rows.first() else { return Ok(()) };
        if let Some(found) = end.disagreement {
            let quarrel = Quarrel {
                at_in_world: Point2::new(found.frontier_x_m, found.frontier_y_m),
                at_in_body: found.frontier_in_body,
                label: found.label(),
                text: &found.in_words(),
            };
            self.disagreed(&end.report.standing, &quarrel);
        }
        let drift_m = (row.world_from_body.translation - row.odom_from_body.translation).norm();
        self.end_step(&StepEnd {
            standing: end.report.standing,
            distance_m: row.distance_m,
            sim_time_secs: row.sim_time_secs,
            witness: Some(end.witness),
            newly_seen: end.newly_seen,
            numbers: &[
                ("coverage", row.coverage),
                ("frontier_open_m", row.frontier_open_m),
                ("frontier_ignored_m", row.frontier_ignored_m),
                ("odometry_error_m", drift_m),
            ],
        })
    }
}
