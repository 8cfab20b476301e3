//! Depth images of every kind, and reductions by number.
#![allow(dead_code, reason = "each test binary uses its part")]

use maps3d::reduce::{Contribution, HoleMethod, InverseDepth, Method, ReduceOptions, Stop};
use proptest::prelude::*;
use sensing::{Camera, DepthImage};

/// So many cases, or as many as `PROPTEST_CASES` says.
pub fn cases(usual: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    ProptestConfig::with_cases(asked.unwrap_or(usual))
}

/// A camera for an image of so many columns.
pub fn camera(columns: usize) -> Camera {
    let f = columns.max(2) as f64 * 0.9;
    Camera::new(f, f, columns as f64 * 0.48, columns as f64 * 0.3)
}

/// Constant, ramps, checkerboards, steps, noise, a single valid pixel, nothing valid, values that are
/// no depths, huge and tiny ones; sizes from 1 x n up.
pub fn adversarial() -> impl Strategy<Value = DepthImage> {
    let odd = prop::sample::select(vec![
        f32::NAN,
        0.0,
        -1.0,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        1e30,
        1e9,
        9.9e8,
        1e-3,
        1e-30,
    ]);
    // Drawn as f64: proptest's own f32 ranges panic for about one value in 2^24 (debug builds).
    let value = prop_oneof![8 => (0.3..9.0_f64).prop_map(|z| z as f32), 1 => odd];
    (1..14_usize, 1..12_usize, 0..9_u8, any::<u64>(), prop::bool::weighted(0.2)).prop_flat_map(
        move |(columns, rows, kind, seed, mirrored)| {
            prop::collection::vec(value.clone(), columns * rows).prop_map(move |noise| {
                let mut camera = camera(columns);
                if mirrored {
                    camera.fy = -camera.fy;
                }
                let depths = (0..columns * rows)
                    .map(|i| {
                        let (c, r) = ((i % columns) as f32, (i / columns) as f32);
                        match kind {
                            0 => 2.0,
                            1 => 1.0 + 0.1 * c + 0.2 * r,
                            2 => {
                                if (c as u32 + r as u32).is_multiple_of(2) {
                                    1.0
                                } else {
                                    7.0
                                }
                            }
                            3 => {
                                if i as u64 == seed % (columns * rows) as u64 {
                                    1.5
                                } else {
                                    0.0
                                }
                            }
                            4 => f32::NAN,
                            5 => {
                                if c < (seed % 13) as f32 {
                                    1.0
                                } else {
                                    5.0
                                }
                            }
                            6 => {
                                if noise[i] > 6.0 {
                                    f32::NAN
                                } else {
                                    2.0 + 0.01 * noise[i]
                                }
                            }
                            _ => noise[i],
                        }
                    })
                    .collect();
                DepthImage::new(columns, camera, depths)
            })
        },
    )
}

/// Removal by each measure and hole method (0 to 11), quadrics (12 to 15), insertion (16, 17); some
/// with a one-sided bound.
pub fn options_of(pick: usize, stop: Stop) -> (ReduceOptions, Option<f64>) {
    let measures =
        [Contribution::Centroid, Contribution::LeastSquares, Contribution::LeastSquaresVertical];
    let method = match pick {
        0..12 => {
            Method::Removal { contribution: measures[pick / 4], hole: HoleMethod::ALL[pick % 4] }
        }
        12..16 => Method::Quadric,
        _ => Method::InverseDepth(InverseDepth::default()),
    };
    let conservative_m = match pick {
        1 | 13 => Some(0.0),
        6 | 14 => Some(0.05),
        16 => Some(0.1),
        _ => None,
    };
    (ReduceOptions::new(method, stop), conservative_m)
}
