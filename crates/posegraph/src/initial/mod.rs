//! Start values: as the file gives them, along odometry, along a spanning tree.
//!
//! 1. [`odometry`]: what the robot believed while it drove; drifts the most, and is what other
//!    optimisers are measured from.
//! 2. [`spanning_tree`]: the fewest factors between each vertex and the first of its component;
//!    [`surest_tree`]: those on which the variances of rotations add up to the least.
//! 3. [`given`](given()): what the file says, completed along factors.
//! 4. [`chordal`](chordal()): linear least squares over all factors, rotations first.
//! 5. [`default_start`]: chordal, judged by what the optimiser makes of it, and better ones on doubt.

pub mod chordal;
mod components;
pub mod default;
mod odometry;
mod spanning_tree;

pub use chordal::chordal;
pub use components::Components;
pub use default::{
    Doubt, Judgement, Origin, Start, Trial, asked_start_by, default_start, default_start_by,
    default_start_with,
};
pub use odometry::odometry;
pub use spanning_tree::{given, spanning_tree, surest_tree};
