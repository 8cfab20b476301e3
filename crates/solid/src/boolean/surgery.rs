//! A closed surface whose edges and faces can be divided, so that neighbours stay neighbours.

use crate::predicates::{facing_axis, orient_dropping, sign};
use crate::{Face, Label, Origin, Point3, Polyhedron};

/// No side across: the surface is open there.
const NONE: u32 = u32::MAX;

/// A surface under the knife. Side `3 f + i` runs from corner `i` of face `f` to the next.
#[derive(Clone, Debug)]
pub(super) struct Surgery {
    pub(super) vertices: Vec<Point3>,
    pub(super) faces: Vec<Face>,
    pub(super) labels: Vec<Label>,
    origins: Option<Vec<Origin>>,
    /// For each side the one that runs back along it.
    across: Vec<u32>,
    /// For each face the one of the mesh taken that it is part of.
    pub(super) root_of: Vec<u32>,
}

impl Surgery {
    /// Takes a mesh. Sides are paired one to one; in a 2-manifold that is how faces are joined.
    /// O(f log f).
    pub(super) fn of(mesh: Polyhedron) -> Self {
        let (vertices, faces, labels, origins) = mesh.into_parts();
        let mut sides: Vec<([u32; 2], bool, u32)> = Vec::with_capacity(3 * faces.len());
        for (f, &[a, b, c]) in faces.iter().enumerate() {
            for (i, (s, t)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                sides.push(([s.min(t), s.max(t)], s > t, (3 * f + i) as u32));
            }
        }
        sides.sort_unstable();
        let mut across = vec![NONE; sides.len()];
        for edge in sides.chunk_by(|a, b| a.0 == b.0) {
            let back = edge.partition_point(|side| !side.1);
            for (there, back) in edge[..back].iter().zip(&edge[back..]) {
                across[there.2 as usize] = back.2;
                across[back.2 as usize] = there.2;
            }
        }
        let root_of = (0..faces.len() as u32).collect();
        Self { vertices, faces, labels, origins, across, root_of }
    }

    /// The mesh that has become of it.
    pub(super) fn done(self) -> Polyhedron {
        Polyhedron::from_sound_parts(self.vertices, self.faces, self.labels, self.origins)
    }

    pub(super) fn corners(&self, face: u32) -> [&Point3; 3] {
        self.faces[face as usize].map(|vertex| &self.vertices[vertex as usize])
    }

    /// The ends of a side.
    pub(super) fn ends(&self, side: u32) -> [u32; 2] {
        let face = self.faces[side as usize / 3];
        [face[side as usize % 3], face[(side as usize + 1) % 3]]
    }

    /// The faces beside a side: its own, and the one across.
    pub(super) fn beside(&self, side: u32) -> impl Iterator<Item = u32> + use<> {
        let across = self.across[side as usize];
        [Some(side), Some(across).filter(|&side| side != NONE)].into_iter().flatten().map(|s| s / 3)
    }

    /// Whether the faces beside a side would stay as they are seen, none flat or turned round, with a
    /// corner at `at` in the middle of the side; exact.
    pub(super) fn divides(&self, side: u32, at: &Point3) -> bool {
        self.divides_own(side, at) && self.divides_across(side, at)
    }

    /// As [`divides`](Self::divides), of the face across alone.
    pub(super) fn divides_across(&self, side: u32, at: &Point3) -> bool {
        let across = self.across[side as usize];
        across == NONE || self.divides_own(across, at)
    }

    fn divides_own(&self, side: u32, at: &Point3) -> bool {
        let face = self.corners(side / 3);
        let i = side as usize % 3;
        let [a, b, c] = [face[i], face[(i + 1) % 3], face[(i + 2) % 3]];
        facing_axis(a, b, c).is_some_and(|axis| {
            let sense = sign(orient_dropping(axis, a, b, c));
            sign(orient_dropping(axis, a, at, c)) == sense
                && sign(orient_dropping(axis, at, b, c)) == sense
        })
    }

    /// Makes one face part of what another is part of.
    pub(super) fn liken(&mut self, face: u32, to: u32) {
        let (face, to) = (face as usize, to as usize);
        self.labels[face] = self.labels[to];
        self.root_of[face] = self.root_of[to];
        if let Some(origins) = &mut self.origins {
            origins[face] = origins[to];
        }
    }

