//! What a depth camera sees of a furnished room.

use sensing::{Camera, DepthImage};

/// A room with boxes in it, and the faults of the camera that looks at it.
///
/// Walls stand at x = 2 m and -1.5 m, the floor at y = 1.1 m, the ceiling at -1.2 m and the back wall
/// at z = 5.2 m, in the frame `camera`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthRoom {
    /// Columns of the image, at least 2.
    pub columns: usize,
    /// Rows of the image, at least 2.
    pub rows: usize,
    /// The noise's seed.
    pub seed: u32,
    /// Standard deviation of the noise, as a share of the depth.
    pub noise_share: f64,
    /// Share of the pixels, scattered, that see nothing.
    pub speckle_share: f64,
    /// Whether a round patch sees nothing either.
    pub patch: bool,
}

impl Default for DepthRoom {
    fn default() -> Self {
        Self {
            columns: 640,
            rows: 480,
            seed: 1,
            noise_share: 0.003,
            speckle_share: 0.002,
            patch: true,
        }
    }
}

/// Two corners of a box's front, and its depth: it reaches on to the back wall.
const BOXES: [([f64; 2], [f64; 2], f64); 3] = [
    ([-0.9, 0.2], [-0.2, 1.0], 2.2),
    ([0.4, -0.3], [1.1, 1.0], 3.1),
    ([-0.1, 0.5], [0.3, 1.0], 1.4),
];

impl DepthRoom {
    /// The camera that looks at the room: focal lengths of 576 and 578 pixels for 640 columns.
    pub fn camera(&self) -> Camera {
        let scale = self.columns as f64 / 640.0;
        let middle = |side: usize| (side as f64 - 1.0) / 2.0;
        Camera::new(576.0 * scale, 578.0 * scale, middle(self.columns), middle(self.rows))
    }

    /// Depth of the room on the ray of a pixel, without any fault, metres.
    pub fn true_depth_m(&self, column: usize, row: usize) -> f64 {
        let [x, y] = self.camera().slope_of(column as f64, row as f64);
        let sides = [2.0 / x, -1.5 / x, 1.1 / y, -1.2 / y];
        let walls = sides.into_iter().filter(|z| *z > 0.0).fold(5.2, f64::min);
        let front = BOXES.iter().filter(|(low, high, z)| {
            let (px, py) = (x * z, y * z);
            px > low[0] && px < high[0] && py > low[1] && py < high[1]
        });
        front.map(|(_, _, z)| *z).fold(walls, f64::min)
    }

    /// The image: NaN where nothing is seen. The same options give the same image.
    pub fn image(&self) -> DepthImage {
        let mut seed = self.seed;
        let mut next = move || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 8) / f64::from(1 << 24)
        };
        let camera = self.camera();
        let depths_m = (0..self.columns * self.rows).map(|at| {
            let (column, row) = (at % self.columns, at / self.columns);
            let [x, y] = camera.slope_of(column as f64, row as f64);
            // The sum of four has a variance of a third.
            let noise = (next() + next() + next() + next() - 2.0) * 3.0_f64.sqrt();
            let patch = self.patch && (x - 0.1).hypot(y + 0.2) < 0.06;
            let missing = next() < self.speckle_share || patch;
            let z = self.true_depth_m(column, row) * (1.0 + self.noise_share * noise);
            #[expect(clippy::cast_possible_truncation, reason = "as sensors give it")]
            if missing { f32::NAN } else { z as f32 }
        });
        DepthImage::new(self.columns, camera, depths_m.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_and_gaps_are_as_asked() {
        let room = DepthRoom { columns: 320, rows: 240, patch: false, ..DepthRoom::default() };
        let image = room.image();
        let again = room.image().depths_m;
        assert!(image.depths_m.iter().zip(&again).all(|(a, b)| a.to_bits() == b.to_bits()));
        let errors: Vec<f64> = image
            .depths_m
            .iter()
            .enumerate()
            .filter(|(_, z)| z.is_finite())
            .map(|(at, &z)| f64::from(z) / room.true_depth_m(at % 320, at / 320) - 1.0)
            .collect();
        let share = 1.0 - errors.len() as f64 / image.depths_m.len() as f64;
        assert!((share - 0.002).abs() < 0.001, "{share}");
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        assert!((deviation - 0.003).abs() < 1e-4, "{deviation}");
    }

    #[test]
    fn without_faults_it_is_the_room() {
        let room = DepthRoom { noise_share: 0.0, speckle_share: 0.0, ..DepthRoom::default() };
        let plain = DepthRoom { patch: false, ..room }.image();
        assert!(plain.depths_m.iter().all(|z| z.is_finite()));
        assert!((plain.depths_m[240 * 640 + 320] - 5.2).abs() < 1e-6, "the back wall");
        assert!(room.image().depths_m.iter().any(|z| z.is_nan()), "the patch");
    }
}
