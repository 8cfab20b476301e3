//! Step 3: who is next to whom, and the link condition.

use crate::{Face, Label, Point3, Polyhedron};

/// A mesh that is being taken apart: faces and vertices keep their numbers, or die.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<Point3>,
    pub(super) faces: Vec<Face>,
    pub(super) labels: Vec<Label>,
    pub(super) alive: Vec<bool>,
    /// Faces at each vertex, in no order that means anything but always the same.
    pub(super) at: Vec<Vec<u32>>,
    pub(super) count: usize,
}

impl Mesh {
    pub(super) fn of(mesh: &Polyhedron) -> Self {
        let mut at = vec![Vec::new(); mesh.vertices().len()];
        for (face, corners) in mesh.faces().iter().enumerate() {
            for &vertex in corners {
                at[vertex as usize].push(face as u32);
            }
        }
        Self {
            vertices: mesh.vertices().to_vec(),
            faces: mesh.faces().to_vec(),
            labels: mesh.labels().to_vec(),
            alive: vec![true; mesh.faces().len()],
            at,
            count: mesh.faces().len(),
        }
    }

    pub(super) fn corners(&self, face: Face) -> [&Point3; 3] {
        face.map(|vertex| &self.vertices[vertex as usize])
    }

    /// Vertices next to one, ascending.
    pub(super) fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let faces = self.at[vertex as usize].iter();
        let mut near: Vec<u32> = faces
            .flat_map(|&face| self.faces[face as usize])
            .filter(|&other| other != vertex)
            .collect();
        near.sort_unstable();
        near.dedup();
        near
    }

    /// Whether the faces at a vertex are one closed fan: it is neither on a border of the surface nor
    /// where the surface touches itself.
    pub(super) fn is_ringed(&self, vertex: u32) -> bool {
        let faces = &self.at[vertex as usize];
        let after = |face: u32| {
            let corners = self.faces[face as usize];
            let at = corners.iter().position(|&v| v == vertex).unwrap_or(0);
            (corners[(at + 1) % 3], corners[(at + 2) % 3])
        };
        let Some(&first) = faces.first() else { return false };
        let (start, mut end) = after(first);
        for passed in 1..=faces.len() {
            if end == start {
                return passed == faces.len();
            }
            let mut next = faces.iter().map(|&face| after(face)).filter(|(from, _)| *from == end);
            let (Some((_, to)), None) = (next.next(), next.next()) else { return false };
            end = to;
        }
        false
    }

    /// Whether drawing `from` into `to` leaves the surface the 2-manifold that it is: their common
    /// neighbours are the two corners opposite to their edge, and these two do not close a face with
    /// each of them.
    pub(super) fn link_holds(&self, from: u32, to: u32) -> bool {
        if !self.is_ringed(from) {
            return false;
        }
        let at_edge: Vec<Face> = self.faces_at_edge(from, to).collect();
        let [first, second] = at_edge[..] else { return false };
        let third = |face: Face| face.into_iter().find(|&v| v != from && v != to);
        let (Some(a), Some(b)) = (third(first), third(second)) else { return false };
        if a == b {
            return false;
        }
        let of_to = self.neighbours(to);
        let common = self.neighbours(from).into_iter().filter(|v| of_to.binary_search(v).is_ok());
        if !common.eq([a.min(b), a.max(b)]) {
            return false;
        }
        let closes = |vertex: u32| {
            self.at[vertex as usize].iter().any(|&face| {
                let corners = self.faces[face as usize];
                corners.contains(&a) && corners.contains(&b)
            })
        };
        !(closes(from) && closes(to))
    }

    pub(super) fn faces_at_edge(&self, from: u32, to: u32) -> impl Iterator<Item = Face> + '_ {
        let faces = self.at[from as usize].iter().map(|&face| self.faces[face as usize]);
        faces.filter(move |corners| corners.contains(&to))
    }

    /// The mesh that is left, without dead vertices.
    pub(super) fn finish(&self) -> Polyhedron {
        let mut new_of = vec![u32::MAX; self.vertices.len()];
        let (mut vertices, mut faces, mut labels) = (Vec::new(), Vec::new(), Vec::new());
        for (face, corners) in self.faces.iter().enumerate().filter(|&(face, _)| self.alive[face]) {
            labels.push(self.labels[face]);
            faces.push(corners.map(|vertex| {
                let new = &mut new_of[vertex as usize];
                if *new == u32::MAX {
                    *new = vertices.len() as u32;
                    vertices.push(self.vertices[vertex as usize]);
                }
                *new
            }));
        }
        Polyhedron::from_sound_parts(vertices, faces, labels, None)
    }
}
