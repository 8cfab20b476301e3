//! The Delaunay tetrahedralisation of points.
//!
//! 1. [`start.rs`] The first four points that are not coplanar make a tetrahedron, and each of its
//!    faces a ghost: a tetrahedron with the vertex at infinity, so that the outside has neighbours too.
//! 2. [`locate.rs`] For each further point a walk from the last one finds the tetrahedron that holds it
//!    (\[DPT02\]).
//! 3. [`cavity.rs`] All tetrahedra whose circumspheres hold the point are removed, and each face of the
//!    hole is joined to the point (\[Bow81\], \[Wat81\]).
//!
//! `insert.rs` runs the three, in the order of [`order`](super::order). `points.rs` is the entry for
//! plain points.

mod cavity;
mod insert;
mod locate;
mod points;
mod start;

pub(crate) use insert::delaunay_of;
pub use points::{Delaunay, delaunay, delaunay_with};
