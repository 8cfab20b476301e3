//! The active area: one global polygon, merged only where the robot has been lately
//! (\[Zie18\] 2.5 to 2.7).
//!
//! The first form of the thesis, with its failures: they are why the later forms exist. Known space
//! is bounded by rings: outer ones run counter-clockwise here, inner ones clockwise (the thesis has it
//! the other way round; what is known lies to the left). Every corner is anchored to the vertex of
//! the pose graph that it was seen from.
//!
//! 1. **Active area** (2.7.1, eq. 2.8, 2.9): the corners anchored to vertices at most `area_edges`
//!    edges of the graph away from the robot (`area`).
//! 2. **Doubly seen space** (2.7.5): rings that the new view may meet are searched for crossings of
//!    their own active edges first, and split there (`untwist`). A part that is known twice is
//!    *upended*: it is turned round, or removed, as [`Twisted`] says. A part of what is known that was
//!    turned inside out is turned back.
//! 3. **Walls**: frontier of the view along walls that the area saw before, and frontier of the area
//!    along walls of the view, is settled: that part of the edge is free from then on (`walls`). Not in
//!    the thesis. Where rays graze a wall they end far apart, and between them a view has frontier on the
//!    wall itself; the union may swallow the wall that another view saw there and keep the frontier.
//! 4. **Union** (2.6, 2.7.2): active edges are intersected with the view; where of an entry and its
//!    exit only one was found, the ring is followed on, past the area, until the other is
//!    (eq. 2.10, 2.11). At an entry the boundary goes over to the view, at an exit back
//!    (eq. 2.6), and loops are collected (`unite`). Intersection points become corners or are left out
//!    (2.7.4). Overlaps outside the area stay: two sheets over one place. A view that meets several
//!    sheets would leave one while it is still on another. Then those that cross inside the area are
//!    merged first (`sheets`; 2.7.3); where the area does not hold enough of them, one sheet takes the
//!    view, and on the others what was frontier inside it is settled (`apart`).
//! 5. **Loop closure** (2.7.3): the pose graph is optimised at every place recognition
//!    ([`crate::correction`]); every corner moves with its anchor (eq. 2.12); inner rings that were
//!    twisted by it are split; active parts that now overlap are merged, which is the same split.
//! 6. **Frontier** is what is labelled so on any ring; reachability is judged inside the area only
//!    (2.9.2): goals in view, then ways on the dual graph of what the area's views saw
//!    ([`crate::polygons`]), views that add nothing to it left out (`ways`); then back along the graph
//!    to the nearest vertex with frontier (2.9.3). A goal that ways led to too often is given up (`aims`).
//!
//! **It fails** where the area is too small to hold both sides of an overlap, or so big that it merges
//! both sides of a wall that drift has laid over each other (2.7.5). What can be noticed of that is
//! noticed: entries without exits, loops that do not close, a robot outside its own map. The union
//! is not made then, the map says [`PolygonEvent::Invalid`](crate::polygons::PolygonEvent), and
//! counts it ([`ActiveArea::invalid`]).
//!
//! Where the thesis is silent: views are pulled in by the strictness margin and their corners moved by
//! up to a tenth of a millimetre, fixed by vertex and corner, so that "point on a line" and "parallel"
//! (2.6.4) do not happen but by chance; side tests are exact. Every walk is bounded by the number of
//! corners, so it always ends.
//!
//! A step costs what the area holds, but for a walk along all corners of the map to see which of them
//! are active, and but for the optimisation of the whole pose graph at a place recognition.

mod aims;
mod apart;
mod area;
mod map;
mod rings;
mod sheets;
mod unite;
mod untwist;
mod walls;
mod ways;

pub use map::{ActiveArea, ActiveAreaParams};
pub use rings::Corner;
pub use unite::Broken;
pub use untwist::Twisted;
