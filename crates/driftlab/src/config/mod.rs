//! The config of an experiment: typed, checked, and able to say where each value came from.
//!
//! A config is a TOML file over built-in defaults, under `--world` and `--set`. Unknown keys and
//! values out of range are refused with file, line and column. A choice between kinds is a table
//! whose key is the kind (`[world.maze]`), so that a message points at the right line. Degrees are
//! allowed here and nowhere below.
//!
//! | file | what |
//! |---|---|
//! | `experiment`, `world`, `generators`, `robot`, `maps`, `planner`, `report` | the types and their defaults |
//! | `to_params` | the same as the algorithms want it, in radians |
//! | `replay` | how a log is replayed |
//! | `space` | the tables of a robot that flies |
//! | `load` | file and command line to a checked config |
//! | `source`, `document` | texts, spans, merging |
//! | `schema`, `limits`, `check`, `reach` | ranges, from the types' attributes and units; rules between keys |
//! | `shape` | lists where tables belong |
//! | `explain`, `error` | the messages |
//! | `axes` | what a sweep of an experiment varies |
//! | `graph_sweep` | the config of a sweep over pose graphs |
//! | `ladder` | the config of a ladder of reductions of one depth image |
//! | `typed` | a text read as a type that is no experiment |
//! | `show` | resolved config with origins, annotated defaults |

mod axes;
mod check;
mod document;
mod error;
mod experiment;
mod explain;
mod generators;
mod graph_sweep;
mod ladder;
mod limits;
mod load;
mod maps;
mod planner;
mod reach;
mod replay;
mod report;
mod robot;
mod schema;
mod shape;
mod show;
mod source;
mod space;
#[cfg(test)]
mod tests;
mod to_params;
mod typed;
mod world;
mod world_file;

pub use axes::{Axes, RunSweep};
pub use error::ConfigError;
pub use experiment::{Config, Start};
pub use generators::{CavesWorld, CorridorWorld, MazeWorld, Pillar, PillarsWorld, RoomsWorld};
pub use graph_sweep::{GraphSweep, OutlierSweep, Sweep, SyntheticGraph, is_graph_sweep};
pub use ladder::{Ladder, LadderDepth, Rungs};
pub use load::{Loaded, Overrides};
pub use maps::{
    ActiveAreaMap, CorrectedPolygonsMap, ExtendedMap, GridCorrectedMap, GridMap, Maps, Occlusion,
    Poses, RelativeMap, Twisted,
};
pub use planner::{Planner, RapidPlanner, SurveyPlanner};
pub use replay::{GraphSource, Replay};
pub use report::{Compare, Every, Level, Metrics, Record, Rule};
pub use robot::{Odometry, Places, Robot, Sensor};
pub use schema::{meaning, schema};
pub use show::{defaults_toml, origins, plain_toml, resolved_toml};
pub use source::{Origin, Place};
pub use space::{
    Camera, Cave3dWorld, GlobalUnionMap3d, Maps3d, MeshWorld, Metrics3d, Office3dWorld,
    Pillars3dWorld, Planner3d, Reduction, RelativeMap3d, Replay3d, Rooms3dWorld, VoxelsMap3d,
    Ways3d, World3d,
};
pub use world::{
    ImageWorld, MapServerWorld, MovingAiWorld, PaperMap, PaperWorld, PolygonsWorld, ThesisMap,
    ThesisWorld, World,
};
pub use world_file::{never_ends, world_kind_of_file};
