//! Vertices taken out again, where that costs least.

use super::InverseDepth;
use super::scan::Sheet;
use super::summed_distance::SummedDistance;
use crate::image::FilledImage;
use crate::reduce::heap::IndexedHeap;
use crate::reduce::hole::{self, HoleMethod, Scratch};
use crate::reduce::removal::{Mend, Rings};
use crate::triangulate::ImageMesh;

/// How holes are closed while vertices are judged: sides are turned towards the pixels afterwards.
const HOLE: HoleMethod = HoleMethod::ConstrainedDelaunay;

/// Takes vertices out of a mesh until `count` are left, each time the one whose loss costs least: the
/// growth of the summed distance of all pixels that it holds up, none counted above the cap.
///
/// Insertion cannot take back what it put in when faces were large and little was known; where few
/// vertices are left, that matters. The corners
/// of the image stay. O(pixels) for each halving.
pub(super) fn thin(
    image: &FilledImage,
    sheet: &Sheet,
    mesh: &ImageMesh,
    count: usize,
    options: &InverseDepth,
) -> ImageMesh {
    let inverse: Vec<f64> = mesh.depths_m.iter().map(|depth_m| 1.0 / depth_m).collect();
    let mut thinner = Thinner {
        distance: SummedDistance::new(image, sheet, options, count),
        inverse,
        rings: Rings::of_mesh(image, mesh),
        scratch: Scratch::default(),
    };
    let vertices = mesh.pixels.len();
    let keys = (0..vertices as u32).filter_map(|v| Some((thinner.cost_of(v)?, v))).collect();
    let mut heap = IndexedHeap::new(keys, vertices);
    let mut mend = Mend::default();
    while thinner.rings.alive() > count {
        let Some((_, vertex)) = heap.pop() else { break };
        mend.take_out(&mut thinner.rings, vertex, HOLE);
        for &neighbour in &mend.ring {
            if let Some(key) = thinner.cost_of(neighbour) {
                heap.set(neighbour, key);
            }
        }
    }
    thinner.rings.rest_of(mesh)
}

struct Thinner<'a> {
    distance: SummedDistance<'a>,
    inverse: Vec<f64>,
    rings: Rings,
    scratch: Scratch,
}

impl Thinner<'_> {
    /// What the loss of a vertex costs; none for the corners of the image.
    fn cost_of(&mut self, vertex: u32) -> Option<f32> {
        if self.rings.is_corner(vertex) {
            return None;
        }
        let ring = self.rings.of(vertex);
        let sides = ring.len() - usize::from(self.rings.is_on_border(vertex));
        let before: f32 = (0..sides)
            .map(|i| self.distance_m([vertex, ring[i], ring[(i + 1) % ring.len()]]))
            .sum();
        let polygon: Vec<_> = ring.iter().map(|&v| self.rings.pixel(v)).collect();
        hole::triangulate(HOLE, &polygon, &mut self.scratch);
        let pieces = &self.scratch.pieces;
        let after: f32 =
            pieces.iter().map(|piece| self.distance_m(piece.map(|i| ring[usize::from(i)]))).sum();
        Some(after - before)
    }

    fn distance_m(&self, corners: [u32; 3]) -> f32 {
        let pixels = corners.map(|corner| self.rings.pixel(corner));
        self.distance.of_m(pixels, corners.map(|corner| self.inverse[corner as usize]))
    }
}
