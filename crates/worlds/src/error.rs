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
    /// The place of space has no surface.
    #[error("the mesh has no triangles: nothing to fly in")]
    NoTriangles,
    /// A triangle has a corner that does not exist or is not finite.
    #[error("triangle {triangle} has corner {vertex}, not a finite one of {vertices} vertices")]
    Corner {
        /// The triangle, from 0.
        triangle: usize,
        /// The vertex that it names, from 0.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A vertex lies farther from the origin than positions are exact enough for.
    #[error("vertex {vertex} lies {reach_m:e} m from the origin: at most {limit_m:e} m")]
    FarVertex {
        /// The vertex, from 0.
        vertex: u32,
        /// Its largest coordinate, metres.
        reach_m: f64,
        /// Most that is allowed.
        limit_m: f64,
    },
    /// The start does not lie in the place of space.
    #[error("the start ({x_m} m, {y_m} m, {z_m} m) is outside of the mesh or on it")]
    StartInSpace {
        /// x of the start in the world frame, metres.
        x_m: f64,
        /// y of the start in the world frame, metres.
        y_m: f64,
        /// z of the start in the world frame, metres.
        z_m: f64,
    },
    /// No start is named, and no place is closed in by the mesh.
    #[error("no place is closed in by the mesh on all sides: name a start")]
    NotClosedIn,
    /// The robot does not fit where it starts.
    #[error(
        "the robot of radius {radius_m} m starts {clearance_m:.3} m from a surface: it does not fit"
    )]
    StartTooTight {
        /// Radius of the body, metres.
        radius_m: f64,
        /// Distance from the start to the nearest surface, metres.
        clearance_m: f64,
    },
}
