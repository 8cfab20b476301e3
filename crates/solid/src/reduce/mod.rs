//! Fewer faces for a united map: labels, topology and validity kept, the error bounded.
//!
//! Vertices are taken out one by one: a vertex is drawn along an edge into its neighbour, the two faces
//! at the edge vanish, the others at the vertex follow it (half-edge collapse). Vertices that stay do
//! not move.
//!
//! | step | file |
//! |---|---|
//! | 1. every vertex gets an error quadric: area times squared distance to the planes of its faces | `quadric.rs` |
//! | 2. directed edges wait in a heap, the cheapest first; equal costs in the order of vertices | `collapse.rs` |
//! | 3. the link condition: the surface stays the 2-manifold that it is (`star.rs`) | `star.rs` |
//! | 4. labels: a vertex between regions goes only along the border between them, and no farther from it than the bound | `border.rs` |
//! | 5. no new face is flat or turned over | `collapse.rs` |
//! | 6. the bound: every original vertex is kept with a face, and stays within the bound of the face that it is kept with | `bound.rs` |
//! | 7. no new face meets another face beyond common corners and edges; exact | `collapse.rs` |
//!
//! What fails a test is left as it is, until something near it changes. The error that is told is
//! measured: the greatest distance of an original vertex from the face that it is kept with, which is no
//! less than its distance from the result. As the result's vertices are original ones, the distance
//! the other way is zero at vertices.
//!
//! [`clean`] is the same for edges shorter than a length: slivers that booleans leave go, and nothing
//! else changes. Faces that are thin without a short edge stay.
//!
//! **Limits.** The bound holds at original vertices, not between them. A mesh that intersects itself
//! is not mended: where it does, nothing is taken out. Origins are dropped, since the faces are no
//! longer parts of those that they came from.
//!
//! Sources: Garland and Heckbert 1997 for quadrics; Dey, Edelsbrunner, Guha and Nekhayev 1999 for the
//! link condition; \[Mos15\] 6.4 names the reduction of a united map as what is missing.

mod border;
mod bound;
mod collapse;
mod events;
mod quadric;
mod run;
mod star;

pub use events::ReduceEvent;
pub use run::{Cleaned, Goal, Reduced, Refusals, clean, reduce, reduce_with};
