//! Places made by rule, most of them from a seed: the same parameters give the same place, byte for
//! byte, on every machine.
//!
//! | module | place | drawn as |
//! |---|---|---|
//! | `rooms` | rooms in rows and columns, joined by doors | cells |
//! | `maze` | a maze with one way between any two places, or some loops | cells |
//! | `caves` | caves with ragged walls | cells |
//! | `pillars` | a hall with pillars | polygons |
//! | `corridor` | a corridor around a block (\[Zie18\] fig. 2.15) | polygons |
//!
//! In all of them free space hangs together.

mod caves;
mod corridor;
pub(crate) mod draw;
mod maze;
mod pillars;
pub(crate) mod range;
mod rooms;

pub use caves::{CavesParams, caves, caves_cells};
pub use corridor::{CorridorParams, corridor};
pub use maze::{MazeParams, maze, maze_cells};
pub use pillars::{PillarShape, PillarsParams, pillars};
pub use rooms::{RoomsParams, rooms, rooms_cells};
