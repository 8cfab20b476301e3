//! The relative map: local volumes on a pose graph, frontiers consolidated between volumes that are
//! near in the graph (\[ISRR19\] 4).
//!
//! 1. A scan becomes a local volume on its vertex, or is merged into the volume of the vertex that
//!    the robot turns on (`insert`).
//! 2. The scope is gathered: all vertices within the radius of the root along the graph, each placed
//!    along its shortest path (`posegraph::Scope`).
//! 3. Open frontier of either volume of a pair that lies inside the other is closed, in parts where
//!    need be (`pair`); then what is left along a wall that the other saw (`walls`).
//! 4. Which pairs: a new volume, those with itself; a place edge, those whose shortest path it
//!    changes (`incremental`).
//! 5. A withdrawn place edge opens again exactly what relied on it (`withdraw`).
//! 6. What is left is measured in chains; slivers do not count (`chains`).
//! 7. Volumes that add nothing are retired (`retire`).
//! 8. The policy's questions: frontiers in view, clearance, the way to the next frontier (`ask`);
//!    and a person's: why is this left, who removed that (`query`).
//!
//! Geometry never changes; only ledgers do, and a part that is closed stays closed unless a place
//! edge on the path that closed it is withdrawn.

mod ask;
mod book;
mod chains;
mod events;
mod incremental;
mod insert;
mod map;
mod pair;
mod params;
mod query;
mod retire;
mod state;
mod walls;
mod withdraw;

pub use book::{Closing, PathBook};
pub use chains::{Chain, ChainPart};
pub use events::{Cause, ConsolidationEvent, ReopenCause};
pub use map::RelativeMap;
pub use params::{Certainty, RelativeParams};
pub use query::{Fate, FrontierPiece, WhyLeft};
pub use state::VolumeState;
