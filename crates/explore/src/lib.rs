#![doc = include_str!("../README.md")]

mod events;
mod explorer;
mod motion;
mod params;
mod rapid;

pub use events::{Ending, ExploreProbe, GiveUp, GraphEvent, PlannerEvent, State};
pub use explorer::{Explorer, StepReport};
pub use params::{ExploreParams, Policy, RapidParams};
