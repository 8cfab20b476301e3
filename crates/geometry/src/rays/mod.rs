//! Rays, sweeps and distances against many segments of the plane, or many triangles of space.
//!
//! The bounding-volume trees are parry's; its types stay inside this module.

mod caster;
mod mesh_caster;
mod segment;
mod triangle;

pub use caster::SegmentCaster;
pub use mesh_caster::MeshCaster;
