#![doc = include_str!("../../docs/global_union.md")]

mod answers;
mod ask;
mod counts;
mod events;
mod fill;
mod map;
mod params;
mod patches;
mod places;
mod poses;
mod surface;
mod unite;
mod view;
mod volumes;
mod walls;
mod ways;

pub use counts::UnionCounts;
pub use events::UnionEvent;
pub use map::UnionMap;
pub use params::{UnionCorrection, UnionParams};
