//! Made-up views and hard pairs, for tests and benchmarks.
//!
//! A room with boxes and columns is seen by a depth camera ([`World`]); each view is a closed
//! star-shaped polyhedron ([`view`]): a jittered grid over the image, lifted to where its rays end, and
//! a fan to the sensor. Three kinds of sets ([`views`]): exactly coplanar, noisy, and noisy along a
//! path. [`degenerate_pairs`] are the pairs at which engines for booleans break.

mod pairs;
mod random;
mod view;
mod world;

pub use pairs::{Pair, degenerate_pairs};
pub use view::{Camera, Kind, view, views};
pub use world::World;
