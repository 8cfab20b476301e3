//! What can be wrong with planar input.

/// Why a star polygon was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanarError {
    /// There must be one gap flag per vertex.
    #[error("{vertices} vertices but {flags} gap flags")]
    FlagCount {
        /// How many vertices were given.
        vertices: usize,
        /// How many flags were given.
        flags: usize,
    },
    /// A coordinate is NaN, infinite, or too large or too small to decide exactly.
    #[error("vertex {vertex} at ({x}, {y}): coordinates must be 0 or of magnitude 1e-100 to 1e100")]
    OutsideEnvelope {
        /// The vertex.
        vertex: usize,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
    },
    /// A vertex lies at the origin, where it has no bearing.
    #[error("vertex {vertex} lies at the origin and has no bearing")]
    AtOrigin {
        /// The vertex.
        vertex: usize,
    },
    /// A vertex does not lie strictly counter-clockwise of the one before it, within one turn.
    #[error("vertex {vertex} does not lie counter-clockwise of vertex {before} within one turn")]
    BearingOrder {
        /// The vertex.
        vertex: usize,
        /// The vertex before it.
        before: usize,
    },
    /// An edge that is no gap spans half a turn or more.
    #[error("the chord from vertex {vertex} to {next} spans half a turn or more: it must be a gap")]
    WideChord {
        /// The chord's first vertex.
        vertex: usize,
        /// Its second vertex.
        next: usize,
    },
    /// A corner is not finite, or too far from the others for the lattice of an overlay.
    #[error(
        "corner at ({x}, {y}): overlays take finite corners within {reach_m} m of their middle"
    )]
    Unsnappable {
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
        /// The limit, metres.
        reach_m: f64,
    },
}
