//! `driftlab log`: logs of robots, told about and converted.

mod args;
mod convert;
mod info;
mod told;

pub(super) use args::LogArgs;
use args::LogCommand;

use super::failure::Failure;
use super::out::Out;
use crate::logs::LogError;

pub(super) fn log(args: &LogArgs, out: &Out) -> Result<(), Failure> {
    match &args.command {
        LogCommand::Info(args) => info::info(args, out),
        LogCommand::Convert(args) => convert::convert(args, out),
    }
}

impl From<LogError> for Failure {
    fn from(error: LogError) -> Self {
        Self::Input(error.into())
    }
}
