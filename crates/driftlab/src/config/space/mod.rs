//! What a config says of a flight through space: the tables that end in `3d`, and `[camera]`.
//!
//! A config with `[world3d]` is a flight. `[robot]`, `[odometry]`, `[places]`, `[record]` and `[sweep]` mean
//! what they mean in the plane; `[sensor]`, `[map]`, `[planner]` and `[metrics]` are of the plane alone.
//!
//! | file | what |
//! |---|---|
//! | `world`, `generators` | the place |
//! | `camera`, `maps`, `planner` | the robot's eye, its maps, how it chooses; how belief is judged |
//! | `replay` | how depth images of a log are taken |
//! | `check` | rules between keys |
//! | `to_params` | the same as the algorithms want it, in radians |

mod camera;
mod check;
mod generators;
mod maps;
mod planner;
mod replay;
mod to_params;
mod world;

pub use camera::Camera;
pub(super) use check::{faults, is_only_of_the_plane};
pub use generators::{Cave3dWorld, Office3dWorld, Pillars3dWorld, Rooms3dWorld};
pub use maps::{GlobalUnionMap3d, Maps3d, RelativeMap3d, VoxelsMap3d};
pub use planner::{Metrics3d, Planner3d, Ways3d};
pub use replay::{Reduction, Replay3d};
pub use world::{MeshWorld, World3d};
