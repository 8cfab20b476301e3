//! `driftlab mesh info`: what a mesh holds, and how valid it is.

use std::time::Instant;

use super::super::failure::Failure;
use super::super::graph::numbers::listed;
use super::super::out::Out;
use super::args::InfoArgs;
use super::input;
use super::told::Told;

pub(super) fn info(args: &InfoArgs, out: &Out) -> Result<(), Failure> {
    let read = input::mesh(&args.file, args.input.weld, out)?;
    let start = Instant::now();
    let told = Told::of(&read.mesh);
    let secs_check = start.elapsed().as_secs_f64();
    let mut json = told.json();
    json["file"] = args.file.display().to_string().into();
    json["format"] = read.file.format.name().into();
    json["polygons"] = read.file.polygons.into();
    json["labelled"] = read.file.labelled.into();
    json["welded"] = (args.input.weld || read.file.is_soup()).into();
    json["secs_read"] = read.secs.into();
    json["secs_check"] = secs_check.into();
    let mut rows = vec![(
        "format",
        format!(
            "{}, {} polygons{}",
            read.file.format.name(),
            read.file.polygons,
            if read.file.labelled { ", labelled" } else { ", without labels" }
        ),
    )];
    rows.extend(told.rows());
    rows.push(("seconds", format!("read {:.4}, check {secs_check:.4}", read.secs)));
    out.result(&json, &listed(&rows))
}
