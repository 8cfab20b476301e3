//! The extended polygon: local polygons on a pose graph, their vertices marked free inside each other
//! (\[Zie18\] 2.8).
//!
//! The step between the global polygon and the relative map. It has no global frame and corrects
//! nothing; loop closures are edges of the graph (2.8.2).
//!
//! 1. A scan becomes a local polygon on its vertex, with a frontier vertex in the middle of every
//!    edge that spans an occlusion (\[Zie18\] 2.4).
//! 2. Its corners are frontier, obstacle or free (eq. 2.2, 2.15). A corner is obstacle where a ray
//!    hit something; all others are frontier until a neighbour accounts for them (`corners`).
//! 3. The extended polygon grows along the graph, breadth first, each neighbour placed along the way
//!    by which it was met: one that intersects the polygon of the robot joins, and its neighbours are
//!    asked in turn; one that does not ends that way (eq. 2.13, 2.14, with the intersection that the
//!    text means where ∪ is printed) (`grow`).
//! 4. Frontier corners of members that lie inside another member are not on the boundary of the
//!    union: they are free from now on (eq. 2.15) (`grow`). Which is decided by membership in each
//!    other member; [`ExtendedMap::extended_polygon`] builds the union itself, for those who look.
//! 5. Goals are frontier corners of the polygon of the robot; else the way leads back along the
//!    graph, breadth first, to the nearest vertex that has one (2.9.3). A goal that cannot be reached
//!    straight is approached over its "normal point" by the policy.
//!
//! What is ours: a corner is inside only if it is by a centimetre, as in the relative map; a view that
//! does not go all round has a frontier corner in the middle of each of its two edges at the sensor,
//! which the thesis counts as obstacle where both rays hit: a robot that starts before a wall would
//! believe that it is done. A corner within 0.3 m of a wall that another member saw is settled, too:
//! the middle of an edge between two hits far along one wall lies on the wall. A withdrawn place edge marks everything anew.

mod corners;
mod grow;
mod map;

pub use corners::{Corner, CornerState};
pub use map::{ExtendedMap, ExtendedParams};
