//! What a place looks like from its middle, whatever way one looks.

use crate::SurfacePoint;

/// Rings that returns are counted in.
const RINGS: usize = 16;

/// Width of a ring, metres.
const WIDTH_M: f64 = 0.75;

/// Shares of the returns in rings around a keyframe, which turning does not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Descriptor([f32; RINGS]);

impl Descriptor {
    /// The descriptor of points, one for each cell, in the frame of the keyframe.
    pub fn new(points: &[SurfacePoint]) -> Self {
        let mut rings = [0.0_f32; RINGS];
        for point in points {
            let ring = (point.point.coords.norm() / WIDTH_M) as usize;
            if let Some(count) = rings.get_mut(ring) {
                *count += 1.0;
            }
        }
        let sum: f32 = rings.iter().sum();
        if sum > 0.0 {
            rings.iter_mut().for_each(|count| *count /= sum);
        }
        Self(rings)
    }

    /// How much two differ: 0 where they are the same, 1 where they share no ring.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.0.iter().zip(&other.0);
        0.5 * f64::from(pairs.map(|(a, b)| (a - b).abs()).sum::<f32>())
    }
}
