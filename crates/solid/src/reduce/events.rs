//! What a probe sees of a reduction.

use super::Reduced;
use crate::{Point3, Polyhedron};

/// Facts about a running reduction, in the past tense.
#[derive(Clone, Copy, Debug)]
pub enum ReduceEvent<'a> {
    /// The mesh was taken; nothing has changed.
    Started {
        /// The mesh.
        mesh: &'a Polyhedron,
    },
    /// A vertex was taken out.
    Collapsed {
        /// Where it was, metres.
        from: Point3,
        /// The vertex that it was drawn into, metres.
        to: Point3,
        /// Faces that are left.
        faces: usize,
        /// The greatest error so far, metres.
        error_m: f64,
    },
    /// The number of faces has halved again.
    Halved {
        /// The mesh at hand.
        mesh: &'a Polyhedron,
        /// The greatest error so far, metres.
        error_m: f64,
    },
    /// The reduction ended.
    Finished {
        /// What came of it.
        reduced: &'a Reduced,
    },
}

probe::variants!(ReduceEvent<'_>: Started, Collapsed, Halved, Finished);
