//! The largest distance along rays from one surface to the other.

use sensing::Camera;

use crate::image::FilledImage;
use crate::triangulate::ImageMesh;

use super::segments::{Place, Segment, visit};

/// What is told may be more than the largest distance by this share of it ...
const SHARE: f64 = 1e-9;
/// ... and by this share of the depth, which is what rounding leaves of the difference of two depths.
const ROUNDING: f64 = 1e-14;
/// Shorter stretches than this share of one are not halved.
const SHORTEST: f64 = 1e-9;

/// How far the surface of a mesh lies beyond the measured one at most, along viewing rays, metres.
///
/// Measured is the surface of the full grid. An upper bound of the largest distance over all rays of the
/// image, not of those through pixels alone, which exceeds it by a billionth of it and by rounding at
/// most; 0 where the mesh lies nowhere beyond. O(pixels + length of all edges in pixels).
pub fn outside_max_m(image: &FilledImage, mesh: &ImageMesh) -> f64 {
    let mut farthest = Farthest::default();
    visit(image, mesh, |_, segment| farthest.look(image.camera(), segment));
    farthest.bound_m
}

#[derive(Default)]
struct Farthest {
    /// The largest distance at any place that was looked at.
    found_m: f64,
    /// No distance on any segment so far is above this.
    bound_m: f64,
    /// Stretches of the segment at hand that are still to be looked at.
    open: Vec<[f64; 2]>,
}

impl Farthest {
    /// Halves a segment as long as some part of it may hold a larger distance than is known.
    fn look(&mut self, camera: &Camera, segment: &Segment) {
        if !segment.is_beyond() {
            return;
        }
        self.open.push([0.0, 1.0]);
        while let Some([from, to]) = self.open.pop() {
            let ends = [from, to].map(|along| Place::between(&segment.ends, along));
            let stretches = ends.map(|end| end.stretch(camera));
            for (end, stretch) in ends.iter().zip(stretches) {
                self.found_m = self.found_m.max((1.0 / end.mesh - 1.0 / end.measured) * stretch);
            }
            let bound_m = bound_m(&ends, stretches);
            if bound_m <= self.bound_m {
                continue;
            }
            let depth_m = stretches[0].max(stretches[1]) / ends[0].mesh.min(ends[1].mesh);
            let close_m = self.found_m * (1.0 + SHARE) + ROUNDING * depth_m;
            if bound_m <= close_m || to - from < SHORTEST {
                self.bound_m = bound_m;
                continue;
            }
            let middle = 0.5 * (from + to);
            self.open.extend([[middle, to], [from, middle]]);
        }
    }
}

/// What no distance on a segment exceeds.
///
/// The length of rays to depth 1 is convex, so it is nowhere more than mixed from those at the ends, `l`.
/// With `t` and `s` as everywhere here, the derivative of `l/t - l/s` is `a/t^2 - b/s^2` with the same
/// `a` and `b` all along: it vanishes in one place at most. The error is of second order in the length.
fn bound_m([p, q]: &[Place; 2], [at_p, at_q]: [f64; 2]) -> f64 {
    let beyond_m = |l: f64, t: f64, s: f64| l / t - l / s;
    let ends_m = beyond_m(at_p, p.mesh, p.measured).max(beyond_m(at_q, q.mesh, q.measured));
    let a = at_q * p.mesh - at_p * q.mesh;
    let b = at_q * p.measured - at_p * q.measured;
    // s / t where the derivative vanishes; no number, or out of range, where it does not.
    let k = (b / a).sqrt();
    let along = (k * p.mesh - p.measured) / ((q.measured - p.measured) - k * (q.mesh - p.mesh));
    if along > 0.0 && along < 1.0 {
        let mix = |from: f64, to: f64| (1.0 - along) * from + along * to;
        let [l, t, s] = [mix(at_p, at_q), mix(p.mesh, q.mesh), mix(p.measured, q.measured)];
        ends_m.max(beyond_m(l, t, s))
    } else {
        ends_m
    }
}
