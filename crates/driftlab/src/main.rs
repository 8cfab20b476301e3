//! The `driftlab` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    driftlab::command::main()
}
