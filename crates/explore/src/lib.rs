#![doc = include_str!("../README.md")]

mod events;
mod explorer;
pub mod flight;
mod motion;
mod params;
mod rapid;

pub use events::{Ending, ExploreProbe, GiveUp, GraphEvent, PlannerEvent, State};
pub use explorer::{Explorer, StepReport};
pub use flight::{
    FlightEvent, FlightExplorer, FlightGiveUp, FlightParams, FlightProbe, FlightReport, Ways,
    WaysTally,
};
pub use params::{ExploreParams, Policy, RapidParams};
