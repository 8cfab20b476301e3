#![doc = include_str!("../README.md")]

mod columns;
mod depth;
mod error;
mod flight;
mod inspect;
mod layout;
mod optimisation;
mod options;
mod palette;
mod plan;
mod recorder;
mod recording;
mod replay;
mod solid;
mod stage;

pub use depth::{DEPTH_EVENTS, DepthRecording, DepthRecordingOptions};
pub use error::InstrumentError;
pub use flight::{FlightOptions, FlightRecorder, FlightRecording, FlightStep};
pub use inspect::{
    Difference, EntityInfo, EventCount, Inspection, TimelineInfo, declared_events, diff,
    fingerprint, inspect,
};
pub use optimisation::{DrawnPose, OPTIMIZER_EVENTS, OptimisationOptions, OptimisationRecording};
pub use options::{Centre, Every, Family, Level, MapOptions, RecordingOptions};
pub use plan::{PLAN_EVENTS, PlanRecording, PlanRecordingOptions};
pub use recorder::{Quarrel, Recorder, StepEnd};
pub use recording::Recording;
pub use replay::{KeyframeSeen, PLACE_EVENTS, ReplayOptions, ReplayRecording, SettledSeen};
pub use solid::{BooleanRecording, ReduceRecording, SolidOptions, TetrahedraRecording};
