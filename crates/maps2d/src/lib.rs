#![doc = include_str!("../README.md")]

pub mod active;
pub mod correction;
mod events;
pub mod extended;
pub mod grid;
mod map;
pub mod polygons;
pub mod relative;
pub mod volume;

pub use events::MapProbe;
pub use map::{
    Candidate, Clearance, ExplorationMap, Frontier, GlobalBelief, Route, Standing, Vantage,
};
