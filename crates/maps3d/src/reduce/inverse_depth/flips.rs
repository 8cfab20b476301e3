//! Sides exchanged where that brings faces nearer to the pixels.

use super::InverseDepth;
use super::delaunay::{Delaunay, NONE};
use super::scan::{LiftedPlane, scan};
use crate::image::FilledImage;
use crate::triangulate::orient;

/// Turns each side between two faces to the other diagonal of their quadrangle where the summed
/// distance of the pixels, none counted above the cap, becomes less; so sides come to lie along depth
/// steps. Returns the number of exchanges.
///
/// One round looks at each side once; faces stay of positive turn, so the triangulation stays planar,
/// but no longer Delaunay. `inverse` holds the inverse depth of each vertex;
/// depths of missing pixels are negative. O(pixels) per round.
pub(super) fn flip_round(
    image: &FilledImage,
    signed_m: &[f32],
    mesh: &mut Delaunay,
    inverse: &[f64],
    options: &InverseDepth,
) -> usize {
    let cost_of = |mesh: &Delaunay, corners: [u32; 3]| {
        let pixels = corners.map(|corner| mesh.pixels[corner as usize]);
        let at = corners.map(|corner| inverse[corner as usize]);
        let plane = LiftedPlane::through(image.camera(), pixels, at);
        let emphasis = plane.emphasis(at, options.edge_on);
        #[expect(clippy::cast_possible_truncation, reason = "an order, not a measurement")]
        let (cap_m, emphasis) =
            ((options.cap_at(mesh.pixels.len()) / emphasis) as f32, emphasis as f32);
        let weight = options.missing_weight as f32;
        scan(signed_m, image.columns(), pixels, &plane, cap_m, weight).sum_m * emphasis
    };
    let mut costs: Vec<f32> = mesh.corners.iter().map(|&corners| cost_of(mesh, corners)).collect();
    let mut flips = 0;
    for t in 0..mesh.corners.len() as u32 {
        for side in 0..3 {
            let other = mesh.neighbours[t as usize][side];
            if other == NONE || other < t {
                continue;
            }
            let before = costs[t as usize] + costs[other as usize];
            let corners = mesh.corners[t as usize];
            let [p, b, c] = [corners[side], corners[(side + 1) % 3], corners[(side + 2) % 3]];
            let opposite = mesh.side_towards(other, t);
            let q = mesh.corners[other as usize][opposite];
            let at = |corner: u32| mesh.pixels[corner as usize];
            if orient(at(p), at(b), at(q)) <= 0 || orient(at(p), at(q), at(c)) <= 0 {
                continue;
            }
            let first = cost_of(mesh, [p, b, q]);
            if first >= before {
                continue;
            }
            let second = cost_of(mesh, [p, q, c]);
            // By a thousandth at least: pixels on a side count for both of its faces.
            if first + second < 0.999 * before {
                mesh.turn(t, side);
                costs[t as usize] = first;
                costs[other as usize] = second;
                flips += 1;
            }
        }
    }
    flips
}
