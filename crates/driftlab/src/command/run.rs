//! `driftlab run`: one experiment.

mod flight;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use serde_json::json;

use super::args::RunArgs;
use super::config::load;
use super::failure::Failure;
use super::out::Out;
use super::progress::Bar;
use super::table::table;
use crate::config::{Level, Loaded};
use crate::export::ExportFolder;
use crate::run::{
    Experiment, Input, Outcome, RunFolder, StepRow, files, names, run_experiment, to_json,
};

pub(super) fn run(args: &RunArgs, out: &Out) -> Result<(), Failure> {
    let loaded = load(&args.input, out)?;
    if loaded.config.sweep.is_some() {
        out.note("note: one run alone; `driftlab sweep` runs what [sweep] asks for");
    }
    let dir = out_dir(args, &loaded);
    RunFolder::check(&dir, args.force)?;
    check_recording(args.record.as_deref(), args.force, loaded.config.record.level)?;
    if loaded.config.is_of_space() {
        return flight::run(args, &loaded, &dir, out);
    }
    let experiment = Experiment::prepare(&loaded)?;
    for warning in &experiment.place.warnings {
        out.note(&format!("warning: {warning}"));
    }
    if let Some(folder) = &args.export {
        let robots = experiment.robots();
        let names: Vec<&str> = robots.iter().filter_map(|kinds| kinds.first().copied()).collect();
        ExportFolder::check(folder, &names, args.force)
            .map_err(|error| Failure::Input(error.into()))?;
    }
    let bytes = fs::read(&loaded.path).map_err(Failure::work)?;
    let config_input = Input::new(&loaded.path, &bytes);
    let (columns, rows) = experiment.coverage.size();
    out.detail(&format!(
        "{}: {columns} x {rows} cells, {} of them to be seen",
        experiment.place.world.name(),
        experiment.coverage.cells_reachable()
    ));

    let mut folder = RunFolder::create(&dir, args.force)?;
    let recording = args.record.clone().unwrap_or_else(|| folder.recording());
    let export = args.export.as_deref().map(ExportFolder::create);
    let mut export = export.transpose().map_err(|error| Failure::Input(error.into()))?;
    let mut bars = Bars::new(out);
    let (about, sink) = (loaded.header(), export.as_mut());
    let outcome = run_experiment(&experiment, &recording, sink, about, &mut |row| {
        bars.step(row);
    });
    bars.clear();
    let outcome = outcome.map_err(Failure::work)?;
    for (name, content) in files(&experiment, &outcome, config_input).map_err(Failure::work)? {
        folder.write(name, &content)?;
    }
    folder.finish()?;
    if let Some(export) = export {
        export.finish().map_err(Failure::work)?;
    }

    report(&dir, &outcome, out)?;
    let (export, record) = (args.export.as_deref(), args.record.as_deref());
    wrote(&dir, export, record, experiment.config.record.level, out);
    Ok(())
}

/// Where the results go.
fn out_dir(args: &RunArgs, loaded: &Loaded) -> PathBuf {
    let default = || PathBuf::from("recordings").join(&loaded.config.name);
    args.out.clone().unwrap_or_else(default)
}

/// Says where the results are, and how to look at them.
pub(super) fn wrote(
    dir: &Path,
    export: Option<&Path>,
    record: Option<&Path>,
    level: Level,
    out: &Out,
) {
    for folder in [Some(dir), export].into_iter().flatten() {
        out.note(&format!("wrote {}", folder.display()));
    }
    if level != Level::Off {
        let shown = record.map_or_else(|| dir.join(names::RECORDING), Path::to_owned);
        out.note(&format!("step through it with: driftlab view {}", shown.display()));
    }
}

/// A recording somewhere else must not hit a file that is there already.
pub(super) fn check_recording(
    record: Option<&Path>,
    force: bool,
    level: Level,
) -> Result<(), Failure> {
    let Some(file) = record else { return Ok(()) };
    if level == Level::Off {
        let hint = "expected record.level \"summary\" or \"full\" with --record";
        return Err(Failure::Input(anyhow!("record.level is \"off\"; {hint}")));
    }
    if file.is_dir() || (file.exists() && !force) {
        let hint = "name another file, or --force to replace it";
        return Err(Failure::Input(anyhow!("{}: is there already; {hint}", file.display())));
    }
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.is_dir() => {
            Err(Failure::Input(anyhow!("{}: no such folder", folder.display())))
        }
        _ => Ok(()),
    }
}

fn report(dir: &Path, outcome: &Outcome, out: &Out) -> Result<(), Failure> {
    let metrics = to_json(&outcome.metrics).map_err(Failure::work)?;
    let timing = to_json(&outcome.timing).map_err(Failure::work)?;
    let header = [
        "map",
        "believed complete",
        "really complete",
        "coverage",
        "cells seen",
        "distance m",
        "d_exp m",
        "steps",
        "µs/step median",
        "p99",
    ];
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let rows: Vec<Vec<String>> = outcome
        .metrics
        .maps
        .iter()
        .zip(&outcome.timing.maps)
        .map(|((name, map), (_, timing))| {
            vec![
                name.clone(),
                yes(map.believed_complete),
                yes(map.coverage == 1.0),
                format!("{:.4}", map.coverage),
                format!(
                    "{:.0} of {}",
                    map.coverage * map.cells_reachable as f64,
                    map.cells_reachable
                ),
                format!("{:.1}", map.distance_m),
                map.d_exp_m.map_or_else(|| "-".to_owned(), |d_exp_m| format!("{d_exp_m:.1}")),
                map.steps.to_string(),
                format!("{:.0}", timing.step_micros_median),
                format!("{:.0}", timing.step_micros_p99),
            ]
        })
        .collect();
    let json = json!({ "dir": dir.display().to_string(), "metrics": metrics, "timing": timing });
    out.summary(&json, &table(&header, &rows, 1))
}

/// One bar after the other, for the robot that is on its way.
struct Bars<'a> {
    out: &'a Out,
    current: Option<(String, Bar)>,
}

impl<'a> Bars<'a> {
    fn new(out: &'a Out) -> Self {
        Self { out, current: None }
    }

    fn step(&mut self, row: &StepRow) {
        self.show(&row.map, row.coverage, || {
            format!(
                "seen, step {}, {:.0} m, {:.1} m of frontier open",
                row.step, row.distance_m, row.frontier_open_m
            )
        });
    }

    /// Shows how far the robot of a map has come.
    fn show(&mut self, map: &str, coverage: f64, words: impl Fn() -> String) {
        if self.current.as_ref().is_none_or(|(current, _)| current != map) {
            self.clear();
            self.current = Some((map.to_owned(), Bar::new(map, self.out)));
        }
        if let Some((_, bar)) = &mut self.current {
            bar.update(coverage, words);
        }
    }

    fn clear(&mut self) {
        if let Some((_, bar)) = self.current.take() {
            bar.clear();
        }
    }
}
