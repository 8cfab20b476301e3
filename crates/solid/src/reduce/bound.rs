//! Step 6: original vertices and the faces that they are kept with.

use super::star::Mesh;
use crate::query::distance_to_triangle;
use crate::{Face, Point3};

/// Which original vertices are kept with which face.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    points: Vec<Point3>,
    with: Vec<Vec<u32>>,
    /// How far the border has moved so far, at each vertex, metres.
    pub(super) border_m: Vec<f64>,
    /// The greatest distance so far, metres.
    pub(super) greatest_m: f64,
}

impl Kept {
    /// A vertex that stays lies on the surface: only what is taken out is kept with a face.
    pub(super) fn of(mesh: &Mesh) -> Self {
        Self {
            points: mesh.vertices.clone(),
            with: vec![Vec::new(); mesh.faces.len()],
            border_m: vec![0.0; mesh.vertices.len()],
            greatest_m: 0.0,
        }
    }

    /// Where the points kept with `old` faces, and `from` itself, would go: for each the index into
    /// `new`. `None` where one would be farther than the bound; then the greatest distance.
    pub(super) fn place(
        &self,
        mesh: &Mesh,
        from: u32,
        old: &[u32],
        new: &[Face],
        bound_m: f64,
    ) -> Option<(Vec<(u32, u32)>, f64)> {
        let mut placed = Vec::new();
        let mut greatest = 0.0_f64;
        let waiting = old.iter().flat_map(|&face| self.with[face as usize].iter().copied());
        for point in waiting.chain([from]) {
            let at = &self.points[point as usize];
            let mut best = (f64::INFINITY, 0);
            for (index, &face) in new.iter().enumerate() {
                let distance = distance_to_triangle(at, mesh.corners(face));
                if distance < best.0 {
                    best = (distance, index as u32);
                }
            }
            if best.0 > bound_m {
                return None;
            }
            greatest = greatest.max(best.0);
            placed.push((point, best.1));
        }
        Some((placed, greatest))
    }

    /// Keeps points as [`place`](Self::place) said; `faces` are the numbers of the new faces.
    pub(super) fn settle(
        &mut self,
        old: &[u32],
        faces: &[u32],
        placed: &[(u32, u32)],
        greatest: f64,
    ) {
        for &face in old {
            self.with[face as usize].clear();
        }
        for &(point, index) in placed {
            self.with[faces[index as usize] as usize].push(point);
        }
        self.greatest_m = self.greatest_m.max(greatest);
    }
}
