//! Stanford PLY: a header that names elements and their properties, then text or bytes.
//!
//! [`read`] gives every element as columns of numbers, whatever they mean; [`crate::mesh`] makes a
//! mesh of `vertex` and `face`. Integers of up to 32 bits and floats of 32 and 64 bits all fit an
//! `f64` without loss.

mod body;
mod header;

pub use body::{Column, Element, Ply, read};
pub use header::{Encoding, Scalar};
