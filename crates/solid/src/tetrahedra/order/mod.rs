//! The order in which points are inserted.
//!
//! | file | what it does |
//! |---|---|
//! | `brio.rs` | growing rounds, each along the curve (\[ACR03\]) |
//! | `hilbert.rs` | the place of a point along a Hilbert curve (\[Ski04\]) |
//!
//! The rounds keep the expected cost of a random order, the curve makes each point lie near the one
//! before it, so that a walk of a few steps finds it and the memory it touches is warm.

mod brio;
mod hilbert;

pub(crate) use brio::{Growth, brio};
