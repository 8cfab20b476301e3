//! The whole run: every robot in turn, then the reports.

use std::path::Path;
use std::time::Instant;

use instrument::{InstrumentError, Recorder};

use super::{
    Disagreement, Experiment, Exporting, Fan, Input, MapRun, MetricsReport, Provenance, StepRow,
    TimingReport, drive, report, start_recording, to_parquet,
};
use crate::export::{ExportError, ExportFolder};
use crate::table::TableError;

/// What came of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// `metrics.json`.
    pub metrics: MetricsReport,
    /// `timing.json`.
    pub timing: TimingReport,
    /// The rows of `steps.parquet`.
    pub rows: Vec<StepRow>,
}

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] InstrumentError),
    /// The export cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A map of space cannot be made.
    #[error(transparent)]
    Map(#[from] maps3d::Maps3dError),
    /// The robot cannot be put into its place.
    #[error(transparent)]
    World(#[from] worlds::WorldError),
    /// A report cannot be put into its form.
    #[error(transparent)]
    Report(#[from] serde_json::Error),
    /// The table of steps cannot be made.
    #[error("steps.parquet: {0}")]
    Steps(#[from] TableError),
    /// The config or the provenance cannot be put into its form.
    #[error(transparent)]
    Toml(#[from] toml::ser::Error),
}

impl From<std::convert::Infallible> for RunError {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

/// Runs every robot of an experiment, one after the other, and records them to `recording`; each leaves its
/// log in `export`, by the name of the map that steers it.
///
/// `on_step` is told of every step. The outcome but for the timing follows from the experiment
/// alone.
///
/// # Errors
/// [`RunError::Recording`], [`RunError::Export`].
pub fn run_experiment(
    experiment: &Experiment,
    recording: &Path,
    export: Option<&mut ExportFolder>,
    about: &str,
    on_step: &mut dyn FnMut(&StepRow),
) -> Result<Outcome, RunError> {
    let started = Instant::now();
    let recording = start_recording(experiment, recording, about)?;
    let mut runs: Vec<MapRun> = Vec::new();
    let mut export = export;
    for kinds in experiment.robots() {
        let Experiment { config, place, coverage } = experiment;
        let recorders = Fan::new(kinds.iter().map(|kind| recording.recorder(kind)).collect());
        let robot = kinds.first().copied().unwrap_or_default();
        let exports = export.as_deref().map(|folder| folder.robot(robot, config.edge_noise()));
        let mut watch = Exporting::new(recorders, exports.transpose()?, &kinds);
        runs.extend(drive(config, &place.world, coverage, &kinds, &mut watch, on_step)?);
        let (recorders, exports) = watch.into_parts();
        if let Some((folder, exports)) = export.as_deref_mut().zip(exports) {
            folder.take(exports)?;
        }
        recorders.into_watchers().iter_mut().try_for_each(Recorder::send)?;
    }
    let disagreements: Vec<Disagreement> = runs
        .iter()
        .map(|run| &run.disagreements)
        .find(|disagreements| !disagreements.is_empty())
        .cloned()
        .unwrap_or_default();
    let mut outcome = Outcome {
        metrics: MetricsReport {
            name: experiment.config.name.clone(),
            seed: experiment.config.seed,
            maps: runs.iter().map(|run| (run.name.to_owned(), run.metrics.clone())).collect(),
            disagreement: disagreements.first().cloned(),
            disagreements,
        },
        timing: TimingReport {
            maps: runs.iter().map(|run| (run.name.to_owned(), run.timing.clone())).collect(),
            wall_secs: 0.0,
        },
        rows: runs.into_iter().flat_map(|run| run.rows).collect(),
    };
    recording.finish(&report::to_json(&outcome.metrics)?)?;
    outcome.timing.wall_secs = started.elapsed().as_secs_f64();
    Ok(outcome)
}

/// The files of a run but for its recording: name and content.
///
/// # Errors
/// Where a report cannot be put into its form.
pub fn files(
    experiment: &Experiment,
    outcome: &Outcome,
    config_input: Input,
) -> Result<Vec<(&'static str, Vec<u8>)>, RunError> {
    use super::names;
    let ended = outcome.metrics.maps.iter();
    let mut inputs = vec![config_input];
    inputs.extend(experiment.place.inputs.iter().cloned());
    let ended = ended.map(|(name, map)| (name.clone(), map.termination.clone()));
    let provenance = Provenance::of(experiment.config.seed, ended, inputs);
    Ok(vec![
        (names::CONFIG, crate::config::plain_toml(&experiment.config)?.into_bytes()),
        (names::STEPS, to_parquet(&outcome.rows)?),
        (names::TIMING, report::to_file(&outcome.timing)?),
        (names::PROVENANCE, provenance.to_toml()?.into_bytes()),
        // Last, as the sign that all the others are there.
        (names::METRICS, report::to_file(&outcome.metrics)?),
    ])
}
