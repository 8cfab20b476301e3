//! Why a depth image cannot become a polyhedron.

use thiserror::Error;

/// A number as it may have been typed: huge and tiny ones are not written out.
fn short(value: f64) -> String {
    if value == 0.0 || (1e-5..1e15).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// What is wrong with an image, a cloud, an option or a mesh, with what was found and what fits.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Maps3dError {
    /// The image is not between 1 x 1 and 16,384 x 16,384 pixels once it is cropped.
    #[error(
        "an image of {columns} x {rows} pixels, of which {crop} are cropped on each side: expected \
         {least} to {most} columns and rows to be left"
    )]
    ImageSize {
        /// Columns before cropping.
        columns: usize,
        /// Rows before cropping.
        rows: usize,
        /// Pixels cropped on each side.
        crop: usize,
        /// The least that must be left.
        least: usize,
        /// The most that may be left.
        most: usize,
    },
    /// The depths do not fill the rows.
    #[error("{depths} depths do not make rows of {columns} pixels")]
    ImageShape {
        /// Number of depths.
        depths: usize,
        /// Number of columns.
        columns: usize,
    },
    /// The camera cannot be used.
    #[error(
        "a camera of fx {}, fy {}, cx {}, cy {}: expected finite numbers, fx and fy not 0",
        short(*fx), short(*fy), short(*cx), short(*cy)
    )]
    Camera {
        /// Focal length along columns, pixels.
        fx: f64,
        /// Focal length along rows, pixels.
        fy: f64,
        /// Column of the optical axis.
        cx: f64,
        /// Row of the optical axis.
        cy: f64,
    },
    /// An option is out of its range.
    #[error("{option} is {}, expected {expected}", short(*found))]
    Option {
        /// The option.
        option: &'static str,
        /// Its value.
        found: f64,
        /// What fits.
        expected: &'static str,
    },
    /// Too many points of a cloud share one place.
    #[error(
        "{points} points of the cloud are at ({x}, {y}, {z}), at most {limit} may share a place; \
         they can be taken as missing instead"
    )]
    Duplicates {
        /// Points at the place that most share.
        points: usize,
        /// The most that may.
        limit: usize,
        /// Its x, metres.
        x: f32,
        /// Its y, metres.
        y: f32,
        /// Its z, metres.
        z: f32,
    },
    /// The cloud has one row: its points are in no image.
    #[error(
        "a cloud of {points} points in {rows} row(s) is not organised as an image; expected \
         one point for each pixel, in rows"
    )]
    NotOrganised {
        /// Number of points.
        points: usize,
        /// Number of rows.
        rows: usize,
    },
    /// The points of a cloud lie on no common camera's rays.
    #[error(
        "no pinhole camera fits the cloud: points lie {error_px:.2} pixels (95 %) from their rays, \
         at most {limit_px} may be; give the camera, or undistort the cloud"
    )]
    NoCamera {
        /// The distance that 95 % of the points keep, pixels; NaN where too few points are valid.
        error_px: f64,
        /// The limit.
        limit_px: f64,
    },
    /// The pose of a camera has a number in it that is not finite, or so large that nothing is left of a view there.
    #[error("the camera of a look at {vertex} has a pose that is not finite, or too far away")]
    Pose {
        /// The vertex that it hangs on.
        vertex: probe::VertexId,
    },
    /// The reduced mesh is not a triangulation of the image.
    #[error("not a triangulation of the image: {fault}")]
    NotPlanar {
        /// The first thing that is wrong.
        fault: String,
    },
    /// Tetrahedra that point at nothing.
    #[error("volume {volume}: {what}: {index}")]
    Tetrahedra {
        /// The volume, as they were given.
        volume: usize,
        /// What is wrong.
        what: &'static str,
        /// Of which vertex, tetrahedron or face.
        index: usize,
    },
    /// A point from or to which a path is asked for lies in no tetrahedron.
    #[error("the {what} ({x}, {y}, {z}) lies in no free space")]
    Outside {
        /// Start or goal.
        what: &'static str,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
        /// Its z, metres.
        z: f64,
    },
    /// A point from or to which a path is asked for is too near to an obstacle.
    #[error(
        "the {what} ({x}, {y}, {z}) is {distance_m:.4} m from an obstacle, less than the radius of {radius_m} m"
    )]
    TooNear {
        /// Start or goal.
        what: &'static str,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
        /// Its z, metres.
        z: f64,
        /// Its distance from the nearest obstacle face, metres.
        distance_m: f64,
        /// The radius, metres.
        radius_m: f64,
    },
    /// A search refused the dual graph; a bug of ours.
    #[error("the search refused the dual graph: {reason}")]
    Search {
        /// Its own words.
        reason: String,
    },
    /// The polyhedron was refused.
    #[error(transparent)]
    Solid(#[from] solid::SolidError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_as_they_are_typed() {
        for (value, text) in
            [(0.0, "0"), (-1.5, "-1.5"), (1e300, "1e300"), (2e-9, "2e-9"), (f64::INFINITY, "inf")]
        {
            assert_eq!(short(value), text);
        }
    }
}
