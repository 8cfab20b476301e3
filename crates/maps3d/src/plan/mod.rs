#![doc = include_str!("../../docs/plan.md")]

mod bottleneck;
mod corridor;
mod events;
mod frontier;
mod graph;
mod landmarks;
mod nearest;
mod obstacles;
mod options;
mod planner;
mod route;
mod shorten;
mod space;

pub use bottleneck::{Passage, passage};
pub(crate) use corridor::polyline_m;
pub use corridor::{Corridor, Knot, Miss};
pub use events::PlanEvent;
pub use frontier::FrontierNode;
pub use graph::{DualGraph, Gate, NodeId};
pub(crate) use obstacles::between;
pub use obstacles::{Near, Obstacles};
pub use options::{Algorithm, Heuristic, PlanOptions, Target};
pub use planner::{Plan, Planner};
pub use space::{Exit, FrontierFace, Space};
pub(crate) use space::{FansKnown, nudged};
