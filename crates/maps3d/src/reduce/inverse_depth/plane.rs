//! The lifted plane of a face, told for pixels.

use sensing::Camera;

use crate::image::{FilledImage, Pixel};
use crate::triangulate::{Span, orient, rows_of};

/// A plane of space, told for pixels: the distance of the point at depth z on the ray of pixel
/// (u, v) is `|z (at_origin + u per_column + v per_row) - offset_m|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LiftedPlane {
    at_origin: f64,
    pub(super) per_column: f64,
    per_row: f64,
    /// The distance of the plane from the camera, metres.
    pub offset_m: f64,
}

impl LiftedPlane {
    /// The plane through three pixels at their inverse depths.
    ///
    /// A plane `n . x = offset` has inverse depth `n . ray / offset`, which is affine in pixels; so
    /// `n . ray` is that function times the offset, and the offset makes `n` a unit vector.
    pub fn through(camera: &Camera, corners: [Pixel; 3], inverse_depths: [f64; 3]) -> Self {
        let [a, b, c] = corners;
        let area = orient(a, b, c) as f64;
        let [ax, ay] = a.map(f64::from);
        let [bx, by] = b.map(f64::from);
        let [cx, cy] = c.map(f64::from);
        let (db, dc) =
            (inverse_depths[1] - inverse_depths[0], inverse_depths[2] - inverse_depths[0]);
        let per_column = (db * (cy - ay) - dc * (by - ay)) / area;
        let per_row = (dc * (bx - ax) - db * (cx - ax)) / area;
        let at_origin = inverse_depths[0] - per_column * ax - per_row * ay;
        let x = per_column * camera.fx;
        let y = per_row * camera.fy;
        let z = at_origin + per_column * camera.cx + per_row * camera.cy;
        let offset_m = 1.0 / (x * x + y * y + z * z).sqrt();
        Self {
            at_origin: at_origin * offset_m,
            per_column: per_column * offset_m,
            per_row: per_row * offset_m,
            offset_m,
        }
    }

    /// How much more a distance counts because the camera sees the face nearly edge-on.
    ///
    /// 1 for faces whose sine of the angle to the rays is at least `edge_on`, more in proportion below.
    /// A face seen so is nearly always the jump of a depth step: points are near its plane wherever on
    /// the ray they are.
    pub fn emphasis(&self, inverse_depths: [f64; 3], edge_on: f64) -> f64 {
        let along = self.offset_m * inverse_depths.iter().sum::<f64>() / 3.0;
        (edge_on / along).max(1.0)
    }

    /// The distance of a point on the ray of a pixel, metres.
    pub fn distance_m(&self, [column, row]: [f64; 2], depth_m: f64) -> f64 {
        let along = self.at_origin + column * self.per_column + row * self.per_row;
        (depth_m * along - self.offset_m).abs()
    }

    /// What [`distance_m`](Self::distance_m) multiplies depths with, at the first pixel of a span.
    #[expect(clippy::cast_possible_truncation, reason = "depths are measured to fewer digits")]
    pub(super) fn at_start(&self, span: &Span) -> f32 {
        let start =
            self.at_origin + span.first as f64 * self.per_column + span.row as f64 * self.per_row;
        start as f32
    }
}

/// The pixel of a face that is farthest from its plane, if that is more than a bound; never a corner.
///
/// In double precision, unlike [`scan`](super::scan::scan). O(pixels of the face).
pub(super) fn farthest_pixel(
    image: &FilledImage,
    corners: [Pixel; 3],
    plane: &LiftedPlane,
    bound_m: f64,
) -> Option<Pixel> {
    let (mut most_m, mut farthest) = (bound_m, None);
    for span in rows_of(corners) {
        for column in span.first..=span.last {
            let pixel = [column as u16, span.row as u16];
            let depth_m = f64::from(image.depth_m(pixel));
            let distance_m = plane.distance_m(pixel.map(f64::from), depth_m);
            if distance_m > most_m && !corners.contains(&pixel) {
                (most_m, farthest) = (distance_m, Some(pixel));
            }
        }
    }
    farthest
}
