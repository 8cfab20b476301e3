//! One experiment over axes and seeds.

use std::path::PathBuf;

use serde::Serialize;

use super::job::{Job, Outcome, Plan};
use super::prepared::Prepared;
use crate::config::{ConfigError, Loaded, Place};
use crate::run::{GIT_HASH, Input, RunError, VERSION};
use crate::table::{Cell, Row};

/// More runs than that are a mistake.
const MOST_RUNS: usize = 1_000_000;

/// Why a run of a sweep failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunFailure {
    /// Its config or its map file is bad.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// It could not be run or recorded.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// One experiment over axes and seeds, ready to run.
pub(crate) struct Experiments {
    /// Its jobs: every combination of the axes' values with every seed.
    pub(crate) plan: Plan,
    /// Every map file of any combination, and the config.
    pub(crate) inputs: Vec<Input>,
    /// What the readers of the map files let pass.
    pub(crate) warnings: Vec<String>,
    /// The config of each combination, without its seed.
    combinations: Vec<Loaded>,
    seeds: u64,
    first_seed: u64,
    record: Option<PathBuf>,
}

impl Experiments {
    /// Checks every combination; recordings go into the folder `record`, if there is one.
    ///
    /// # Errors
    /// A config without axes to sweep, and the first combination that cannot be run, at the line
    /// of its axis.
    pub(crate) fn new(loaded: &Loaded, record: Option<PathBuf>) -> Result<Self, ConfigError> {
        let Some(sweep) = &loaded.config.sweep else {
            return Err(ConfigError::Value {
                place: Place::file(&loaded.path),
                found: "no [sweep]".into(),
                expected: "a table [sweep] with seeds and axes".into(),
            });
        };
        let last = loaded.config.seed.checked_add(sweep.seeds.saturating_sub(1));
        if last.is_none_or(|last| i64::try_from(last).is_err()) {
            return Err(ConfigError::Value {
                place: loaded.place("sweep.seeds"),
                found: format!("{} seeds from {} on", sweep.seeds, loaded.config.seed),
                expected: format!("seeds up to {}", i64::MAX),
            });
        }
        let counts = sweep.axes.iter().map(|(_, values)| values.len());
        let runs = counts
            .chain(std::iter::once(usize::try_from(sweep.seeds).unwrap_or(usize::MAX)))
            .try_fold(1_usize, usize::checked_mul)
            .filter(|&runs| runs <= MOST_RUNS);
        if runs.is_none() {
            return Err(ConfigError::Value {
                place: loaded.place("sweep"),
                found: "too many combinations".into(),
                expected: format!("at most {MOST_RUNS} runs"),
            });
        }

        let mut combinations = vec![(Row::new(), Vec::new())];
        for (path, values) in sweep.axes.iter() {
            let longer = |(labels, sets): &(Row, Vec<String>)| {
                let more = |value: &toml::Value| {
                    let label = (path.to_owned(), Cell::from_toml(value));
                    let set = format!("{path} = {value}");
                    let labels: Row = labels.iter().cloned().chain([label]).collect();
                    (labels, sets.iter().cloned().chain([set]).collect())
                };
                values.iter().map(more).collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(longer).collect();
        }

        let (seeds, first_seed) = (sweep.seeds, loaded.config.seed);
        let mut all = Self {
            plan: Plan { name: loaded.config.name.clone(), identity: String::new(), jobs: vec![] },
            inputs: vec![Input::new(&loaded.path, loaded.text().as_bytes())],
            warnings: Vec::new(),
            combinations: Vec::new(),
            seeds,
            first_seed,
            record,
        };
        for (labels, sets) in combinations {
            let combination = loaded.with(&sets)?;
            // A place that cannot be built is told now, not after hours.
            let prepared = Prepared::new(&combination);
            let prepared = prepared.map_err(|error| loaded.at_axis(error, &sets))?;
            let (inputs, warnings) = prepared.into_notes();
            all.note(inputs, warnings);
            for seed in 0..seeds {
                let seed = first_seed.saturating_add(seed);
                let labels = labels.iter().cloned().chain([("seed".to_owned(), seed.into())]);
                let number = all.plan.jobs.len();
                all.plan.jobs.push(Job { number, labels: labels.collect() });
            }
            all.combinations.push(combination);
        }
        let config = format!("{:?}", loaded.config);
        let mut parts = vec![config.as_str()];
        parts.extend(all.inputs.iter().skip(1).map(|input| input.sha256.as_str()));
        all.plan.identity = Plan::identity(&parts);
        Ok(all)
    }

    fn note(&mut self, inputs: Vec<Input>, warnings: Vec<String>) {
        for input in inputs {
            if !self.inputs.contains(&input) {
                self.inputs.push(input);
            }
        }
        for warning in warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
    }

    /// Does one job of the plan: one robot after the other.
    ///
    /// # Errors
    /// A map file that has changed meanwhile, or a recording that cannot be written.
    pub(crate) fn run(&self, job: &Job) -> Result<Outcome, RunFailure> {
        let seeds = self.seeds.max(1) as usize;
        let (combination, seed) = (job.number / seeds, job.number % seeds);
        let Some(loaded) = self.combinations.get(combination) else {
            return Ok(Outcome::default());
        };
        let seed = self.first_seed.saturating_add(seed as u64);
        let loaded = loaded.with(&[format!("seed = {seed}")])?;
        let prepared = Prepared::new(&loaded)?;
        let file = self.record.as_ref().filter(|_| prepared.records());
        let file = file.map(|folder| folder.join(format!("{:05}.rrd", job.number)));
        Ok(prepared.run(file.as_deref(), loaded.header())?)
    }

    /// The text of the sweep's `provenance.toml`.
    pub(crate) fn provenance(&self) -> Result<String, toml::ser::Error> {
        #[derive(Serialize)]
        struct Provenance<'a> {
            version: &'static str,
            git_hash: &'static str,
            identity: &'a str,
            seeds: [u64; 2],
            runs: usize,
            inputs: &'a [Input],
        }
        toml::to_string(&Provenance {
            version: VERSION,
            git_hash: GIT_HASH,
            identity: &self.plan.identity,
            seeds: [self.first_seed, self.first_seed.saturating_add(self.seeds.saturating_sub(1))],
            runs: self.plan.jobs.len(),
            inputs: &self.inputs,
        })
    }
}
