//! The two predicates of the Delaunay kernel and of the flips, filtered for speed.
//!
//! | file | what it decides |
//! |---|---|
//! | `orient.rs` | on which side of a plane a point lies |
//! | `sphere.rs` | whether a point lies inside a sphere, with symbolic perturbation |
//!
//! Both first compute the determinant in floats with a bound made of the largest difference of each
//! axis, which costs a few comparisons; where that cannot tell, Shewchuk's adaptive arithmetic
//! (crate `robust`) decides.

mod orient;
mod sphere;

pub(crate) use orient::orient;
pub(crate) use sphere::in_sphere;

/// A point as three numbers, which the kernel works on.
pub(crate) type P3 = [f64; 3];
