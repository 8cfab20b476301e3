//! A mesh with the tree that makes questions fast.

use crate::bvh::Bvh;
use crate::{Point3, Polyhedron};

/// A mesh to which questions are put.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    pub(super) mesh: &'a Polyhedron,
    pub(super) faces: Bvh,
    pub(super) bounds: Option<(Point3, Point3)>,
}

impl<'a> Solid<'a> {
    /// Gets ready; O(n log n).
    pub fn new(mesh: &'a Polyhedron) -> Self {
        Self { mesh, faces: Bvh::of_faces(mesh), bounds: mesh.bounds() }
    }

    /// The mesh.
    pub fn mesh(&self) -> &'a Polyhedron {
        self.mesh
    }

    /// The tree over its faces.
    pub fn tree(&self) -> &Bvh {
        &self.faces
    }
}
