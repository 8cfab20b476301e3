//! Questions to a mesh: what a ray meets, and whether a point lies inside.
//!
//! Hits are decided exactly, so that no ray slips between two faces: a ray is the segment from its
//! start to its end, and each face says by exact signs on which side of its edges the segment passes.
//! Where along the segment a hit lies is a float.
//!
//! A point is inside a closed mesh when a segment from it to the outside crosses the surface an odd
//! number of times. Where the segment meets an edge or a corner, or runs along a face, another
//! segment is tried; after 32 of them, which no mesh was seen to need, the solid angle of the
//! surface decides.

mod containment;
mod distance;
mod ray;
mod solid;

pub use containment::Side;
pub use distance::{closest_on_triangle, distance_to_triangle};
pub use ray::Hit;
pub use solid::Solid;
