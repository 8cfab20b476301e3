//! Recordings of work on meshes: one event after another on the timeline `event`.
//!
//! `stage.rs` is what they all stand on: the file, the layout, labelled meshes, lines, points, and one
//! line of text for each event. One file for each algorithm.

mod boolean;
mod reduce;
mod stage;
mod tetrahedra;

pub use boolean::BooleanRecording;
pub use reduce::ReduceRecording;
pub use stage::SolidOptions;
pub(crate) use stage::SolidStage;
pub use tetrahedra::TetrahedraRecording;
