//! `driftlab completions`: a script for the shell.

use clap::CommandFactory;
use serde_json::json;

use super::args::{Cli, CompletionsArgs};
use super::failure::Failure;
use super::out::Out;

pub(super) fn completions(args: &CompletionsArgs, out: &Out) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "driftlab", &mut script);
    let script = String::from_utf8(script).map_err(Failure::work)?;
    out.result(&json!({ "shell": args.shell.to_string(), "script": script }), &script)
}
