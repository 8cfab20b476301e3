//! `driftlab run`: one experiment.

use anyhow::anyhow;

use super::args::RunArgs;
use super::config::load;
use super::failure::Failure;
use super::out::Out;

pub(super) fn run(args: &RunArgs, _out: &Out) -> Result<(), Failure> {
    let _loaded = load(&args.input)?;
    Err(Failure::Work(anyhow!("todo")))
}
