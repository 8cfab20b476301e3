#![doc = include_str!("../../docs/global_union.md")]

mod ask;
mod events;
mod map;
mod params;
mod patches;
mod places;
mod poses;
mod surface;
mod view;
mod volumes;
mod walls;
mod ways;

pub use events::UnionEvent;
pub use map::{UnionCounts, UnionMap};
pub use params::{UnionCorrection, UnionParams};
