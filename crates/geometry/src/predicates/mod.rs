//! Exact predicates: every branch that decides topology asks one of these.
//!
//! A floating filter answers nearly always; where it cannot be sure, Shewchuk's adaptive
//! arithmetic (crate `robust`) decides.
//!
//! | file | what it decides |
//! |---|---|
//! | `orientation.rs` | on which side of a line a point lies |
//! | `bearing.rs` | which of two directions comes first |
//! | `precise.rs` | nothing: it measures the same determinants to about 100 bits |
//!
//! **Envelope.** The signs are exact for coordinates that are zero or of magnitude
//! [`SMALLEST`]`..=`[`LARGEST`]. Outside of it a product may underflow or overflow; NaN gives NaN.

mod bearing;
mod orientation;
mod precise;

pub use bearing::{compare_bearing_from, same_direction, sort_by_bearing};
pub(crate) use bearing::{half_turn_or_more, nearer_on_ray};
pub use orientation::{LARGEST, SMALLEST, cross, cross_sign, in_envelope, orient, sign};
pub use precise::{cross_precise, orient_precise};
