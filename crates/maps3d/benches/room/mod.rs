//! A synthetic room with boxes, noise of 0.3 %, shadows and speckle.

use sensing::Camera;

/// Depths of 640 x 480 pixels, metres; NaN where nothing was measured.
pub fn room(camera: &Camera) -> Vec<f32> {
    let mut seed = 1_u32;
    let mut next = move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    let boxes = [
        ([-0.9, 0.2], [-0.2, 1.0], 2.2),
        ([0.4, -0.3], [1.1, 1.0], 3.1),
        ([-0.1, 0.5], [0.3, 1.0], 1.4),
    ];
    (0..640 * 480)
        .map(|i| {
            let [x, y] = camera.slope_of((i % 640) as f64, (i / 640) as f64);
            // Walls at x = 2 and -1.5, floor and ceiling at y = 1.1 and -1.2, a back wall.
            let sides = [2.0 / x, -1.5 / x, 1.1 / y, -1.2 / y];
            let walls = sides.into_iter().filter(|z| *z > 0.0).fold(5.2, f64::min);
            let front = boxes.iter().filter(|(low, high, z)| {
                let (px, py) = (x * z, y * z);
                px > low[0] && px < high[0] && py > low[1] && py < high[1]
            });
            let z = front.map(|(_, _, z)| *z).fold(walls, f64::min);
            let noise = next() + next() + next() + next() - 2.0;
            let missing = next() < 0.002 || (x - 0.1).hypot(y + 0.2) < 0.06;
            if missing { f32::NAN } else { (z * (1.0 + 0.005 * noise)) as f32 }
        })
        .collect()
}
