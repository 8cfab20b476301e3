//! Rays, sweeps and distances against many segments.
//!
//! The bounding-volume tree is parry's; its types stay inside this module.

mod caster;
mod segment;

pub use caster::SegmentCaster;
