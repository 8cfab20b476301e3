#![doc = include_str!("../README.md")]

mod candidates;
mod consistency;
mod descriptor;
mod events;
mod keyframe;
mod links;
pub mod matching;
mod params;
mod place;
mod recognizer;
mod settle;
mod verify;

pub use candidates::Candidate;
pub use events::{Matched, PlaceEvent};
pub use keyframe::{Keyframe, SurfacePoint};
pub use links::{Measured, Seen};
pub use params::{
    CandidateParams, KeyframeParams, MatchParams, OdometryNoise, PlaceParams, RejectionParams,
};
pub use recognizer::{Added, Closure, Driven, Recognizer, Tally};
pub use settle::Settled;
pub use verify::Verdict;
