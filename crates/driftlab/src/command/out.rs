//! The two streams: results, and messages for people.

use std::io::{self, IsTerminal, Write};

use serde_json::Value;

use super::args::Global;
use super::failure::Failure;

/// Where a command writes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Out {
    json: bool,
    quiet: bool,
    verbose: u8,
}

impl Out {
    pub(super) fn new(global: &Global) -> Self {
        Self { json: global.json, quiet: global.quiet, verbose: global.verbose }
    }

    /// Whether a bar may be drawn.
    pub(super) fn shows_progress(&self) -> bool {
        !self.quiet && io::stderr().is_terminal()
    }

    /// The result: `json` as one line under `--json`, else `text`.
    pub(super) fn result(&self, json: &Value, text: &str) -> Result<(), Failure> {
        let line = if self.json { format!("{json}\n") } else { text.to_owned() };
        let mut stdout = io::stdout().lock();
        match stdout.write_all(line.as_bytes()).and_then(|()| stdout.flush()) {
            // A reader that went away, as `head` does, wants no more.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            other => other.map_err(Failure::work),
        }
    }

    /// The result of work that leaves files: as [`result`](Self::result), but with `-q` the table
    /// is not shown.
    pub(super) fn summary(&self, json: &Value, text: &str) -> Result<(), Failure> {
        if self.quiet && !self.json { Ok(()) } else { self.result(json, text) }
    }

    /// A message; silent with `-q`.
    pub(super) fn note(&self, text: &str) {
        if !self.quiet {
            self.say(text);
        }
    }

    /// A message that only `-v` shows.
    pub(super) fn detail(&self, text: &str) {
        if self.verbose > 0 && !self.quiet {
            self.say(text);
        }
    }

    /// The failure of the command.
    pub(super) fn error(&self, failure: &Failure) {
        self.say(&format!("error: {failure}"));
    }

    fn say(&self, text: &str) {
        // Nobody is left to tell if standard error is closed.
        let _ = writeln!(io::stderr().lock(), "{text}");
    }
}
