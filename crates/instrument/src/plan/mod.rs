//! Recordings of paths through tetrahedra: the search stepped node by node, then the cone programmes.
//!
//! `draw.rs` turns what an event holds into lines and points, `record.rs` is the listener.

pub(crate) mod draw;
mod record;

pub use record::{PLAN_EVENTS, PlanRecording, PlanRecordingOptions};
