//! Chordal starts, the certificate and the default start: against dense oracles, on planted wrong
//! optima, and on real graphs where they are at hand.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod certificate;
mod chordal;
mod data;
mod default_start;
mod graphs;
mod oracle;
mod planted;
