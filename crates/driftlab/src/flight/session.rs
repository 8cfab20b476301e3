//! The whole flight: every robot in turn, then the reports.

use std::path::Path;
use std::time::Instant;

use instrument::FlightRecorder;

use super::{
    FlightExperiment, FlightMetrics, FlightRow, FlightRun, FlightTiming, flight_parquet, fly,
    start_flight_recording,
};
use crate::config::plain_toml;
use crate::run::{
    Fan, Input, MapsMetrics, MapsTiming, Provenance, RunError, names, to_file, to_json,
};

/// What came of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightOutcome {
    /// `metrics.json`.
    pub metrics: MapsMetrics<FlightMetrics>,
    /// `timing.json`.
    pub timing: MapsTiming<FlightTiming>,
    /// The rows of `steps.parquet`.
    pub rows: Vec<FlightRow>,
}

/// Flies every robot of an experiment, one after the other, and records them to `recording`.
///
/// `on_step` is told of every step. The outcome but for the timing follows from the experiment alone.
///
/// # Errors
/// [`RunError::Recording`], and a map whose parameters do not go together.
pub fn run_flight(
    experiment: &FlightExperiment,
    recording: &Path,
    about: &str,
    on_step: &mut dyn FnMut(&FlightRow),
) -> Result<FlightOutcome, RunError> {
    let started = Instant::now();
    let recording = start_flight_recording(experiment, recording, about)?;
    let mut runs: Vec<FlightRun> = Vec::new();
    for kinds in experiment.robots() {
        let mut recorders = Fan::new(kinds.iter().map(|kind| recording.recorder(kind)).collect());
        runs.extend(fly(experiment, &kinds, &mut recorders, on_step)?);
        recorders.into_watchers().iter_mut().try_for_each(FlightRecorder::send)?;
    }
    let mut outcome = FlightOutcome {
        metrics: MapsMetrics {
            name: experiment.config.name.clone(),
            seed: experiment.config.seed,
            maps: runs.iter().map(|run| (run.name.to_owned(), run.metrics.clone())).collect(),
            disagreement: None,
            disagreements: Vec::new(),
        },
        timing: MapsTiming {
            maps: runs.iter().map(|run| (run.name.to_owned(), run.timing.clone())).collect(),
            wall_secs: 0.0,
        },
        rows: runs.into_iter().flat_map(|run| run.rows).collect(),
    };
    recording.finish(&to_json(&outcome.metrics)?)?;
    outcome.timing.wall_secs = started.elapsed().as_secs_f64();
    Ok(outcome)
}

/// The files of a flight but for its recording: name and content.
///
/// # Errors
/// Where a report cannot be put into its form.
pub fn flight_files(
    experiment: &FlightExperiment,
    outcome: &FlightOutcome,
    config_input: Input,
) -> Result<Vec<(&'static str, Vec<u8>)>, RunError> {
    let mut inputs = vec![config_input];
    inputs.extend(experiment.place.inputs.iter().cloned());
    let ended = outcome.metrics.maps.iter();
    let ended = ended.map(|(name, map)| (name.clone(), map.termination.clone()));
    let provenance = Provenance::of(experiment.config.seed, ended, inputs);
    Ok(vec![
        (names::CONFIG, plain_toml(&experiment.config)?.into_bytes()),
        (names::STEPS, flight_parquet(&outcome.rows)?),
        (names::TIMING, to_file(&outcome.timing)?),
        (names::PROVENANCE, provenance.to_toml()?.into_bytes()),
        // Last, as the sign that all the others are there.
        (names::METRICS, to_file(&outcome.metrics)?),
    ])
}
