//! One-sided: nothing counts as free that was not measured to be.
//!
//! 1. A face of the mesh and a face of the full grid overlap in a convex piece of the image. On it both
//!    are affine in inverse depth, `t` and `s`, and the distance from the one to the other along a ray is
//!    `d = (1/t - 1/s) l`, with the length `l` of the ray to depth 1. That is no affine function: across a
//!    deep step it is largest between pixels.
//! 2. Where the mesh lies beyond, `d` is largest on the border of a piece. On each line of the image with
//!    `s = k t`, `k > 1`, it is `(1 - 1/k) l / t`: the length of an affine vector by a positive affine
//!    number, which has no maximum inside a line. Such a line goes through every place of the piece.
//! 3. So it is enough to look along the sides of the mesh, cut where they cross the grid, and along the
//!    lines of the grid, cut at pixels and where they cross sides. On what is left all of `s` and `t` is
//!    two numbers each.
//!
//! | file | stage |
//! |---|---|
//! | `segments.rs` | these stretches of lines |
//! | `farthest.rs` | the largest distance on them |
//! | `withhold.rs` | vertices drawn towards the camera until it is small enough |

mod farthest;
mod segments;
mod withhold;

pub use farthest::outside_max_m;
pub(super) use withhold::withhold;
