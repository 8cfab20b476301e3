//! How near a mesh comes to what was measured.

use crate::image::FilledImage;
use crate::reduce::{LiftedPlane, outside_max_m};
use crate::triangulate::{ImageMesh, rows_of};

/// Root mean square, 95 % and largest of some distances, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Root mean square.
    pub rms_m: f64,
    /// What 95 % do not exceed.
    pub p95_m: f64,
    /// The largest.
    pub max_m: f64,
}

/// What was measured of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Distances of the measured points from the plane of the face on their ray; of the farthest one where
    /// that ray meets several.
    pub plane: Spread,
    /// Differences of depth on the rays of the measured points.
    pub ray: Spread,
    /// Share of the pixels whose ray meets no face.
    pub uncovered_share: f64,
    /// How far the surface lies beyond the measured one at most, along rays, metres.
    pub outside_max_m: f64,
}

impl Spread {
    /// Of some distances; all zero where there are none. O(n).
    pub fn of(mut distances_m: Vec<f64>) -> Self {
        let count = distances_m.len();
        if count == 0 {
            return Self::default();
        }
        let squares: f64 = distances_m.iter().map(|d| d * d).sum();
        let max_m = distances_m.iter().copied().fold(0.0, f64::max);
        let rank = (count * 95).div_ceil(100).clamp(1, count) - 1;
        let (_, p95_m, _) = distances_m.select_nth_unstable_by(rank, f64::total_cmp);
        Self { rms_m: (squares / count as f64).sqrt(), p95_m: *p95_m, max_m }
    }
}

/// Measures a mesh against the image that it was made from; missing pixels do not count.
///
/// A pixel on a side, or at a vertex, counts for the plane that is farthest of those of its faces, so that
/// no distance is told too small. O(pixels).
pub fn measure(image: &FilledImage, mesh: &ImageMesh) -> Quality {
    let pixels = image.pixels();
    let mut plane = vec![0.0_f64; pixels];
    let mut ray = vec![f64::INFINITY; pixels];
    for &triangle in &mesh.triangles {
        let corners = mesh.corner_pixels(triangle);
        let inverse = triangle.map(|vertex| 1.0 / mesh.depths_m[vertex as usize]);
        let lifted = LiftedPlane::through(image.camera(), corners, inverse);
        let [base, per_column, per_row] = mesh.inverse_depth_plane(triangle);
        for span in rows_of(corners) {
            for column in span.first..=span.last {
                let at = span.row * image.columns() + column;
                let depth_m = f64::from(image.depths_m()[at]);
                let (c, r) = (column as f64, span.row as f64);
                plane[at] = plane[at].max(lifted.distance_m([c, r], depth_m));
                let surface_m = 1.0 / (base + c * per_column + r * per_row);
                ray[at] = ray[at].min((surface_m - depth_m).abs());
            }
        }
    }
    let covered = ray.iter().filter(|distance| distance.is_finite()).count();
    let counts: Vec<bool> =
        ray.iter().enumerate().map(|(at, r)| !image.is_missing(at) && r.is_finite()).collect();
    let measured = |distances: Vec<f64>| {
        let of_measured = distances.into_iter().zip(&counts).filter(|&(_, &counts)| counts);
        Spread::of(of_measured.map(|(distance, _)| distance).collect())
    };
    Quality {
        plane: measured(plane),
        ray: measured(ray),
        uncovered_share: 1.0 - covered as f64 / pixels as f64,
        outside_max_m: outside_max_m(image, mesh),
    }
}
