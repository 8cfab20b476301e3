//! What must appear in the mesh, and what stands in its way.
//!
//! | file | what it holds |
//! |---|---|
//! | `complex.rs` | segments and facets, which of them are in the mesh, look-up by vertices |
//! | `meets.rs` | how a segment meets a triangle |
//! | `walk.rs` | what a missing segment runs through |

mod complex;
mod meets;
mod walk;

pub(crate) use complex::Constraints;
pub(crate) use meets::{Meets, meets};
pub(crate) use walk::{First, Way};
