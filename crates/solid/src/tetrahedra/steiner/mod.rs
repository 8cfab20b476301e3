//! Points that the input does not have.
//!
//! | file | what it does |
//! |---|---|
//! | `insert.rs` | puts a point into a mesh that is not Delaunay |
//! | `split.rs` | a point on a constraint, for the time being: its parts are easier to bring in |
//! | `suppress.rs` | takes it off the constraint again, by free points beside it |
//! | `bypass.rs` | the same on a segment whose facets are not looked for yet |
//! | `room.rs`, `kernel.rs` | a place for such a point: the deepest behind all walls of a hole |
//! | `shed.rs` | takes edges away from a point, by flips |
//! | `remove.rs` | is rid of free points where their holes can be filled without them |
//!
//! In the end none lies on the boundary.

mod bypass;
mod insert;
mod kernel;
mod remove;
mod room;
mod shed;
mod split;
mod suppress;

pub(crate) use split::Split;
