#![doc = include_str!("../README.md")]

mod events;
pub mod grid;
mod map;
pub mod relative;
pub mod volume;

pub use events::MapProbe;
pub use map::{Candidate, Clearance, ExplorationMap, Frontier, Route, Standing, Vantage};
