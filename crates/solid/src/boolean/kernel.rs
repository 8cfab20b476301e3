//! What an engine must do.

use std::fmt;

use crate::{Face, Point3, Polyhedron};

/// What is made of two solids A and B.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// What is in A or in B.
    Union,
    /// What is in A and in B.
    Intersection,
    /// What is in A and not in B.
    Difference,
    /// What is in exactly one of them.
    SymmetricDifference,
}

impl Operation {
    /// The operation's name, as it is typed.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersection => "intersection",
            Self::Difference => "difference",
            Self::SymmetricDifference => "symmetric-difference",
        }
    }
}

impl fmt::Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A mesh as an engine gives it: for each face the number of the operand's face it is part of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Combined {
    /// Vertices, metres.
    pub vertices: Vec<Point3>,
    /// Faces, counter-clockwise seen from outside.
    pub faces: Vec<Face>,
    /// The number that the operand's face had.
    pub tags: Vec<u32>,
}

/// Why an engine refused an operand, in its own words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal(pub String);

/// An engine for booleans.
///
/// Operands are closed 2-manifolds; faces carry numbers that must survive, and faces of different
/// numbers must not be merged.
pub trait Kernel {
    /// A solid as the engine holds it.
    type Solid;

    /// Takes a mesh, and a number for each of its faces.
    ///
    /// # Errors
    /// A [`Refusal`] where it is no closed 2-manifold.
    fn take(&self, mesh: &Polyhedron, tags: &[u32]) -> Result<Self::Solid, Refusal>;

    /// Unites, intersects or subtracts.
    ///
    /// # Errors
    /// A [`Refusal`] where the engine fails, or cannot do the operation by itself.
    fn combine(
        &self,
        a: &Self::Solid,
        b: &Self::Solid,
        operation: Operation,
    ) -> Result<Self::Solid, Refusal>;

    /// Gives a solid back as a mesh.
    fn give(&self, solid: &Self::Solid) -> Combined;
}
