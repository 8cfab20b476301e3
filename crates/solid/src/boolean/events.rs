//! What a probe sees of a boolean.

use super::Operation;
use crate::{Point3, Polyhedron};

/// An edge of the curve along which the surfaces of the operands meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveEdge {
    /// Its ends, metres.
    pub ends: [Point3; 2],
    /// The faces of the result beside it: the one from the first operand first.
    pub faces: [u32; 2],
}

/// Facts about a running boolean, in the past tense.
#[derive(Clone, Copy, Debug)]
pub enum BooleanEvent<'a> {
    /// The operands were taken.
    Started {
        /// What is made of them.
        operation: Operation,
        /// The first operand.
        a: &'a Polyhedron,
        /// The second operand.
        b: &'a Polyhedron,
    },
    /// The engine was done; labels are those of the operands' faces.
    Combined {
        /// The result so far.
        mesh: &'a Polyhedron,
        /// For each face whether it comes from the first operand (0) or the second (1).
        operand_of: &'a [u8],
        /// Where the surfaces of the operands meet.
        curve: &'a [CurveEdge],
    },
    /// Frontier faces that coincide with obstacle faces in part were cut, and what coincides was made
    /// obstacle.
    Settled {
        /// The mesh after it.
        mesh: &'a Polyhedron,
        /// The faces of it that became obstacle, ascending.
        faces: &'a [u32],
    },
    /// A pass of cleaning was done.
    Cleaned {
        /// The mesh after it.
        mesh: &'a Polyhedron,
        /// Where vertices were taken out, metres.
        removed: &'a [Point3],
        /// How many removals were undone because faces would have met.
        undone: usize,
    },
    /// The result.
    Finished {
        /// The mesh.
        mesh: &'a Polyhedron,
    },
}

probe::variants!(BooleanEvent<'_>: Started, Combined, Settled, Cleaned, Finished);
