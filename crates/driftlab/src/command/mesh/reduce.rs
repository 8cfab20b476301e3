//! `driftlab mesh reduce`: fewer faces within an error.

use std::time::Instant;

use anyhow::anyhow;
use instrument::{ReduceRecording, SolidOptions};
use serde_json::json;
use solid::reduce::Goal;
use solid::reduce_with;

use super::super::failure::Failure;
use super::super::graph::numbers::{listed, shown};
use super::super::out::Out;
use super::args::ReduceArgs;
use super::input;
use super::told::Told;

pub(super) fn reduce(args: &ReduceArgs, out: &Out) -> Result<(), Failure> {
    if !(args.error >= 0.0 && args.error.is_finite()) {
        return Err(Failure::Input(anyhow!(
            "--error: found {}, expected metres from 0",
            args.error
        )));
    }
    let target = args.output.target(&[&args.file])?;
    let read = input::mesh(&args.file, args.input.weld, out)?;
    let goal = Goal { error_m: args.error, faces: args.faces };
    let mut recording = match &args.output.recording.record {
        Some(path) => {
            let name = args.file.file_name().unwrap_or_default().to_string_lossy();
            let about = format!("`{name}` with fewer faces, within {} m.", args.error);
            let options = SolidOptions { path: path.clone(), name: "reduce".to_owned(), about };
            Some(ReduceRecording::create(&options).map_err(Failure::work)?)
        }
        None => None,
    };
    let start = Instant::now();
    let reduced = match &mut recording {
        Some(recording) => reduce_with(&read.mesh, &goal, recording),
        None => reduce_with(&read.mesh, &goal, &mut probe::Off),
    };
    let secs = start.elapsed().as_secs_f64();
    if let Some(target) = &target {
        target.write(&reduced.mesh)?;
    }
    let told = Told::of(&reduced.mesh);
    let mut json = told.json();
    let why = reduced.refusals;
    json["input_faces"] = read.mesh.faces().len().into();
    json["removed_vertices"] = reduced.removed.into();
    json["max_m"] = reduced.error_m.into();
    json["refused"] = json!({
        "link": why.link, "label": why.label, "fold": why.fold, "bound": why.bound,
        "crossing": why.crossing,
    });
    json["secs_read"] = read.secs.into();
    json["secs_reduce"] = secs.into();
    if let Some(recording) = recording {
        recording.finish(&json).map_err(Failure::work)?;
    }
    args.output.tell(&mut json);
    let mut rows = told.rows();
    rows.push(("faces before", read.mesh.faces().len().to_string()));
    rows.push(("error", format!("{} m at most", shown(reduced.error_m))));
    rows.push(("seconds", format!("read {:.4}, reduce {secs:.4}", read.secs)));
    out.result(&json, &listed(&rows))
}
