//! The policies: on a sketch of a map whose answers are written down, and in simulated places.

mod choices;
mod ending;
mod flown;
mod heard;
mod options;
mod sketch;
mod united;
mod ways;
