//! `driftlab graph`: pose-graph files, told about, optimised, compared, converted and made up.

mod args;
mod compare;
mod convert;
mod generate;
mod info;
mod input;
pub(super) mod numbers;
mod optimize;
mod output;
mod start;

pub(super) use args::GraphArgs;
use args::GraphCommand;

use super::failure::Failure;
use super::out::Out;

pub(super) fn graph(args: &GraphArgs, out: &Out) -> Result<(), Failure> {
    match &args.command {
        GraphCommand::Info(args) => info::info(args, out),
        GraphCommand::Optimize(args) => optimize::optimize(args, out),
        GraphCommand::Compare(args) => compare::compare(args, out),
        GraphCommand::Convert(args) => convert::convert(args, out),
        GraphCommand::Generate(args) => generate::generate(args, out),
    }
}
