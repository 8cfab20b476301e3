//! The optimiser against oracles that share nothing with it, and against its own laws.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod data;
mod dense;
mod information;
mod jacobians;
mod laws;
mod losses;
mod oracle;
mod termination;
