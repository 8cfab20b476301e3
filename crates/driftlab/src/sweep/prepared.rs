//! One combination of a sweep, of the plane or of space, ready to run.

use std::path::Path;

use probe::Off;
use serde::Serialize;
use serde_json::Value;

use super::curve::{Passed, curve};
use super::job::Outcome;
use crate::config::{Config, ConfigError, Level, Loaded};
use crate::flight::{FlightExperiment, FlightRun, fly, run_flight};
use crate::run::{Experiment, Input, MapRun, RunError, drive, run_experiment, to_json};
use crate::table::{Cell, Row};

/// An experiment, whatever moves in it.
pub(super) enum Prepared {
    /// A robot that drives.
    Plane(Box<Experiment>),
    /// A robot that flies.
    Space(Box<FlightExperiment>),
}

impl Prepared {
    /// Reads the files and builds the place.
    ///
    /// # Errors
    /// [`ConfigError`] with the line of the config.
    pub(super) fn new(loaded: &Loaded) -> Result<Self, ConfigError> {
        Ok(match loaded.config.is_of_space() {
            true => Self::Space(Box::new(FlightExperiment::prepare(loaded)?)),
            false => Self::Plane(Box::new(Experiment::prepare(loaded)?)),
        })
    }

    fn config(&self) -> &Config {
        match self {
            Self::Plane(experiment) => &experiment.config,
            Self::Space(experiment) => &experiment.config,
        }
    }

    /// Whether its config asks for a recording.
    pub(super) fn records(&self) -> bool {
        self.config().record.level != Level::Off
    }

    /// The files that it was read from, and what their readers let pass.
    pub(super) fn into_notes(self) -> (Vec<Input>, Vec<String>) {
        match self {
            Self::Plane(experiment) => (experiment.place.inputs, experiment.place.warnings),
            Self::Space(experiment) => (experiment.place.inputs, experiment.place.warnings),
        }
    }

    /// Runs one robot after the other, recorded to `file` if there is one.
    ///
    /// # Errors
    /// A recording that cannot be written, or a map that cannot be made.
    pub(super) fn run(&self, file: Option<&Path>, about: &str) -> Result<Outcome, RunError> {
        let mut all = Outcome::default();
        match (self, file) {
            (Self::Plane(experiment), Some(file)) => {
                let outcome = run_experiment(experiment, file, None, about, &mut |_| ())?;
                let maps = outcome.metrics.maps.iter().zip(&outcome.timing.maps);
                for ((name, metrics), (_, timing)) in maps {
                    let own = outcome.rows.iter().filter(|row| row.map == *name).map(Passed::from);
                    all.add(name, metrics, timing, own)?;
                }
            }
            (Self::Plane(experiment), None) => {
                for MapRun { name, metrics, timing, rows, .. } in unrecorded(experiment) {
                    all.add(name, &metrics, &timing, rows.iter().map(Passed::from))?;
                }
            }
            (Self::Space(experiment), Some(file)) => {
                let outcome = run_flight(experiment, file, about, &mut |_| ())?;
                let maps = outcome.metrics.maps.iter().zip(&outcome.timing.maps);
                for ((name, metrics), (_, timing)) in maps {
                    let own = outcome.rows.iter().filter(|row| row.map == *name).map(Passed::from);
                    all.add(name, metrics, timing, own)?;
                }
            }
            (Self::Space(experiment), None) => {
                for kinds in experiment.robots() {
                    for run in fly(experiment, &kinds, &mut Off, &mut |_| ())? {
                        let FlightRun { name, metrics, timing, rows } = run;
                        all.add(name, &metrics, &timing, rows.iter().map(Passed::from))?;
                    }
                }
            }
        }
        Ok(all)
    }
}

/// Every robot of an experiment in turn, with nobody watching.
fn unrecorded(experiment: &Experiment) -> Vec<MapRun> {
    let Experiment { config, place, coverage } = experiment;
    let mut runs = Vec::new();
    for kinds in experiment.robots() {
        match drive(config, &place.world, coverage, &kinds, &mut Off, &mut |_| ()) {
            Ok(own) => runs.extend(own),
            Err(never) => match never {},
        }
    }
    runs
}

impl Outcome {
    /// Adds what came of one map.
    fn add(
        &mut self,
        name: &str,
        metrics: &impl Serialize,
        timing: &impl Serialize,
        steps: impl Iterator<Item = Passed>,
    ) -> Result<(), RunError> {
        self.results.push(row_of(name, metrics)?);
        self.timing.push(row_of(name, timing)?);
        self.curves.extend(curve(name, &steps.collect::<Vec<_>>()));
        Ok(())
    }
}

/// The name of a map and its numbers; tables inside become dotted names.
fn row_of(map: &str, numbers: &impl Serialize) -> Result<Row, RunError> {
    let mut row = vec![("map".to_owned(), map.into())];
    flatten(&to_json(numbers)?, "", &mut row);
    Ok(row)
}

fn flatten(value: &Value, path: &str, row: &mut Row) {
    match value {
        Value::Object(inner) => {
            for (key, value) in inner {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                flatten(value, &path, row);
            }
        }
        // Lists are for single runs.
        Value::Array(_) => {}
        plain => row.push((path.to_owned(), Cell::from_json(plain))),
    }
}
