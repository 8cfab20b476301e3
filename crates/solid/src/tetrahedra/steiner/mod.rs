//! Points that the input does not have.
//!
//! | file | what it does |
//! |---|---|
//! | `insert.rs` | puts a point into a mesh that is not Delaunay |
//! | `unlock.rs` | a free point beside a knot, so that flips get through |
//! | `split.rs` | a point on a constraint, for the time being: its parts are easier to bring in |
//! | `suppress.rs` | takes it off the constraint again, by free points beside it |
//! | `remove.rs` | is rid of free points where their holes can be filled without them |
//!
//! In the end none lies on the boundary.

mod insert;
mod remove;
mod split;
mod suppress;
mod unlock;

pub(crate) use split::Split;
