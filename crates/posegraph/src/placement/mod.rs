//! Placement along shortest paths: the record, the skeleton over it, contraction and withdrawal.

mod contract;
mod graph;
mod relative_pose;
mod scope;
mod skeleton;

pub use graph::{Edge, EdgeKind, PoseGraph};
pub use relative_pose::RelativePose;
pub use scope::{Placed, Placement, Scope, ScopeScratch};
pub use skeleton::{Link, Skeleton, Via};
