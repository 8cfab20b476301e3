#![doc = include_str!("../README.md")]

pub mod boolean;
pub mod bvh;
pub mod mesh;
pub mod predicates;
pub mod query;
pub mod reduce;
pub mod synthetic;
pub mod tetrahedra;
pub mod validity;

mod error;

pub use boolean::{BooleanEvent, Operation, boolean, boolean_with, jittered, unite, unite_with};
pub use error::SolidError;
pub use mesh::{AreaByLabel, Face, Label, Origin, Polyhedron};
pub use query::{Hit, Side, Solid};
pub use reduce::{ReduceEvent, Reduced, clean, reduce, reduce_with};
pub use tetrahedra::{Tetrahedra, TetrahedraEvent, tetrahedralize, tetrahedralize_with};
pub use validity::{Contact, Crossing, Defect, Validity, check, crossings};

/// A point of space, metres; its frame is in the name of the variable.
pub type Point3 = nalgebra::Point3<f64>;
/// A vector of space, metres.
pub type Vector3 = nalgebra::Vector3<f64>;
