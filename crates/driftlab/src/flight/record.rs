//! The recording of a flight.

use std::path::Path;

use geometry::Point3;
use instrument::{FlightOptions, FlightRecorder, FlightRecording, FlightStep, InstrumentError};
use metrics::VoxelCoverage;
use worlds::World3d;

use super::{FlightExperiment, FlightSeen, FlightWatch};
use crate::config::{Config, plain_toml};
use crate::run::{RunError, every_of, level_of};

/// Starts the recording of a flight; at level `off` no file is made.
///
/// `about` is what the text page says first.
///
/// # Errors
/// Where the file cannot be created.
pub fn start_flight_recording(
    experiment: &FlightExperiment,
    path: &Path,
    about: &str,
) -> Result<FlightRecording, RunError> {
    let bounds_in_world = experiment.place.world.bounds();
    create_recording(&experiment.config, path, about, bounds_in_world, true)
}

/// Creates a recording of the maps of space of a config, for a simulator that knows the truth or for a log
/// that does not.
///
/// # Errors
/// Where the file cannot be created.
pub(crate) fn create_recording(
    config: &Config,
    path: &Path,
    about: &str,
    bounds_in_world: (Point3, Point3),
    has_truth: bool,
) -> Result<FlightRecording, RunError> {
    Ok(FlightRecording::create(FlightOptions {
        path: path.to_owned(),
        name: config.name.clone(),
        level: level_of(config.record.level),
        every: every_of(&config.record.every),
        maps: config.map_keys().into_iter().map(str::to_owned).collect(),
        about: about.to_owned(),
        config: plain_toml(config)?,
        bounds_in_world,
        has_truth,
    })?)
}

impl FlightWatch for FlightRecorder {
    type Error = InstrumentError;

    fn place(&mut self, world: &World3d, coverage: &VoxelCoverage) -> Result<(), InstrumentError> {
        FlightRecorder::place(self, world, coverage)
    }

    fn step_begins(&mut self, step: u64, distance_m: f64) {
        self.begin_step(step, distance_m);
    }

    fn step_ends(&mut self, end: &FlightSeen<'_>) -> Result<(), InstrumentError> {
        let Some(row) = end.rows.first() else { return Ok(()) };
        let drift_m = (row.world_from_body.translation - row.odom_from_body.translation).norm();
        self.end_step(&FlightStep {
            hovering: end.report.hovering,
            odom_from_body: end.report.odom_from_body,
            distance_m: row.distance_m,
            witness: Some(end.witness),
            newly_seen: end.newly_seen,
            numbers: &[
                ("coverage", row.coverage),
                ("frontier_open_m2", row.frontier_open_m2),
                ("frontier_ignored_m2", row.frontier_ignored_m2),
                ("map_faces", row.map_faces as f64),
                ("odometry_error_m", drift_m),
            ],
        })
    }
}
