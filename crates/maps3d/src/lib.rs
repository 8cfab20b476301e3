#![doc = include_str!("../README.md")]

#[doc = include_str!("../docs/depth.md")]
pub mod depth {}

pub mod image;
pub mod quality;
pub mod reduce;
pub mod triangulate;
pub mod view;

mod error;
mod events;
mod pipeline;
mod tolerance;

pub use error::Maps3dError;
pub use events::DepthEvent;
pub use pipeline::{Made, ViewOptions, polyhedron, polyhedron_with};
