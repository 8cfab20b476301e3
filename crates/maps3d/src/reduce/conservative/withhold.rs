//! Vertices drawn towards the camera until no more than a bound lies outside.

use crate::image::FilledImage;
use crate::tolerance::ROUNDING_SHARE;
use crate::triangulate::ImageMesh;

use super::segments::{Place, Segment, visit};

/// Draws vertices towards the camera until the surface is nowhere more than `bound_m` beyond the measured
/// one, along any ray of the image; returns how many moved.
///
/// Where a face goes too far, by some inverse depth, all its corners come nearer by that much: then
/// the whole face does. Nothing ever moves away from the camera, so one pass is enough.
/// O(pixels + length of all edges in pixels).
pub fn withhold(image: &FilledImage, mesh: &mut ImageMesh, bound_m: f64) -> usize {
    let mut raise = vec![0.0_f64; mesh.pixels.len()];
    visit(image, mesh, |corners, segment| {
        // Most segments.
        if !segment.is_beyond() {
            return;
        }
        let stretch =
            segment.ends.iter().map(|end| end.stretch(image.camera())).fold(1.0, f64::max);
        let short = most_short(segment, bound_m / stretch);
        if short > 0.0 {
            for &corner in corners {
                raise[corner as usize] = raise[corner as usize].max(short);
            }
        }
    });
    for (depth_m, raise) in mesh.depths_m.iter_mut().zip(&raise) {
        if *raise > 0.0 {
            // A little more than needed, for rounding.
            *depth_m = 1.0 / ((1.0 / *depth_m + raise) * (1.0 + ROUNDING_SHARE));
        }
    }
    raise.iter().filter(|raise| **raise > 0.0).count()
}

/// What inverse depth the mesh lacks at most along a segment, to be nowhere more than `bound_m` of depth
/// beyond the measured surface; not positive where it lacks none.
///
/// It should be at least `g(s) = s / (1 + bound s)` for a measured inverse depth `s`. As `g` is concave and
/// the mesh affine, what is missing grows and then falls: it is largest at an end, or where the slopes are
/// equal, `1 / (1 + bound s)^2` and that of the mesh over `s`.
fn most_short(segment: &Segment, bound_m: f64) -> f64 {
    let [p, q] = &segment.ends;
    let short = |place: &Place| place.measured / (1.0 + bound_m * place.measured) - place.mesh;
    let ends = short(p).max(short(q));
    let grown = q.measured - p.measured;
    // No number where the mesh falls as `s` grows, or the bound is 0.
    let equal = ((grown / (q.mesh - p.mesh)).sqrt() - 1.0) / bound_m;
    let along = (equal - p.measured) / grown;
    if along > 0.0 && along < 1.0 {
        ends.max(short(&Place::between(&segment.ends, along)))
    } else {
        ends
    }
}
