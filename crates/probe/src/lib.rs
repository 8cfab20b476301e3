#![doc = include_str!("../README.md")]

mod ids;
mod observe;
mod variants;

pub use ids::{EdgeId, Id, IdVec, PathId, VertexId};
pub use observe::{Off, Probe};
