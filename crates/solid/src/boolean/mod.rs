//! Union, intersection, difference and symmetric difference of labelled polyhedra.
//!
//! | step | file |
//! |---|---|
//! | 1. faces are numbered: one number for each label, or for each label and origin | `tags.rs` |
//! | 2. an engine combines the operands and gives each face the number of the one it is part of | `kernel.rs`, `manifold.rs` |
//! | 3. numbers become labels and origins again; a frontier face that coincides with an obstacle face of an operand, looking the same way, becomes obstacle | `coincide.rs` |
//! | 4. the pieces of a symmetric difference are laid side by side; where they share a surface, the intersection is cut out of the union instead | `combine.rs` |
//! | 5. slivers go, where that is asked for ([`clean`](crate::clean)) | `combine.rs` |
//! | 6. many views are united one by one, each jittered first where they may be exactly coplanar | `unite.rs`, `jitter.rs` |
//!
//! **Engine.** [`ManifoldKernel`] is `manifold-rust`, its exact engine by name: a port of Manifold,
//! which decides intersections by symbolic perturbation and so always gives a 2-manifold. Geometry is
//! right to about 1e-12 of the size of the operands; where faces are coplanar to rounding, the result
//! may intersect itself by as little. [`jittered`] moves the vertices of each view by 1e-8 m, seeded by
//! the view, and then a union or an intersection does not; a difference leaves slivers between such faces and may. Another engine is another [`Kernel`].
//!
//! **Labels.** Faces of different numbers are never merged. With numbers for labels alone, coplanar
//! neighbours of one label are, which leaves fewer faces; with origins, none are. Where an obstacle
//! face coincides with only a part of a frontier face, the middle of the frontier face decides for all
//! of it.
//!
//! **Touching operands.** Where the result touches itself at an edge or a vertex, the vertices there
//! exist twice: it is a 2-manifold by index. [`weld`](crate::mesh::weld) makes them one.
//!
//! Source: \[Mos15\] 4 unites with Carve and does not say what becomes of labels on coincident faces;
//! here the obstacle wins.

mod coincide;
mod combine;
mod events;
mod jitter;
mod kernel;
mod manifold;
mod tags;
mod unite;

pub use coincide::{COINCIDENT_M, obstacle_wins};
pub use combine::{Options, boolean, boolean_by, boolean_with};
pub use events::{BooleanEvent, CurveEdge};
pub(crate) use jitter::mixed;
pub use jitter::{JITTER_M, jittered};
pub use kernel::{Combined, Kernel, Operation, Refusal};
pub use manifold::ManifoldKernel;
pub use tags::Provenance;
pub use unite::{unite, unite_with};
