//! Coverage of space, by voxels.
//!
//! 1. Voxels are laid over the bounds of the place. A voxel is *free* where the ball inscribed in it touches
//!    nothing.
//! 2. The robot *reaches* those whose centre keeps its radius from everything and that hang together with
//!    the start, side by side.
//! 3. A voxel *counts* where the camera could see its centre from the centre of a reachable one: in the field
//!    of view at some yaw, near enough, nothing in between (`sight.rs`). This is settled once per place, by
//!    the nearest places first and fewer of the far ones.
//! 4. A look *sees* the voxels whose centre lies in its true view volume.
//!
//! Coverage is the share of the voxels that count and were seen. What a map takes voxels for is held against the truth
//! at those that count and at those that are not free (`accuracy.rs`).

mod accuracy;
mod coverage;
mod lattice;
mod sight;
mod witness;

pub use accuracy::VoxelAccuracy;
pub use coverage::{VoxelCoverage, VoxelParams};
pub use witness::FlightWitness;
