//! The recording of a flight: truth beside belief in space, from depth image to path.
//!
//! | file | what |
//! |---|---|
//! | `options`, `recording`, `page` | the file, what it says about itself, its end |
//! | `recorder`, `ink` | one map's listener; how things of space are drawn |
//! | `truth` | the place, the true path, what was really seen |
//! | `looks` | depth images, and the way to a polyhedron |
//! | `graph` | vertices and edges by odometry |
//! | `union` | the united map |
//! | `views` | the views of the relative map around the robot |
//! | `search` | tetrahedra, the dual graph, A*, cone programmes |
//! | `planner` | what is to be looked at, from where, and the way there |
//! | `events` | every event in order, a line each |

mod events;
mod graph;
mod ink;
mod looks;
mod options;
mod page;
mod planner;
mod recorder;
mod recording;
mod search;
mod truth;
mod union;
mod views;

pub use options::FlightOptions;
pub use recorder::{FlightRecorder, FlightStep};
pub use recording::FlightRecording;
