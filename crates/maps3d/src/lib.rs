#![doc = include_str!("../README.md")]

#[doc = include_str!("../docs/depth.md")]
pub mod depth {}

pub mod global_union;
pub mod image;
pub mod plan;
pub mod quality;
pub mod reduce;
pub mod relative;
pub mod triangulate;
pub mod view;
pub mod voxels;

mod error;
mod events;
mod map;
mod pipeline;
mod tolerance;

pub use error::Maps3dError;
pub use events::{DepthEvent, Map3dProbe};
pub use global_union::{UnionCorrection, UnionEvent, UnionMap, UnionParams};
pub use map::{
    FlightClearance, FlightRoute, FrontierPatch, FrontierPoint, Hovering, Known, Look, Map3d,
    MapTally, MapWork, Sights,
};
pub use pipeline::{Made, ViewOptions, polyhedron, polyhedron_with};
pub use plan::{Algorithm, Heuristic, Plan, PlanEvent, PlanOptions, Planner, Target};
pub use relative::{
    ConsolidationEvent, FanOptions, FanSearch, FanWay, RelativeMap, RelativeParams,
};
pub use voxels::{VoxelMap, VoxelParams};
