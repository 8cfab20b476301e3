//! Boxes in a tree: which come near a box, a segment, or each other.
//!
//! 1. Boxes are split at the median of their middles along the longest axis, until few are left
//!    (`build.rs`). Ties are broken by index, so the tree depends on nothing but the boxes.
//! 2. Questions walk the tree with a stack of their own (`walk.rs`); nothing recurses.
//!
//! [`LiveBvh`] is a tree whose boxes change (`live.rs`).
//!
//! What is found are candidates: boxes that touch, borders included. Never is one missed that does.

mod aabb;
mod build;
mod live;
mod walk;

pub use aabb::Aabb;
pub use build::Bvh;
pub use live::LiveBvh;
