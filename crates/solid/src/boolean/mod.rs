//! Union, intersection, difference and symmetric difference of labelled polyhedra.
//!
//! | step | file |
//! |---|---|
//! | 1. faces are numbered: one number for each label, or for each label and origin | `tags.rs` |
//! | 2. where that is asked for, or faces are coplanar up to rounding and the plain result is not sound, the faces of the second operand are moved a little, so that none is coplanar with one of the first; otherwise where that result meets itself, too, unless it does so where an operand does | `jitter.rs`, `trials.rs`, `compare.rs` |
//! | 3. an engine combines the operands and gives each face the number of the one it is part of; where it leaves a fold, two sheets on each other, another way to the same solid is taken; of two differences each gets the vertices that the other has on the curve where surfaces meet | `kernel.rs`, `manifold.rs`, `attempt.rs`, `matching.rs` |
//! | 4. numbers become labels and origins again; parts without volume and flat faces go | `leaves.rs` |
//! | 5. a frontier face is cut along the borders of what obstacle faces of the operands, looking the same way, cover of it; edges and faces are divided where vertices lie on them; pieces of frontier that coincide with obstacle become obstacle | `covered.rs`, `touching.rs`, `coincide.rs`, `surgery.rs` |
//! | 6. slivers go, where that is asked for ([`clean`](crate::clean)) | `combine.rs` |
//! | 7. many views are united one by one, each jittered first where they may be exactly coplanar; where the map meets itself, by steps 2 to 5 for each | `unite.rs`, `jitter.rs` |
//!
//! Operands in general position, whose surfaces only pass through each other, need none of what steps 3 to 5
//! do about contacts (`contacts.rs`). Every result is looked at for faces that meet, as far as it is new
//! (`changed.rs`): in general position the pieces that are so thin that rounding may turn them, and what was
//! divided at corners that one of two differences had and the other had not; otherwise all that no operand has.
//! Where faces meet a box with faces of an operand that meet, nothing else is tried: the operand met itself there
//! already. That takes O(n) for each of a few pairs.
//!
//! **Engine.** [`ManifoldKernel`] is `manifold-rust`, its exact engine by name: a port of Manifold,
//! which decides intersections by symbolic perturbation and so always gives a 2-manifold. Geometry is
//! right to about 1e-12 of the size of the operands. Where faces are coplanar only to rounding, as in a
//! turned copy, the engine's result may meet itself by as little, have sheets without volume, or lack a
//! part. There the plain result is held against one with the faces of the second operand moved outwards, for an
//! intersection inwards, by 1e-12 of the largest coordinate: so what was coplanar is on a known side and
//! leaves no sheet. Where volumes or areas differ, or faces meet, the moved one is the result; where that meets
//! itself, too, the move grows up to 1e-8 m. [`boolean_told`] says how far it went. [`Options::jitter_m`]
//! moves them in any case; then solids that touch are apart by the jitter in a symmetric difference, and
//! joined in a union. [`jittered`] moves the vertices of a view by chance, for unions of many. Another engine
//! is another [`Kernel`].
//!
//! **Labels.** Faces of different numbers are never merged. With numbers for labels alone, coplanar
//! neighbours of one label are, which leaves fewer faces; with origins, none are. Where faces of both
//! operands coincide, within [`Options::coincident_m`], the obstacle wins: exactly in the part that it
//! covers. The border of that part is right to a thousandth of that distance: a corner of a frontier face
//! that is so near to it is taken to lie on it. New corners are rounded once. What becomes obstacle by
//! this keeps the origin of the frontier face that it is part of.
//!
//! **Touching operands.** Where the result touches itself at an edge or a vertex, the vertices there
//! exist twice, at the same places: it is a 2-manifold by index. [`weld`](crate::mesh::weld) makes them
//! one. What has no volume is no solid: operands that touch have nothing in common.
//!
//! Source: \[Mos15\] 4 unites with Carve and does not say what becomes of labels on coincident faces;
//! here the obstacle wins.

mod attempt;
mod changed;
mod coincide;
mod combine;
mod compare;
mod contacts;
mod covered;
mod events;
mod jitter;
mod kernel;
mod leaves;
mod manifold;
mod matching;
mod surgery;
mod tags;
mod touching;
mod trials;
mod unite;

pub use coincide::{COINCIDENT_M, obstacle_wins};
pub use combine::{BooleanResult, Options, boolean, boolean_by, boolean_told, boolean_with};
pub use events::{BooleanEvent, CurveEdge};
pub(crate) use jitter::mixed;
pub use jitter::{JITTER_M, jittered};
pub use kernel::{Combined, Kernel, Operation, Refusal};
pub use manifold::ManifoldKernel;
pub use tags::Provenance;
pub use unite::{unite, unite_with};
