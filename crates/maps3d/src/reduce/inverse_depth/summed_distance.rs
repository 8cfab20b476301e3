//! The summed distance of the pixels of a face: what turning sides and taking out vertices go by.

use super::InverseDepth;
use super::plane::LiftedPlane;
use super::scan::{Count, Sheet, scan};
use crate::image::{FilledImage, Pixel};

/// How the distances of the pixels of a face are summed.
pub(super) struct SummedDistance<'a> {
    image: &'a FilledImage,
    sheet: &'a Sheet,
    options: &'a InverseDepth,
    cap_m: f64,
}

impl<'a> SummedDistance<'a> {
    /// As they are while a mesh over the image has so many vertices.
    pub fn new(
        image: &'a FilledImage,
        sheet: &'a Sheet,
        options: &'a InverseDepth,
        vertices: usize,
    ) -> Self {
        Self { image, sheet, options, cap_m: options.cap_at(vertices) }
    }

    /// The sum over the pixels of a face with these inverse depths at its corners, none counted above the
    /// cap, metres; more for faces seen nearly edge-on. O(pixels of the face).
    #[expect(clippy::cast_possible_truncation, reason = "an order, not a measurement")]
    pub fn of_m(&self, corners: [Pixel; 3], inverse_depths: [f64; 3]) -> f32 {
        let plane = LiftedPlane::through(self.image.camera(), corners, inverse_depths);
        let emphasis = plane.emphasis(inverse_depths, self.options.edge_on);
        let (cap_m, missing) = ((self.cap_m / emphasis) as f32, self.options.missing_weight as f32);
        let found = scan(self.sheet, corners, &plane, &Count { cap_m, missing, stride: 1 });
        found.sum_m * emphasis as f32
    }
}
