//! Global polygons: what maps that unite views into one region have in common, and the map that
//! does so with corrected poses ([`CorrectedPolygons`]).
//!
//! [`CorrectedPolygons`] is the strongest map *with* loop closure: it knows walls to the lattice
//! instead of to a cell, and it is the way to a global map after the fact (\[Zie18\] 4.4). Its steps:
//!
//! 1. A scan becomes a local volume on its vertex, as in every other map ([`crate::volume`]).
//! 2. The volume is placed by the estimate of its vertex and united with the region by the overlay of
//!    the kernel: labels go along, obstacle wins (`corrected`). Every edge knows its vertex and its
//!    edge there ([`Tag`]).
//! 3. At a place recognition the whole pose graph is optimised ([`crate::correction`]), and all
//!    volumes are placed and united again.
//! 4. Open frontier is what is labelled so, but for what runs along a wall that another view saw, and
//!    what was given up; it is measured in chains, and slivers do not count (`open`).
//! 5. Goals are middles of chains in view; else the way there is planned on the dual graph
//!    (`planner`, `dual`; \[Mos15\] 4.3.1, 4.4.1): the region is cut into triangles, centres of gravity are
//!    joined over shared sides, middles of open chains are joined to their triangles, and A\* finds the
//!    nearest.
//!
//! The dual graph (`dual`):
//!
//! 1. constrained Delaunay triangulation of the region ([`geometry::planar::Triangulation`]);
//! 2. a node in the centre of gravity of every triangle (\[Mos15\] 4.3.1), an edge over every side that
//!    two triangles share. It leads over the middle of that side: the straight line between two
//!    centres may leave the two triangles;
//! 3. a node in the middle of every open chain, joined to the triangle that it lies at (\[Mos15\] 4.4.1);
//! 4. A\* from the triangle of the robot to the nearest of them, with the straight distance as estimate.
//!
//! A region can be seen as cells, too ([`cells_of`]): centres inside are free, obstacle edges make
//! occupied what they pass through.

mod corrected;
mod dual;
mod events;
mod given_up;
mod here;
mod open;
mod planner;
mod raster;
mod tag;

pub use corrected::{CorrectedPolygons, CorrectedPolygonsParams};
pub use dual::DualGraph;
pub use events::PolygonEvent;
pub(crate) use given_up::GivenUp;
pub(crate) use here::Here;
pub use open::{OpenChain, OpenFrontier, OpenParams, OpenPart};
pub(crate) use planner::GlobalPlanner;
pub use raster::cells_of;
pub(crate) use raster::global_of;
pub(crate) use tag::with_straight_walls;
pub use tag::{Tag, region_of};
