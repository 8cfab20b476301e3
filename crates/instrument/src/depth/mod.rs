//! The recording of a depth image on its way to a polyhedron, scrubbed by the number of vertices.

mod draw;
mod page;
mod record;

pub use record::{DEPTH_EVENTS, DepthRecording, DepthRecordingOptions};
