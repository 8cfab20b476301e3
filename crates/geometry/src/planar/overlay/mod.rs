//! Overlay: union, intersection and difference of labelled regions.
//!
//! Two maps of one place, or a map and a new view, become one region whose edges still say what
//! they are and where they come from. The steps:
//!
//! 1. **Snap** (`lattice`): corners go to a lattice of 1 µm. All that follows is decided in integers,
//!    so that no input can confuse it.
//! 2. **Split and classify** (`operate`): edges are cut where they meet, and kept where exactly one
//!    of their sides belongs to the result. This is the work of the library `i_overlay`, which carries
//!    a payload along every piece: the number and the label of the input edge.
//! 3. **Merge** (`operate`): where edges of several inputs coincide, one stays: obstacle wins over
//!    frontier, frontier over free; among equals the one that came first.
//! 4. **Stitch** (`operate`): pieces become rings, outer ones counter-clockwise with what is inside
//!    to their left, holes clockwise, each ring followed by its holes ([`Region`]).
//! 5. **Tell** (`events`): where the boundary goes over from one input to the other, the corner is an
//!    entry or an exit by the sign of the cross product (\[Zie18\] 2.6.2, eq. 2.11), the two edges
//!    there are merged, and every ring is a loop (\[Zie18\] 2.6.3). The thesis walks line by line; we
//!    read the same three lists off the result.
//!
//! For many small overlays of plain rings on a grid of the caller's there is [`StepOverlay`]: the same
//! engine, without labels and sources.
//!
//! What holds: every output edge lies on its source edge, but for the lattice; output edges that come
//! from one input edge do not overlap; rings close; areas are exact up to 1 µm along the boundary; no
//! input panics; same input, same bytes. Cost: O(n log n) for n edges and few crossings.
//!
//! ```
//! use geometry::Point2;
//! use geometry::planar::overlay::{EdgeLabel, Region, RingEdge, union};
//!
//! let square = |x: f64, label| {
//!     let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
//!     Region::from_ring(corners.map(|(dx, y)| (Point2::new(x + dx, y), RingEdge { label, data: x })))
//! };
//! let both = union(&square(0.0, EdgeLabel::Frontier), &square(1.0, EdgeLabel::Obstacle))?;
//! assert!((both.region.area_m2() - 6.0).abs() < 1e-9);
//! // Where the lower sides coincide, obstacle wins.
//! let lower = both.region.edges().filter(|edge| edge.from.y == 0.0 && edge.to.y == 0.0);
//! let solid_m: f64 = lower
//!     .filter(|edge| edge.label == EdgeLabel::Obstacle)
//!     .map(|edge| (edge.to - edge.from).norm())
//!     .sum();
//! assert!((solid_m - 2.0).abs() < 1e-9);
//! # Ok::<(), geometry::planar::PlanarError>(())
//! ```

mod events;
mod lattice;
mod operate;
mod region;
mod steps;

pub use events::OverlayEvent;
pub use lattice::{LATTICE_M, REACH_M};
pub use operate::{
    Operation, Overlay, Source, difference, intersection, overlay, overlay_with, union, union_all,
};
pub use region::{EdgeLabel, Region, RegionEdge, Ring, RingEdge, winding};
pub use steps::{MOST_STEPS, StepOverlay, StepRings, twice_area};
