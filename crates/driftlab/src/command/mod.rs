//! The `driftlab` command: arguments, messages, exit codes.
//!
//! Results go to standard output, everything else to standard error. Exit codes: 0 done, 1 the work
//! failed, 2 bad usage or bad input.

mod args;
mod completions;
mod config;
mod failure;
mod files;
mod graph;
mod inspect;
mod log;
mod mesh;
mod out;
mod progress;
mod replay;
mod report;
mod run;
mod sweep;
mod table;
mod view;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use out::Out;

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let out = Out::new(&cli.global);
    let result = match &cli.command {
        Command::Run(args) => run::run(args, &out),
        Command::Replay(args) => replay::replay(args, &out),
        Command::Sweep(args) => sweep::sweep(args, &out),
        Command::Report(args) => report::report(args, &out),
        Command::Graph(args) => graph::graph(args, &out),
        Command::Mesh(args) => mesh::mesh(args, &out),
        Command::Log(args) => log::log(args, &out),
        Command::Inspect(args) => inspect::inspect(args, &out),
        Command::View(args) => view::view(args, &out),
        Command::Config(args) => config::config(args, &out),
        Command::Completions(args) => completions::completions(args, &out),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            out.error(&failure);
            ExitCode::from(failure.code())
        }
    }
}
