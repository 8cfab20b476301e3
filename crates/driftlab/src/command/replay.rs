//! `driftlab replay`: the maps of a config, fed by a log.

mod depth;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use formats::laser::relations;
use serde_json::json;

use super::args::ReplayArgs;
use super::config::load;
use super::failure::Failure;
use super::out::Out;
use super::progress::Bar;
use super::run::{check_recording, wrote};
use super::table::table;
use crate::config::{ConfigError, Loaded, Poses};
use crate::replay::{
    Asked, Log, PlanarLog, Replayed, files, read_matches, replay as replay_log,
    start_replay_recording, unmatched, unrelated,
};
use crate::run::{Input, RunFolder, to_json};

pub(super) fn replay(args: &ReplayArgs, out: &Out) -> Result<(), Failure> {
    let loaded = load(&args.input(), out)?;
    check(&loaded)?;
    let default = || PathBuf::from("recordings").join(&loaded.config.name);
    let dir = args.out.clone().unwrap_or_else(default);
    RunFolder::check(&dir, args.force)?;
    check_recording(args.record.as_deref(), args.force, loaded.config.record.level)?;
    let topic = args.places.as_deref().and_then(topic_of);
    match Log::open(&args.log, &loaded.config, topic)? {
        Log::Planar(log) => planar(args, &loaded, &log, &dir, out),
        Log::Depth(mut frames) => depth::replay(args, &loaded, &mut frames, &dir, out),
    }
}

/// A name that starts as a topic's and is no file.
fn topic_of(places: &Path) -> Option<&str> {
    places.to_str().filter(|name| name.starts_with('/') && !places.exists())
}

/// What a simulator alone can give is refused.
fn check(loaded: &Loaded) -> Result<(), Failure> {
    if loaded.config.map.grid.as_ref().is_some_and(|grid| grid.poses == Poses::True) {
        return Err(Failure::from(ConfigError::Value {
            place: loaded.place("map.grid.poses"),
            found: "\"true\" for `map.grid.poses`".into(),
            expected: "\"odometry\": a log does not know the truth".into(),
        }));
    }
    Ok(())
}

fn planar(
    args: &ReplayArgs,
    loaded: &Loaded,
    log: &PlanarLog,
    dir: &Path,
    out: &Out,
) -> Result<(), Failure> {
    for warning in &log.warnings {
        out.note(&format!("warning: {}: {warning}", args.log.display()));
    }
    let mut config = loaded.config.clone();
    config.sweep = None;
    let bytes = fs::read(&loaded.path).map_err(Failure::work)?;
    let mut inputs = vec![Input::new(&loaded.path, &bytes)];
    inputs.extend(log.inputs.iter().cloned());

    let mut asked = Asked::default();
    if let Some(file) = &args.relations {
        let refused = |message: String| Failure::Input(anyhow!("{}: {message}", file.display()));
        let expected = "expected a file of relations";
        let bytes =
            fs::read(file).map_err(|e| refused(format!("cannot be read ({e}); {expected}")))?;
        inputs.push(Input::new(file, &bytes));
        let relations = relations::read(&bytes).map_err(|error| refused(error.to_string()))?;
        if let Some(warning) = unrelated(log, &relations) {
            out.note(&format!("warning: {}: {warning}", file.display()));
        }
        asked.relations = Some(relations);
    }
    let given = match &args.places {
        None => None,
        Some(name) if topic_of(name).is_some() => Some(log.matches.clone()),
        Some(file) => {
            let (matches, input) = read_matches(file)?;
            inputs.push(input);
            Some(matches)
        }
    };
    if let (Some(file), Some(matches)) = (&args.places, &given) {
        for warning in unmatched(log, matches) {
            out.note(&format!("warning: {}: {warning}", file.display()));
        }
    }
    out.detail(&format!(
        "{}: {} scans over {:.0} s",
        args.log.display(),
        log.scans.len(),
        log.span_secs()
    ));

    let mut folder = RunFolder::create(dir, args.force)?;
    let file = args.record.clone().unwrap_or_else(|| folder.recording());
    let recording = start_replay_recording(&config, log, &file, loaded.header())?;
    let mut bar = Bar::new("log", out);
    let replayed =
        replay_log(&config, log, given.as_deref(), &asked, recording, &mut |share, row| {
            bar.update(share, || {
                format!(
                    "replayed, keyframe {}, {:.0} m, {} places recognised",
                    row.vertices, row.distance_m, row.place_edges
                )
            });
        });
    bar.clear();
    let replayed = replayed?;
    for (name, content) in files(&config, log, &replayed, inputs)? {
        folder.write(name, &content)?;
    }
    folder.finish()?;
    report(dir, &replayed, out)?;
    wrote(dir, None, args.record.as_deref(), config.record.level, out);
    Ok(())
}

fn report(dir: &Path, replayed: &Replayed, out: &Out) -> Result<(), Failure> {
    let metrics = to_json(&replayed.metrics).map_err(Failure::work)?;
    let timing = to_json(&replayed.timing).map_err(Failure::work)?;
    let json = json!({ "dir": dir.display().to_string(), "metrics": metrics, "timing": timing });
    let told = &replayed.metrics;
    let share = |share: Option<f64>| {
        share.map_or_else(|| "-".to_owned(), |share| format!("{:.1} %", 100.0 * share))
    };
    let mut text = format!(
        "{} keyframes of {} scans over {:.1} m, {:.0} m2 seen\n\
         closures: {} tried, {} accepted, {} of them at odds with the rest\n\
         walls inside free space of other views: {} by odometry, {} relative, {} optimised\n",
        told.keyframes,
        told.scans,
        told.distance_m,
        told.covered_m2,
        told.loop_closures_proposed,
        told.loop_closures_accepted,
        told.loop_closures_rejected_by_graph,
        share(told.inconsistency.odometry),
        share(told.inconsistency.relative),
        share(told.inconsistency.optimised),
    );
    if let (Some(metres), Some(degrees)) =
        (told.relations_translation_m, told.relations_rotation_deg)
    {
        text.push_str(&format!("relations: off by {metres:.3} m and {degrees:.2} deg\n"));
    }
    text.push_str(&format!(
        "a keyframe took {:.1} ms (median), {:.1} ms (99th percentile)\n\n",
        replayed.timing.keyframe_millis_median, replayed.timing.keyframe_millis_p99
    ));
    let header =
        ["map", "frontier left m", "in places", "ignored m", "corrections", "µs/keyframe", "p99"];
    let rows: Vec<Vec<String>> = told
        .maps
        .iter()
        .zip(&replayed.timing.maps)
        .map(|((name, map), (_, timing))| {
            vec![
                name.clone(),
                format!("{:.1}", map.frontier_left_m),
                map.frontier_places.to_string(),
                format!("{:.1}", map.frontier_ignored_m),
                map.corrections.to_string(),
                format!("{:.0}", timing.step_micros_median),
                format!("{:.0}", timing.step_micros_p99),
            ]
        })
        .collect();
    text.push_str(&table(&header, &rows, 1));
    out.summary(&json, &text)
}
