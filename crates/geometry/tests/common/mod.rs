//! What the laws share: an exact oracle that knows nothing of bearings, and degenerate inputs.
#![allow(dead_code, reason = "each test binary uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

pub mod oracle;
pub mod places;
pub mod slabs;
pub mod views;

use proptest::test_runner::{Config, FileFailurePersistence};

/// A configuration that keeps failing seeds in the committed file `proptest-regressions/NAME.txt`.
pub fn config(cases: u32, file: &'static str) -> Config {
    Config {
        cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(file))),
        ..Config::default()
    }
}
