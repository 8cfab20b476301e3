//! The relative map: local volumes on a pose graph, frontiers consolidated between volumes that are
//! near in the graph (\[ISRR19\] 4).
//!
//! 1. A scan becomes a local volume on its vertex, or is merged into the volume of the vertex that
//!    the robot turns on (`insert`).
//! 2. The scope is gathered: all vertices within the radius of the root along the graph, each placed
//!    along its shortest path (`posegraph::Scope`).
//! 3. Open frontier of either volume of a pair that lies inside the other is closed, in parts where
//!    need be (`pair`, `inside`); then what is left along a wall that the other saw (`walls`).
//! 4. Which pairs: a new volume, those with itself; a place edge, those whose shortest path it
//!    changes (`incremental`).
//! 5. A withdrawn place edge opens again exactly what relied on it (`withdraw`).
//! 6. What is left is measured in chains; slivers do not count (`chains`), unless they are parts of
//!    one frontier that several volumes have cut up between them (`slivers`).
//! 7. Volumes that add nothing are retired (`retire`).
//! 8. The policy's questions: frontiers in view, clearance, the way to the next frontier (`ask`);
//!    from another place (`vantage`); and a person's: why is this left, who removed that (`query`).
//! 9. Frontier that cannot be reached from its vertex is given up there, and the volume closes
//!    none of others any more (`ask`): what it sees has to be looked at from elsewhere.
//! 10. Before the robot believes that nothing is left, what was closed over unsure placement opens
//!     again, once (`last_look`).
//!
//! Geometry never changes; only ledgers do, and a part that is closed stays closed unless a place
//! edge on the path that closed it is withdrawn, or the volume that closed it is changed by another
//! scan, or falls silent, or the last look doubts it.

mod ask;
mod book;
mod chains;
mod events;
mod incremental;
mod insert;
mod inside;
mod last_look;
mod map;
mod pair;
mod params;
mod query;
mod retire;
mod slivers;
mod state;
mod vantage;
mod walls;
mod withdraw;

pub use book::{Closing, PathBook};
pub use chains::{Chain, ChainPart};
pub use events::{Cause, ConsolidationEvent, ReopenCause};
pub use map::RelativeMap;
pub use params::{Certainty, RelativeParams};
pub use query::{Fate, FrontierPiece, WhyLeft};
pub use state::VolumeState;
