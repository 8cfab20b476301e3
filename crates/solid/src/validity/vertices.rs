//! Step 2: whether the faces round a vertex are one fan.

use super::Defect;
use super::edges::{Use, runs};
use crate::Polyhedron;

/// Corner `i` of face `f` is number `3 f + i`; corners of one vertex are joined across its edges.
struct Corners {
    parent: Vec<u32>,
}

impl Corners {
    fn root(&mut self, mut corner: u32) -> u32 {
        while self.parent[corner as usize] != corner {
            let above = self.parent[self.parent[corner as usize] as usize];
            self.parent[corner as usize] = above;
            corner = above;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

/// The vertices at which more than one fan of faces meets, ascending. Almost O(n).
///
/// Faces are in one fan when they can be reached from one another across edges at the vertex.
pub(super) fn pinched(mesh: &Polyhedron, uses: &[Use]) -> Vec<Defect> {
    let mut corners = Corners { parent: (0..3 * mesh.faces().len() as u32).collect() };
    let corner_at = |face: u32, vertex: u32| {
        let at = mesh.faces()[face as usize].iter().position(|&v| v == vertex);
        3 * face + at.unwrap_or(0) as u32
    };
    for run in runs(uses) {
        for pair in run.windows(2) {
            for vertex in pair[0].edge {
                corners.join(corner_at(pair[0].face, vertex), corner_at(pair[1].face, vertex));
            }
        }
    }
    let mut fans = vec![0_usize; mesh.vertices().len()];
    for (corner, &vertex) in mesh.faces().iter().flatten().enumerate() {
        if corners.root(corner as u32) == corner as u32 {
            fans[vertex as usize] += 1;
        }
    }
    let pinched = fans.iter().enumerate().filter(|&(_, &fans)| fans > 1);
    pinched.map(|(vertex, &fans)| Defect::PinchedVertex { vertex: vertex as u32, fans }).collect()
}
