//! Made-up graphs of any size, with the poses that they were made from.
//!
//! 1. Poses are laid out: on a [`sphere`](fn@sphere), a [`torus`](fn@torus), a [`lattice`](fn@lattice), a [`ring`](fn@ring), or by a walk along the
//!    streets of a town ([`manhattan`], [`city`]).
//! 2. Pairs are chosen: each pose and the next, and loop closures where the robot comes near an
//!    earlier pose. Edges stand in the order in which a robot would find them, so that a graph can
//!    be fed pose by pose.
//! 3. Each pair is measured with Gaussian noise in the tangent space, `Z = Xi⁻¹ Xj exp(n)`, from one
//!    seeded stream; the information is the inverse covariance of that noise, in g2o's scaling, so
//!    that `χ²` per degree of freedom is about 1 at the optimum.
//! 4. The start values are the odometry chained from the first true pose, as graph files have them.
//! 5. On demand, wrong loop closures are added to any graph ([`with_outliers`],
//!    [`with_wrong_closures`]), and what a method made of them is judged ([`WithOutliers::judge`]).
//!
//! The same parameters give the same graph. The layouts follow the public graphs of the same names
//! (sphere and torus: Kaess; Manhattan: Olson 2006; city: Kaess 2012).

mod judgement;
mod lattice;
mod measure;
mod outliers;
mod ring;
mod surfaces;
mod walk;

pub use judgement::Judgement;
pub use lattice::{Lattice, lattice};
pub use measure::{Noise, Synthetic};
pub use outliers::{WithOutliers, Wrong, with_outliers, with_wrong_closures};
pub use ring::{Ring, ring};
pub use surfaces::{Sphere, Torus, sphere, torus};
pub use walk::{Walk, city, manhattan, walk};
