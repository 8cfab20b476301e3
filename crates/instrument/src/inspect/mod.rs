//! Reading recordings back: what is in one, and whether two say the same.

mod content;
mod diff;
mod read;
mod summary;

pub use diff::{Difference, diff, fingerprint};
pub use summary::{EntityInfo, EventCount, Inspection, TimelineInfo, declared_events, inspect};
