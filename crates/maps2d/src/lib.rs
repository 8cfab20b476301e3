#![doc = include_str!("../README.md")]

mod events;
mod map;
pub mod grid;
pub mod relative;
pub mod volume;

pub use events::MapProbe;
pub use map::{Candidate, Clearance, ExplorationMap, Frontier, Route, Standing};
