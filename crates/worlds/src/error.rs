//! What can be wrong with a place.

/// Why a place cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// The map has no area, or its extent is not finite.
    #[error("the map spans {width_m} m by {height_m} m: both must be positive")]
    NoArea {
        /// Extent along x, metres.
        width_m: f64,
        /// Extent along y, metres.
        height_m: f64,
    },
    /// The map reaches farther from the origin than positions are exact enough for.
    #[error("the map reaches {reach_m:e} m from its origin: at most {limit_m:e} m")]
    TooFar {
        /// Largest coordinate of its corners, metres.
        reach_m: f64,
        /// Most that is allowed.
        limit_m: f64,
    },
    /// The list of cells does not fill the map.
    #[error("the map lists {found} cells where its columns and rows make {expected}")]
    CellCount {
        /// Cells listed.
        found: usize,
        /// Columns times rows.
        expected: usize,
    },
    /// The start does not stand in free space.
    #[error("the start ({x_m} m, {y_m} m) is not in free space")]
    StartNotFree {
        /// x of the start in the world frame, metres.
        x_m: f64,
        /// y of the start in the world frame, metres.
        y_m: f64,
    },
    /// The start does not stand in free space, and where the nearest free space is.
    #[error(
        "the start ({x_m} m, {y_m} m) is inside an obstacle: the nearest free point is \
         ({free_x_m:.3} m, {free_y_m:.3} m)"
    )]
    StartBlocked {
        /// x of the start in the world frame, metres.
        x_m: f64,
        /// y of the start in the world frame, metres.
        y_m: f64,
        /// x of the nearest free point in the world frame, metres.
        free_x_m: f64,
        /// y of the nearest free point in the world frame, metres.
        free_y_m: f64,
    },
    /// No robot could stand anywhere: all is solid.
    #[error("the map has no free space")]
    NoFreeSpace,
    /// A parameter of a map or a generator is outside its range.
    #[error("`{field}` is {found}: expected {expected}")]
    Parameter {
        /// Name of the field.
        field: &'static str,
        /// Its value.
        found: f64,
        /// Its range in words.
        expected: &'static str,
    },
    /// The image has one shade only, so that solid and free cannot be told apart by themselves.
    #[error("every pixel has shade {shade} of 255: give a threshold")]
    OneShade {
        /// The shade, 0 (black) to 255 (white).
        shade: u8,
    },
    /// The generator did not find room for all pillars.
    #[error("only {placed} of {wanted} pillars fit: ask for fewer, smaller ones or a larger hall")]
    Crowded {
        /// Pillars that found a place.
        placed: usize,
        /// Pillars asked for.
        wanted: usize,
    },
}
