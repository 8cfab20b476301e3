//! How far the pixels of a face lie from its lifted plane.

use sensing::Camera;

use crate::image::Pixel;
use crate::triangulate::{orient, rows_of};

/// Number of lanes that are looked at together.
const LANES: usize = 8;

/// A plane of space, told for pixels: the distance of the point at depth z on the ray of pixel
/// (u, v) is `|z (at_origin + u per_column + v per_row) - offset_m|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LiftedPlane {
    at_origin: f64,
    per_column: f64,
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
}

/// What a scan over a face found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scanned {
    /// The pixel that is farthest from the plane.
    pub worst: Pixel,
    /// Its distance, metres.
    pub worst_m: f32,
    /// The sum of the distances, none counted above the cap, metres.
    pub sum_m: f32,
}

/// Looks at every pixel of a face; negative depths are those of missing pixels, whose distance counts
/// `missing_weight` times. O(pixels); 8 at a time.
#[expect(clippy::cast_possible_truncation, reason = "depths are measured to fewer digits")]
pub(super) fn scan(
    depths_m: &[f32],
    columns: usize,
    corners: [Pixel; 3],
    plane: &LiftedPlane,
    cap_m: f32,
    missing_weight: f32,
) -> Scanned {
    let error_of = |depth_m: f32, along: f32, offset_m: f32| {
        let weight = if depth_m < 0.0 { missing_weight } else { 1.0 };
        (depth_m.abs() * along - offset_m).abs() * weight
    };
    let (step, offset_m) = (plane.per_column as f32, plane.offset_m as f32);
    let mut found = Scanned::default();
    let ramp: [f32; LANES] = std::array::from_fn(|lane| lane as f32 * step);
    for span in rows_of(corners) {
        let row = &depths_m[span.row * columns..][span.first..=span.last];
        let start = plane.at_origin
            + span.first as f64 * plane.per_column
            + span.row as f64 * plane.per_row;
        let mut along = start as f32;
        let (mut worst, mut sums) = ([0.0_f32; LANES], [0.0_f32; LANES]);
        let (chunks, rest) = row.as_chunks::<LANES>();
        for chunk in chunks {
            for lane in 0..LANES {
                let error = error_of(chunk[lane], along + ramp[lane], offset_m);
                worst[lane] = if error > worst[lane] { error } else { worst[lane] };
                sums[lane] += if error < cap_m { error } else { cap_m };
            }
            along += LANES as f32 * step;
        }
        for (lane, &depth_m) in rest.iter().enumerate() {
            let error = error_of(depth_m, along + ramp[lane], offset_m);
            worst[lane] = if error > worst[lane] { error } else { worst[lane] };
            sums[lane] += if error < cap_m { error } else { cap_m };
        }
        found.sum_m += sums.iter().sum::<f32>();
        let worst_m = worst.iter().copied().fold(0.0, f32::max);
        if worst_m > found.worst_m {
            found.worst_m = worst_m;
            // Only now is it worth knowing where in the row.
            let mut along = start as f32;
            let mut at = span.first;
            'row: for chunk in row.chunks(LANES) {
                for (lane, &depth_m) in chunk.iter().enumerate() {
                    if error_of(depth_m, along + ramp[lane], offset_m) >= worst_m {
                        at += lane;
                        break 'row;
                    }
                }
                along += LANES as f32 * step;
                at += LANES;
            }
            found.worst = [at as u16, span.row as u16];
        }
    }
    found
}
