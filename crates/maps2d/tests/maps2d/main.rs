//! Laws of the maps, held against brute force on random rooms, and known answers.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod active;
mod asked;
mod consolidation;
mod corrected;
mod drive;
mod events;
mod explain;
mod extended;
mod grid;
mod oracle;
mod polygons;
mod retirement;
mod room;
mod told;
mod trust;
mod volume;
mod withdrawal;

use proptest::test_runner::{Config, FileFailurePersistence};

/// A configuration that keeps failing seeds in the committed file `proptest-regressions/NAME.txt`;
/// `PROPTEST_CASES` overrides the number of cases.
fn config(cases: u32, file: &'static str) -> Config {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    Config {
        cases: asked.unwrap_or(cases),
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(file))),
        ..Config::default()
    }
}
