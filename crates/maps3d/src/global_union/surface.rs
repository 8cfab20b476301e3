//! Faces of a volume that can be asked about.

use solid::bvh::{Aabb, Bvh};
use solid::{Label, Point3, Polyhedron, Side, Solid};

use super::view::mesh_bytes;
use crate::plan::between;

/// A closed mesh with a tree over its faces.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub mesh: Polyhedron,
    tree: Bvh,
}

impl Surface {
    /// Gets ready; O(n log n).
    pub fn new(mesh: Polyhedron) -> Self {
        Self { tree: Bvh::of_faces(&mesh), mesh }
    }

    /// Where a point lies, exact.
    pub fn side(&self, point: &Point3) -> Side {
        Solid::with_tree(&self.mesh, &self.tree).side(point)
    }

    /// The least distance of a segment to a face of a label, metres, if it is less than `reach_m`.
    pub fn near(&self, from: &Point3, to: &Point3, reach_m: f64, label: Label) -> Option<f64> {
        // Boxes that hold the nearest face are small where faces are many.
        let shares = [1.0 / 32.0, 0.125, 0.25, 0.5, 1.0];
        shares.iter().find_map(|share| self.near_in_boxes(from, to, share * reach_m, label))
    }

    fn near_in_boxes(&self, from: &Point3, to: &Point3, reach_m: f64, label: Label) -> Option<f64> {
        let mut least = reach_m;
        let mut found = false;
        // Boxes round short pieces hold few faces.
        let pieces = ((to - from).norm() / (2.0 * reach_m)).ceil().clamp(1.0, 256.0);
        let at = |i: f64| from + (to - from) * (i / pieces);
        let mut i = 0.0;
        while i < pieces {
            let (a, b) = (at(i), at(i + 1.0));
            self.tree.each_touching(&Aabb::around([&a, &b]).grown(least), |face| {
                let face = face as usize;
                if self.mesh.labels()[face] != label {
                    return;
                }
                let (p, q) = between(&a, &b, &self.mesh.corners(face).map(|corner| *corner));
                let distance_m = (p - q).norm();
                if distance_m < least {
                    (least, found) = (distance_m, true);
                }
            });
            i += 1.0;
        }
        found.then_some(least)
    }

    /// Whether a segment meets any face.
    pub fn is_crossed(&self, from: &Point3, to: &Point3) -> bool {
        let mut crossed = false;
        self.tree.each_on_segment(from, to, |face| {
            crossed = crossed || {
                let corners = self.mesh.corners(face as usize);
                let contact = solid::predicates::segment_meets_triangle(from, to, corners);
                contact != solid::predicates::SegmentContact::Apart
            };
        });
        crossed
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        mesh_bytes(&self.mesh) + self.tree.heap_bytes()
    }
}
