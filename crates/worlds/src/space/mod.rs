//! Places of space: triangles, and generators that draw them from a seed.
//!
//! | file | what |
//! |---|---|
//! | `world.rs` | `World3d`: triangles, bounds, a start; rays and distances through a tree |
//! | `open_place.rs` | the most open place that is closed in, for meshes that name no start |
//! | `blocks.rs` | right-angled places: blocks added and carved, their border as triangles |
//! | `rooms.rs` | rooms on both sides of a corridor, with doors, windows and furniture |
//! | `office.rs` | storeys over each other, joined by stairs in two stairwells |
//! | `pillars.rs` | a hall with round pillars and stumps |
//! | `cave.rs` | chambers and tunnels with smooth uneven walls, by marching tetrahedra |
//! | `tetrahedra.rs` | the surface of a function, by marching tetrahedra |

mod blocks;
mod cave;
mod office;
mod open_place;
mod pillars;
mod rooms;
mod tetrahedra;
mod world;

pub use cave::{Cave3dParams, cave};
pub use office::{Office3dParams, office};
pub use pillars::{Pillars3dParams, pillars};
pub use rooms::{Rooms3dParams, rooms};
pub use world::World3d;
