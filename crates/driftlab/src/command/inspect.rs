//! `driftlab inspect`: what a recording holds.

use anyhow::anyhow;

use super::args::InspectArgs;
use super::failure::Failure;
use super::out::Out;
use super::view::recording;

pub(super) fn inspect(args: &InspectArgs, _out: &Out) -> Result<(), Failure> {
    let file = recording(&args.file)?;
    Err(Failure::Work(anyhow!("{}: todo", file.display())))
}
