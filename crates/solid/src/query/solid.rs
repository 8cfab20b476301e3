//! A mesh with the tree that makes questions fast.

use std::borrow::Cow;

use crate::bvh::Bvh;
use crate::{Point3, Polyhedron};

/// A mesh to which questions are put.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    pub(super) mesh: &'a Polyhedron,
    pub(super) faces: Cow<'a, Bvh>,
    pub(super) bounds: Option<(Point3, Point3)>,
}

impl<'a> Solid<'a> {
    /// Gets ready; O(n log n).
    pub fn new(mesh: &'a Polyhedron) -> Self {
        Self { mesh, faces: Cow::Owned(Bvh::of_faces(mesh)), bounds: mesh.bounds() }
    }

    /// Takes a tree that was made before, by [`Bvh::of_faces`] of the same mesh; O(1).
    pub fn with_tree(mesh: &'a Polyhedron, tree: &'a Bvh) -> Self {
        Self { mesh, faces: Cow::Borrowed(tree), bounds: tree.bounds() }
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
