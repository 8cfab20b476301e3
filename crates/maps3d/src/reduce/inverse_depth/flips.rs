//! Sides exchanged where that brings faces nearer to the pixels.

use super::InverseDepth;
use super::delaunay::{Delaunay, NONE};
use super::scan::Sheet;
use super::summed_distance::SummedDistance;
use crate::image::FilledImage;
use crate::triangulate::orient;

/// What is known of the faces from one round to the next.
pub(super) struct Flips<'a> {
    distance: SummedDistance<'a>,
    /// Inverse depth of each vertex.
    inverse: &'a [f64],
    costs: Vec<f32>,
    /// Faces that are new since they were last looked at.
    fresh: Vec<bool>,
}

impl<'a> Flips<'a> {
    /// Measures every face. O(pixels).
    pub fn new(
        image: &'a FilledImage,
        sheet: &'a Sheet,
        mesh: &Delaunay,
        inverse: &'a [f64],
        options: &'a InverseDepth,
    ) -> Self {
        let distance = SummedDistance::new(image, sheet, options, mesh.pixels.len());
        let fresh = vec![true; mesh.corners.len()];
        let mut flips = Self { distance, inverse, costs: Vec::new(), fresh };
        flips.costs = mesh.corners.iter().map(|&corners| flips.cost_of(mesh, corners)).collect();
        flips
    }

    /// Turns each side between two faces to the other diagonal of their quadrangle where the summed
    /// distance of the pixels, none counted above the cap, becomes less; so sides come to lie along
    /// depth steps. Returns the number of exchanges.
    ///
    /// One round looks at each side once, but for those between faces that the round before has left
    /// as they were. Faces stay of positive turn, so the triangulation stays planar, but no longer
    /// Delaunay. O(pixels) for the first round.
    pub fn round(&mut self, mesh: &mut Delaunay) -> usize {
        let before = std::mem::replace(&mut self.fresh, vec![false; mesh.corners.len()]);
        let mut count = 0;
        for t in 0..mesh.corners.len() as u32 {
            for side in 0..3 {
                let other = mesh.neighbours[t as usize][side];
                if other == NONE || other < t {
                    continue;
                }
                let known = [t, other].map(|face| face as usize);
                if !known.iter().any(|&face| before[face] || self.fresh[face]) {
                    continue;
                }
                if let Some(costs) = self.gain(mesh, t, side, other) {
                    mesh.turn(t, side);
                    for (face, cost) in known.into_iter().zip(costs) {
                        self.costs[face] = cost;
                        self.fresh[face] = true;
                    }
                    count += 1;
                }
            }
        }
        count
    }

    /// What the two faces cost after an exchange, where they cost less than before.
    fn gain(&self, mesh: &Delaunay, t: u32, side: usize, other: u32) -> Option<[f32; 2]> {
        let before = self.costs[t as usize] + self.costs[other as usize];
        let corners = mesh.corners[t as usize];
        let [p, b, c] = [corners[side], corners[(side + 1) % 3], corners[(side + 2) % 3]];
        let q = mesh.corners[other as usize][mesh.side_towards(other, t)];
        let at = |corner: u32| mesh.pixels[corner as usize];
        if orient(at(p), at(b), at(q)) <= 0 || orient(at(p), at(q), at(c)) <= 0 {
            return None;
        }
        let first = self.cost_of(mesh, [p, b, q]);
        if first >= before {
            return None;
        }
        let second = self.cost_of(mesh, [p, q, c]);
        // By a thousandth at least: pixels on a side count for both of its faces.
        (first + second < 0.999 * before).then_some([first, second])
    }

    fn cost_of(&self, mesh: &Delaunay, corners: [u32; 3]) -> f32 {
        let pixels = corners.map(|corner| mesh.pixels[corner as usize]);
        self.distance.of_m(pixels, corners.map(|corner| self.inverse[corner as usize]))
    }
}
