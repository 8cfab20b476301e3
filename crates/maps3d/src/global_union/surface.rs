//! Faces of a volume that can be asked about.

use solid::bvh::{Aabb, Bvh};
use solid::query::distance_to_triangle;
use solid::{Label, Point3, Polyhedron, Side, Solid, Vector3};

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

    /// Whether an obstacle face that looks about the way of a unit vector is nearer to a point than `wall_m`.
    pub fn is_wall(&self, point: &Point3, normal: &Vector3, cosine: f64, wall_m: f64) -> bool {
        let mut found = false;
        self.tree.each_touching(&Aabb::around([point]).grown(wall_m), |face| {
            let face = face as usize;
            found = found
                || (self.mesh.labels()[face] == Label::Obstacle && {
                    let theirs = self.mesh.scaled_normal(face);
                    theirs.dot(normal) >= cosine * theirs.norm()
                        && distance_to_triangle(point, self.mesh.corners(face)) <= wall_m
                });
        });
        found
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
