//! The project's own reduction: few faces in inverse depth, judged in metres.
//!
//! A plane of space is affine in inverse depth, so a wall costs two faces at any viewing angle. See
//! `docs/depth.md` of the crate for the numbered steps.
//!
//! | file | stage |
//! |---|---|
//! | `options.rs` | what it goes by |
//! | `guide.rs` | the image that vertices are chosen by: a median of nine |
//! | `delaunay.rs` | a Delaunay triangulation that grows pixel by pixel, in whole numbers |
//! | `plane.rs` | the lifted plane of a face, and the distance of a pixel from it |
//! | `scan.rs` | the distance of every pixel of a face from its lifted plane |
//! | `summed_distance.rs` | what a face costs: the summed distance of its pixels |
//! | `grow.rs` | greedy insertion |
//! | `thin.rs` | vertices taken out again, for few of them |
//! | `flips.rs` | sides turned where that brings faces nearer to the pixels |
//! | `fit.rs` | depths of vertices fitted to all pixels |

mod delaunay;
mod fit;
mod flips;
mod grow;
mod guide;
mod options;
mod plane;
mod scan;
mod summed_distance;
mod thin;

pub(in crate::reduce) use delaunay::in_circle;
pub(super) use grow::grow;
pub use options::InverseDepth;
pub(crate) use plane::LiftedPlane;
