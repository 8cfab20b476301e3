//! Which tetrahedra are taken out to be put together anew.

use crate::tetrahedra::flips::Work;
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

    /// Adds the neighbour that fits in best: that adds least vertices, and of those the one that
    /// shares most faces, then the first. False where there is none, or `most` vertices would be
    /// passed.
    pub(crate) fn grow(&mut self, work: &Work, most: usize) -> bool {
        let mesh = &work.mesh;
        let mut best: Option<((usize, usize, usize), u32)> = None;
        for &t in &self.tets {
            let tet = mesh.tet(t);
            for f in 0..4 {
                let other = tet.n[f] >> 2;
                if self.tets.contains(&other) || mesh.tet(other).is_ghost() {
                    continue;
                }
                let [a, b, c] = tet.face(f);
                if work.must.holds_face(a, b, c) {
                    continue;
                }
                let far = mesh.tet(other);
                let fresh = far.v.iter().filter(|v| !self.vertices.contains(v)).count();
                if self.vertices.len() + fresh > most {
                    continue;
                }
                let shared = far.n.iter().filter(|&&code| self.tets.contains(&(code >> 2))).count();
                let rank = (fresh, 4 - shared, best.map_or(0, |_| 1));
                if best.is_none_or(|(known, _)| rank < known) {
                    best = Some((rank, other));
                }
            }
        }
        match best {
            Some((_, t)) => {
                self.add(mesh, t);
                true
            }
            None => false,
        }
    }
}
