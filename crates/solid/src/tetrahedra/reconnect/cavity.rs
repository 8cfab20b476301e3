//! Which tetrahedra are taken out to be put together anew.

use crate::tetrahedra::mesh::Mesh;

/// Some tetrahedra, and the vertices that they have.
#[derive(Clone, Debug, Default)]
pub(crate) struct Region {
    /// Their slots.
    pub(crate) tets: Vec<u32>,
    /// Their vertices.
    pub(crate) vertices: Vec<u32>,
}

impl Region {
    /// A region of some tetrahedra.
    pub(crate) fn of(mesh: &Mesh, tets: &[u32]) -> Self {
        let mut region = Self::default();
        for &t in tets {
            region.add(mesh, t);
        }
        region
    }

    /// Adds a tetrahedron.
    pub(crate) fn add(&mut self, mesh: &Mesh, t: u32) {
        self.tets.push(t);
        for v in mesh.tet(t).v {
            if !self.vertices.contains(&v) {
                self.vertices.push(v);
            }
        }
    }
}
