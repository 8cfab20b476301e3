//! Local volumes from scans (\[ISRR19\] 4.1, \[Zie18\] 2.4).
//!
//! 1. Every ray becomes a [`Sample`]: where it ended, and whether it hit something ([`samples`]).
//! 2. Samples are put into the order of their bearings; scans that were taken while turning in place
//!    interleave with those before them ([`samples`]).
//! 3. Options of \[Zie18\] 2.4: samples that lie close together are thinned, and a vertex is put into
//!    each edge that spans an occlusion ([`options`]).
//! 4. Samples become the vertices of a star polygon, its edges are labelled obstacle or frontier
//!    (`build`), and what bounds it is indexed by direction (`rim`).
//!
//! A volume never changes after it is built; what becomes of its frontier edges is kept in their
//! ledgers by the map.

pub mod build;
mod events;
mod local;
pub mod options;
mod rim;
pub mod samples;

pub use build::{VolumeParams, build};
pub use events::VolumeEvent;
pub(crate) use events::tell_of_volume;
pub use local::{EdgeKey, FrontierEdge, LocalVolume, ObstacleEdge};
pub use options::{OcclusionRule, Options};
pub(crate) use rim::Rim;
pub use samples::{Sample, Samples};
