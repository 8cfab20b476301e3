#![doc = include_str!("../README.md")]

mod contract;
mod error;
mod graph;
mod scope;
mod skeleton;

pub use error::PoseGraphError;
pub use graph::{Edge, EdgeKind, PoseGraph};
pub use scope::{Placed, Placement, Scope, ScopeScratch};
pub use skeleton::{Link, Skeleton, Via};
