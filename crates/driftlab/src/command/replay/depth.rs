//! `driftlab replay` of depth images.

use std::fs;
use std::path::Path;

use anyhow::anyhow;
use serde_json::json;

use super::super::args::ReplayArgs;
use super::super::failure::Failure;
use super::super::out::Out;
use super::super::progress::Bar;
use super::super::run::wrote;
use super::super::table::table;
use crate::config::{Loaded, Replay3d};
use crate::replay::{DepthFrames, DepthReplayed, depth_files, replay_depth};
use crate::run::{Input, RunFolder, to_json};

pub(super) fn replay(
    args: &ReplayArgs,
    loaded: &Loaded,
    frames: &mut DepthFrames,
    dir: &Path,
    out: &Out,
) -> Result<(), Failure> {
    let of_the_plane =
        [("--relations", args.relations.is_some()), ("--places", args.places.is_some())];
    if let Some((name, _)) = of_the_plane.into_iter().find(|(_, given)| *given) {
        let why = "expected it with scans of a planar laser only";
        return Err(Failure::Input(anyhow!("{name}: found it with maps of space, {why}")));
    }
    let mut config = loaded.config.clone();
    if config.replay3d.is_none() {
        let far_m = Replay3d::default().far_m;
        let what = "depth images are taken by its defaults";
        out.note(&format!(
            "note: {}: no table [replay3d], {what}: what was not read ends at {far_m} m",
            loaded.path.display()
        ));
    }
    config.sweep = None;
    let bytes = fs::read(&loaded.path).map_err(Failure::work)?;
    let inputs = vec![Input::new(&loaded.path, &bytes)];
    let mut folder = RunFolder::create(dir, args.force)?;
    let file = args.record.clone().unwrap_or_else(|| folder.recording());
    let mut bar = Bar::new("log", out);
    let replayed = replay_depth(&config, frames, &file, loaded.header(), &mut |share, count| {
        bar.update(share, || format!("{count} depth images"));
    });
    bar.clear();
    for warning in frames.warnings() {
        out.note(&format!("warning: {}: {warning}", args.log.display()));
    }
    let replayed = replayed?;
    for (name, map) in &replayed.metrics.maps {
        let odd = [
            (map.refused_looks, "an image was refused"),
            (map.map_invalid, "a view or the whole map could not be taken in as it should"),
        ];
        for (count, what) in odd.into_iter().filter(|(count, _)| *count > 0) {
            out.note(&format!("warning: {name}: {what}, {count} times"));
        }
    }
    for (name, content) in depth_files(&config, &replayed, inputs)? {
        folder.write(name, &content)?;
    }
    folder.finish()?;
    report(dir, &replayed, out)?;
    wrote(dir, None, args.record.as_deref(), config.record.level, out);
    Ok(())
}

fn report(dir: &Path, replayed: &DepthReplayed, out: &Out) -> Result<(), Failure> {
    let metrics = to_json(&replayed.metrics).map_err(Failure::work)?;
    let timing = to_json(&replayed.timing).map_err(Failure::work)?;
    let json = json!({ "dir": dir.display().to_string(), "metrics": metrics, "timing": timing });
    let told = &replayed.metrics;
    let mut text = format!(
        "{} of {} depth images taken, carried {:.1} m\n\n",
        told.keyframes, told.images, told.distance_m
    );
    let header = [
        "map",
        "faces",
        "frontier left m²",
        "in places",
        "ignored m²",
        "way to the nearest m",
        "ms/image",
        "p99",
        "KiB/image",
    ];
    let rows: Vec<Vec<String>> = told
        .maps
        .iter()
        .zip(&replayed.timing.maps)
        .map(|((name, map), (_, timing))| {
            vec![
                name.clone(),
                map.map_faces.to_string(),
                format!("{:.2}", map.frontier_left_m2),
                map.frontier_places.to_string(),
                format!("{:.2}", map.frontier_ignored_m2),
                map.way_m.map_or_else(|| "-".to_owned(), |way_m| format!("{way_m:.2}")),
                format!("{:.1}", timing.keyframe_millis_median),
                format!("{:.1}", timing.keyframe_millis_p99),
                format!("{:.0}", timing.bytes_per_keyframe / 1024.0),
            ]
        })
        .collect();
    text.push_str(&table(&header, &rows, 1));
    out.summary(&json, &text)
}
