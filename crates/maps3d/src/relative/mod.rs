//! The relative map of space: star-shaped polyhedra on a pose graph, frontier consolidated between views
//! that are near in the graph (\[ISRR19\] 4.3, 4.4).
//!
//! | file | what |
//! |---|---|
//! | `map.rs` | the map, and its answers to the trait |
//! | `insert.rs` | a look becomes a view, and is held against those around |
//! | `volume.rs`, `cells.rs` | the polyhedron of a view, kept small; what lies in a direction |
//! | `state.rs`, `ledger.rs` | a view, and what of its frontier is open |
//! | `grid.rs` | the grid of a face, on which areas are whole numbers |
//! | `slice.rs` | what of a face lies inside another volume |
//! | `pair.rs` | two views held against each other |
//! | `doubt.rs`, `drift.rs` | whether two views contradict each other; how much odometry drifts |
//! | `incremental.rs`, `farther.rs` | which pairs, after edges came, and before frontier is given up |
//! | `book.rs`, `withdraw.rs` | who closed what along which path; taken back |
//! | `parts.rs`, `samples.rs` | frontier that hangs together; as points |
//! | `ask.rs`, `clearance.rs`, `distance.rs` | the policy's questions |
//! | `fans.rs` | free space around a vertex as tetrahedra |
//! | `fan_way.rs`, `fan_to.rs` | the way to the nearest frontier through them; to a place |
//! | `straight.rs` | a way through several volumes without bends that it can do without |
//! | `events.rs`, `params.rs` | what can be watched, what can be chosen |

#![doc = include_str!("../../docs/relative.md")]

mod ask;
mod book;
mod cells;
mod clearance;
mod distance;
mod doubt;
mod drift;
mod events;
mod fan_to;
mod fan_way;
mod fans;
mod farther;
mod grid;
mod incremental;
mod insert;
mod ledger;
mod map;
mod pair;
mod params;
mod parts;
mod samples;
mod slice;
mod state;
mod straight;
mod volume;
mod withdraw;

pub use book::{Book, Cause, Closing, ClosingId};
pub use events::ConsolidationEvent;
pub use fan_way::{FanOptions, FanSearch, FanWay};
pub use grid::{FaceGrid, STEPS, TWICE_AREA};
pub use ledger::OpenPart;
pub use map::RelativeMap;
pub use params::RelativeParams;
pub use parts::{FrontierPart, Piece};
pub use state::{GivenUp, ViewState};
pub use volume::LocalVolume;
