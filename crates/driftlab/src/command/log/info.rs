//! `driftlab log info`: what a log holds.

use super::super::failure::Failure;
use super::super::out::Out;
use super::args::InfoArgs;
use super::told;
use crate::logs::LogSource;

pub(super) fn info(args: &InfoArgs, out: &Out) -> Result<(), Failure> {
    let name = args.file.display().to_string();
    let mut source = LogSource::open(&args.file)?;
    told::exhaust(&mut source)?;
    told::warn(&name, &source, out);
    let mut json = told::json(&source);
    json["file"] = name.into();
    out.result(&json, &told::text(&source))
}