    /// Puts a corner on a side. Each face beside it becomes two, the new ones at the end of the list.
    pub(super) fn divide_side(&mut self, side: u32, at: Point3) -> u32 {
        let vertex = self.vertices.len() as u32;
        self.vertices.push(at);
        let across = self.across[side as usize];
        let (first, second) = self.halve(side, vertex);
        if across == NONE {
            return vertex;
        }
        let (back_first, back_second) = self.halve(across, vertex);
        self.join(first, back_second);
        self.join(second, back_first);
        vertex
    }

    /// Makes two faces of one along the line from `vertex`, on `side`, to the opposite corner; the two
    /// halves of the side, in its sense.
    fn halve(&mut self, side: u32, vertex: u32) -> (u32, u32) {
        let (face, i) = (side / 3, side as usize % 3);
        let corners = self.faces[face as usize];
        let [_, b, c] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
        let new = self.add([vertex, b, c], face);
        self.faces[face as usize][(i + 1) % 3] = vertex;
        // The side from b to c goes to the new face, the line between the two is new.
        let outer = self.across[(3 * face) as usize + (i + 1) % 3];
        self.join(3 * new + 1, outer);
        self.join(3 * new + 2, 3 * face + ((i + 1) % 3) as u32);
        (side, 3 * new)
    }

    /// Puts a corner into a face, which becomes three.
    pub(super) fn divide_face(&mut self, face: u32, at: Point3) -> u32 {
        let vertex = self.vertices.len() as u32;
        self.vertices.push(at);
        let [a, b, c] = self.faces[face as usize];
        let (second, third) = (self.add([b, c, vertex], face), self.add([c, a, vertex], face));
        let [_, over_b, over_c] = [0, 1, 2].map(|i| self.across[3 * face as usize + i]);
        self.faces[face as usize] = [a, b, vertex];
        self.join(3 * second, over_b);
        self.join(3 * third, over_c);
        self.join(3 * face + 1, 3 * second + 2);
        self.join(3 * second + 1, 3 * third + 2);
        self.join(3 * third + 1, 3 * face + 2);
        vertex
    }

    /// A side between the two other corners of the faces beside it, instead of it. `None`, and nothing
    /// done, where there is such a side or none across.
    pub(super) fn flip(&mut self, side: u32) -> Option<[u32; 2]> {
        let across = Some(self.across[side as usize]).filter(|&across| across != NONE)?;
        let (f, i, g, j) = (side / 3, side as usize % 3, across / 3, across as usize % 3);
        let [a, b] = self.ends(side);
        let (c, d) = (self.faces[f as usize][(i + 2) % 3], self.faces[g as usize][(j + 2) % 3]);
        if f == g || c == d || self.are_joined(c, d, side) {
            return None;
        }
        let [bc, ca] = [1, 2].map(|step| self.across[3 * f as usize + (i + step) % 3]);
        let [ad, db] = [1, 2].map(|step| self.across[3 * g as usize + (j + step) % 3]);
        self.faces[f as usize] = [a, d, c];
        self.faces[g as usize] = [d, b, c];
        self.join(3 * f, ad);
        self.join(3 * f + 1, 3 * g + 2);
        self.join(3 * f + 2, ca);
        self.join(3 * g, db);
        self.join(3 * g + 1, bc);
        Some([f, g])
    }

    /// Whether a side joins `c`, the corner opposite to `side`, to `d`.
    fn are_joined(&self, c: u32, d: u32, side: u32) -> bool {
        // Round c, which is one fan in a 2-manifold.
        let start = 3 * (side / 3) + (side % 3 + 2) % 3;
        let mut out = start;
        loop {
            let [from, to] = self.ends(out);
            if from != c || to == d {
                return true;
            }
            let back = 3 * (out / 3) + (out % 3 + 2) % 3;
            if self.ends(back)[0] == d {
                return true;
            }
            out = self.across[back as usize];
            if out == NONE {
                return true;
            }
            if out == start {
                return false;
            }
        }
    }

    fn add(&mut self, corners: Face, like: u32) -> u32 {
        let new = self.faces.len() as u32;
        self.faces.push(corners);
        self.labels.push(self.labels[like as usize]);
        if let Some(origins) = &mut self.origins {
            origins.push(origins[like as usize]);
        }
        self.across.extend([NONE; 3]);
        self.root_of.push(self.root_of[like as usize]);
        new
    }

    fn join(&mut self, side: u32, other: u32) {
        self.across[side as usize] = other;
        if other != NONE {
            self.across[other as usize] = side;
        }
    }
}
