//! `driftlab run` for a robot that flies.

use std::fs;
use std::path::Path;

use anyhow::anyhow;
use serde_json::json;

use super::super::args::RunArgs;
use super::super::failure::Failure;
use super::super::out::Out;
use super::super::table::table;
use super::{Bars, wrote};
use crate::config::Loaded;
use crate::flight::{FlightExperiment, FlightOutcome, flight_files, run_flight};
use crate::run::{Input, RunFolder, to_json};

/// Runs the flight of a config into `dir`.
pub(super) fn run(args: &RunArgs, loaded: &Loaded, dir: &Path, out: &Out) -> Result<(), Failure> {
    if args.export.is_some() {
        let hint = "expected a config with [world]";
        return Err(Failure::Input(anyhow!("--export writes no flights through space; {hint}")));
    }
    let experiment = FlightExperiment::prepare(loaded)?;
    for warning in &experiment.place.warnings {
        out.note(&format!("warning: {warning}"));
    }
    let bytes = fs::read(&loaded.path).map_err(Failure::work)?;
    let config_input = Input::new(&loaded.path, &bytes);
    let [x, y, z] = experiment.coverage.size();
    out.detail(&format!(
        "{}: {} triangles, {x} x {y} x {z} voxels, {} of them to be seen",
        experiment.place.world.name(),
        experiment.place.world.triangles().len(),
        experiment.coverage.cells_counted()
    ));

    let mut folder = RunFolder::create(dir, args.force)?;
    let recording = args.record.clone().unwrap_or_else(|| folder.recording());
    let mut bars = Bars::new(out);
    let outcome = run_flight(&experiment, &recording, loaded.header(), &mut |row| {
        bars.show(&row.map, row.coverage, || {
            format!(
                "seen, step {}, {:.0} m, {:.1} m² of frontier open",
                row.step, row.distance_m, row.frontier_open_m2
            )
        });
    });
    bars.clear();
    let outcome = outcome.map_err(Failure::work)?;
    let files = flight_files(&experiment, &outcome, config_input).map_err(Failure::work)?;
    for (name, content) in files {
        folder.write(name, &content)?;
    }
    folder.finish()?;
    report(dir, &outcome, out)?;
    wrote(dir, None, args.record.as_deref(), experiment.config.record.level, out);
    Ok(())
}

/// Says of every map whose robot ended otherwise than by itself how that was.
fn note_endings(outcome: &FlightOutcome, out: &Out) {
    for (name, map) in &outcome.metrics.maps {
        let why = match map.termination.as_str() {
            "left_the_place" => {
                "the robot flew out of the bounds of the place: its mesh has a hole"
            }
            "step_limit" => "the robot came to max_steps first",
            _ => continue,
        };
        out.note(&format!("warning: {name}: {why}"));
    }
}

fn report(dir: &Path, outcome: &FlightOutcome, out: &Out) -> Result<(), Failure> {
    note_endings(outcome, out);
    let metrics = to_json(&outcome.metrics).map_err(Failure::work)?;
    let timing = to_json(&outcome.timing).map_err(Failure::work)?;
    let header = [
        "map",
        "believed complete",
        "coverage",
        "distance m",
        "looks",
        "collisions",
        "frontier left m²",
        "ignored m²",
        "ms/look median",
        "KiB/look",
    ];
    let maps = outcome.metrics.maps.iter().zip(&outcome.timing.maps);
    let rows: Vec<Vec<String>> = maps
        .map(|((name, map), (_, timing))| {
            vec![
                name.clone(),
                if map.believed_complete { "yes" } else { "no" }.to_owned(),
                format!("{:.4}", map.coverage),
                format!("{:.1}", map.distance_m),
                map.looks.to_string(),
                map.collisions.to_string(),
                format!("{:.2}", map.frontier_left_m2),
                format!("{:.2}", map.frontier_ignored_m2),
                format!("{:.1}", timing.look_micros_median / 1e3),
                format!("{:.0}", timing.map_bytes_per_look / 1024.0),
            ]
        })
        .collect();
    let json = json!({ "dir": dir.display().to_string(), "metrics": metrics, "timing": timing });
    out.summary(&json, &table(&header, &rows, 1))
}
