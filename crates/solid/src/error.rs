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
        "vertex {vertex} at ({}, {}, {}): coordinates must be 0 or of magnitude 1e-45 to 1e50",
        shown(*.x), shown(*.y), shown(*.z)
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
    /// No four of the points span a volume.
    #[error("{points} points, but no four of them that are not in one plane")]
    Coplanar {
        /// How many points were given.
        points: usize,
    },
    /// A mesh bounds no volume, or meets itself.
    #[error("{}", crate::error::listed(.defects))]
    NoVolume {
        /// What is wrong, at least one thing.
        defects: Vec<crate::Defect>,
    },
    /// Some faces could not be brought in: doubles leave no room for the points that it would take.
    #[error(
        "no tetrahedra with faces {faces:?} were found: between them and their neighbours doubles leave no room for another point"
    )]
    NoRoom {
        /// The faces of the input that are missing, ascending.
        faces: Vec<u32>,
    },
    /// A face is seen from outside by the point that should see all from inside.
    #[error(
        "face {face} is seen from outside by ({}, {}, {}): no star round that point",
        shown(*.x), shown(*.y), shown(*.z)
    )]
    NotStar {
        /// The face.
        face: usize,
        /// The point's x, metres.
        x: f64,
        /// The point's y, metres.
        y: f64,
        /// The point's z, metres.
        z: f64,
    },
    /// The tetrahedra broke one of their own rules; a bug of ours.
    #[error("the tetrahedralisation broke its own rule: {rule}")]
    Broken {
        /// The rule.
        rule: String,
    },
}

/// A coordinate as people write it: with an exponent where it would be a row of zeros.
pub(crate) fn shown(coordinate: f64) -> String {
    match coordinate.abs() {
        0.0 | 1e-5..1e16 => coordinate.to_string(),
        _ => format!("{coordinate:e}"),
    }
}

/// The first defects, in words.
pub(crate) fn listed(defects: &[crate::Defect]) -> String {
    const MOST: usize = 8;
    let mut words: Vec<String> = defects.iter().take(MOST).map(ToString::to_string).collect();
    if defects.len() > MOST {
        words.push(format!("and {} more", defects.len() - MOST));
    }
    words.join("; ")
}
