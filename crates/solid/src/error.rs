//! What can be wrong with solid input.

/// Why a mesh was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// There must be one label per face.
    #[error("{faces} faces but {labels} labels")]
    LabelCount {
        /// How many faces were given.
        faces: usize,
        /// How many labels were given.
        labels: usize,
    },
    /// There must be one origin per face.
    #[error("{faces} faces but {origins} origins")]
    OriginCount {
        /// How many faces the mesh has.
        faces: usize,
        /// How many origins were given.
        origins: usize,
    },
    /// More vertices or faces than an index can tell apart.
    #[error("{found} {what}, at most {limit}")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A coordinate is NaN, infinite, or too large or too small to decide exactly.
    #[error(
        "vertex {vertex} at ({x}, {y}, {z}): coordinates must be 0 or of magnitude 1e-45 to 1e50"
    )]
    OutsideEnvelope {
        /// The vertex.
        vertex: usize,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
        /// Its z, metres.
        z: f64,
    },
    /// A face names a vertex that is not there.
    #[error("face {face} has vertex {vertex} as a corner, but there are {vertices} vertices")]
    UnknownVertex {
        /// The face.
        face: usize,
        /// The index that it names.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A face names the same vertex twice.
    #[error("face {face} has vertex {vertex} as a corner twice")]
    RepeatedCorner {
        /// The face.
        face: usize,
        /// The vertex that it names twice.
        vertex: u32,
    },
    /// An operand of a boolean is no closed 2-manifold.
    #[error("the {which} operand is no closed 2-manifold: {defect}")]
    Operand {
        /// Which operand.
        which: String,
        /// The first thing that is wrong with it.
        defect: String,
    },
    /// The engine failed at sound operands.
    #[error("the engine failed at the {operation}: {reason}")]
    Engine {
        /// What it was doing.
        operation: &'static str,
        /// Its own words.
        reason: String,
    },
}
