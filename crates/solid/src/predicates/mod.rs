//! Exact predicates: every branch that decides topology asks one of these.
//!
//! A floating filter answers nearly always; where it cannot be sure, Shewchuk's adaptive
//! arithmetic (crate `robust`) decides.
//!
//! | file | what it decides |
//! |---|---|
//! | `orient.rs` | on which side of a plane or of a projected line a point lies |
//! | `contact.rs` | where a segment meets a triangle, and whether a point lies on one |
//!
//! **Envelope.** The signs are exact for coordinates that are zero or of magnitude
//! [`SMALLEST`]`..=`[`LARGEST`], small enough for the fifth powers of an in-sphere test.

mod contact;
mod orient;

pub use contact::{SegmentContact, in_triangle, on_segment, segment_meets_triangle};
pub use orient::{
    LARGEST, SMALLEST, facing_axis, in_envelope, is_collinear, orient_dropping, orient3, sign,
};
