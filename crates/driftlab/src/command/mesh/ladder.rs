//! `driftlab mesh ladder`: one depth image, reduced further and further.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use instrument::{DepthRecording, DepthRecordingOptions};
use maps3d::image::PrepareOptions;
use maps3d::quality::{Quality, measure};
use maps3d::reduce::{Method, ReduceOptions, Stop};
use maps3d::triangulate::Occlusion;
use maps3d::{DepthEvent, Maps3dError, ViewOptions, polyhedron_with};
use probe::Probe;
use sensing::DepthImage;
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::files::{apart, vacant};
use super::super::graph::numbers::shown;
use super::super::out::Out;
use super::args::LadderArgs;
use super::depth_input;
use crate::config::Ladder;

/// A mesh on the way, measured.
struct Rung {
    method: String,
    vertices: usize,
    faces: usize,
    quality: Quality,
}

/// Measures each mesh that is shown, and hands everything on to the recording.
struct Measured<'a> {
    method: &'a str,
    recording: &'a mut DepthRecording,
    rungs: &'a mut Vec<Rung>,
}

impl<'e> Probe<DepthEvent<'e>> for Measured<'_> {
    fn emit(&mut self, event: DepthEvent<'e>) {
        if let DepthEvent::Reached { image, mesh } | DepthEvent::Reduced { image, mesh } = event {
            let (vertices, faces) = (mesh.pixels.len(), mesh.triangles.len());
            let last = self.rungs.last();
            if last.is_none_or(|last| last.method != self.method || last.vertices != vertices) {
                let (method, quality) = (self.method.to_owned(), measure(image, mesh));
                self.rungs.push(Rung { method, vertices, faces, quality });
            }
        }
        self.recording.emit(event);
    }
}

pub(super) fn ladder(args: &LadderArgs, out: &Out) -> Result<(), Failure> {
    let config = Ladder::read(&args.config)?;
    let record = args
        .record
        .clone()
        .unwrap_or_else(|| PathBuf::from("recordings").join(format!("{}.rrd", config.name)));
    apart(&record, [args.config.as_path()].into_iter().chain(args.depth.as_deref()))?;
    vacant(&record, args.force)?;
    let (image, from): (DepthImage, String) = match &args.depth {
        Some(path) => {
            args.file.check()?;
            let read = depth_input::depth(path, &args.file, out)?;
            depth_input::note(&read, &view(&config, None).prepare, path, out)?;
            (read.image, path.display().to_string())
        }
        None => (config.room.image(), "a made-up room".to_owned()),
    };
    let refused = |error: Maps3dError| Failure::Input(anyhow!("{from}: {error}"));
    // What is wrong shows before a file is made.
    maps3d::image::prepare(&image, &view(&config, None).prepare).map_err(refused)?;
    for reduce in config.methods().into_iter().flat_map(|m| reductions(m, &config.ladder.vertices))
    {
        view(&config, reduce).check().map_err(refused)?;
    }
    if let Some(folder) = record.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder)
            .map_err(|error| Failure::Work(anyhow!("{}: {error}", folder.display())))?;
    }
    let options = DepthRecordingOptions {
        path: record.clone(),
        name: config.name.clone(),
        methods: config.ladder.methods.clone(),
        shown: config.ladder.vertices.clone(),
    };
    let mut recording = DepthRecording::create(options).map_err(Failure::work)?;
    let mut rungs: Vec<Rung> = Vec::new();
    for (at, (name, method)) in config.ladder.methods.iter().zip(config.methods()).enumerate() {
        recording.begin(at);
        for reduce in reductions(method, &config.ladder.vertices) {
            let mut probe = Measured { method: name, recording: &mut recording, rungs: &mut rungs };
            polyhedron_with(&image, &view(&config, reduce), &mut probe).map_err(refused)?;
        }
    }
    let mut json = told(&rungs);
    json["file"] = from.into();
    json["name"] = config.name.clone().into();
    recording.finish(table(&rungs), &json).map_err(Failure::work)?;
    json["recording"] = record.display().to_string().into();
    out.note(&format!("{}; drag its timeline `vertices`", shown_path(&record)));
    out.summary(&json, &table(&rungs))
}

fn shown_path(record: &Path) -> String {
    format!("recording: {}", record.display())
}

fn view(config: &Ladder, reduce: Option<ReduceOptions>) -> ViewOptions {
    let depth = config.depth;
    ViewOptions {
        prepare: PrepareOptions { crop: depth.crop, far_m: depth.far_m, ..Default::default() },
        occlusion: depth.occlusion.then(Occlusion::default),
        reduce,
        ..ViewOptions::default()
    }
}

/// One pass over all numbers for a method that removes. A method that inserts polishes its mesh at
/// the end: one pass for each number, the finest first.
fn reductions(method: Method, vertices: &[usize]) -> Vec<Option<ReduceOptions>> {
    let mut counts = vertices.to_vec();
    counts.sort_unstable_by(|a, b| b.cmp(a));
    counts.dedup();
    let Some(&last) = counts.last() else { return vec![None] };
    if let Method::InverseDepth(_) = method {
        let each = |&count: &usize| Some(ReduceOptions::new(method, Stop::Vertices(count)));
        return counts.iter().map(each).collect();
    }
    let stop = Stop::Vertices(last);
    vec![Some(ReduceOptions { ladder: counts, ..ReduceOptions::new(method, stop) })]
}

fn told(rungs: &[Rung]) -> Value {
    let rung = |rung: &Rung| {
        let (plane, ray) = (&rung.quality.plane, &rung.quality.ray);
        json!({
            "method": rung.method,
            "vertices": rung.vertices,
            "faces": rung.faces,
            "rms_m": plane.rms_m,
            "p95_m": plane.p95_m,
            "max_m": plane.max_m,
            "along_rays": { "rms_m": ray.rms_m, "p95_m": ray.p95_m, "max_m": ray.max_m },
            "uncovered_share": rung.quality.uncovered_share,
            "outside_max_m": rung.quality.outside_max_m,
        })
    };
    json!({ "rungs": rungs.iter().map(rung).collect::<Vec<_>>() })
}

fn table(rungs: &[Rung]) -> String {
    let mut text = String::from(
        "| method | vertices | faces | rms m | 95 % m | max m |\n|---|--:|--:|--:|--:|--:|\n",
    );
    for rung in rungs {
        let plane = &rung.quality.plane;
        let [rms, p95, max] = [plane.rms_m, plane.p95_m, plane.max_m].map(shown);
        let Rung { method, vertices, faces, .. } = rung;
        text += &format!("| {method} | {vertices} | {faces} | {rms} | {p95} | {max} |\n");
    }
    text
}
