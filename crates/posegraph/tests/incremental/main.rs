//! Poses one by one against the batch optimiser, marginals against dense inversion.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod against_batch;
mod islands;
mod marginals;
#[path = "../optimizer/oracle.rs"]
#[expect(dead_code, reason = "shared with the tests of the optimiser, which use all of it")]
mod oracle;
