#![doc = include_str!("README.md")]

mod boundary;
mod clip;
mod error;
mod interval;
mod ledger;
mod membership;
pub mod overlay;
mod segments;
mod shrink;
mod star;
mod triangulation;

pub use boundary::{BoundaryEdge, BoundaryKind};
pub use error::PlanarError;
pub use interval::Interval;
pub use ledger::{Closed, EdgeLedger};
pub use membership::Sector;
pub use segments::{
    box_gap, near_segment, nearest_parameter, point_segment_distance, segment_segment_distance,
    segments_meet,
};
pub use star::StarPolygon;
pub use triangulation::{Triangle, Triangulation};
