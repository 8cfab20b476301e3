#![doc = include_str!("../README.md")]

mod cells;
mod error;
pub mod paper;
mod solid;
mod world;

pub use cells::CellMap;
pub use error::WorldError;
pub use solid::Solid;
pub use world::World2d;
