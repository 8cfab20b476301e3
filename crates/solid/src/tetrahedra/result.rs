//! The tetrahedra of a polyhedron.

use crate::predicates::orient3;
use crate::{Label, Point3};

/// One face of the input, as a face of a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryFace {
    /// Its corners, turned as in the input.
    pub corners: [u32; 3],
    /// The face of the input.
    pub face: u32,
    /// Its label.
    pub label: Label,
    /// The tetrahedra inside that have it: one, two where both of its sides are inside, none where both are
    /// outside.
    pub tetrahedra: [Option<u32>; 2],
}

/// The tetrahedra of a polyhedron.
///
/// What holds: all are positively oriented, exactly; their volumes add up to that of the input,
/// exactly; each face of the input is a face of a tetrahedron, and each face with one tetrahedron is
/// a face of the input; the vertices of the input have not moved; no added point lies on the boundary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tetrahedra {
    /// The vertices of the input, in their order, then the Steiner points, metres.
    pub vertices: Vec<Point3>,
    /// Four vertices each: seen from the fourth the other three run counter-clockwise.
    pub tetrahedra: Vec<[u32; 4]>,
    /// The tetrahedron across the face opposite each corner; `None` at the boundary. It is the dual
    /// graph; faces of the input that lie inside have neighbours too.
    pub neighbours: Vec<[Option<u32>; 4]>,
    /// The faces of the input, in their order, without those two corners of which are at one place.
    pub boundary: Vec<BoundaryFace>,
    /// How many points were added.
    pub steiner_points: usize,
}

impl Tetrahedra {
    /// How many faces of the input are faces of a tetrahedron inside: all where
    /// [`Inside::Odd`](super::Inside::Odd) says what is inside; not those that hang out of an enclosed space.
    pub fn preserved_faces(&self) -> usize {
        let has_inside = |face: &&BoundaryFace| face.tetrahedra.iter().any(Option::is_some);
        self.boundary.iter().filter(has_inside).count()
    }

    /// The volume of all tetrahedra, cubic metres: all are positive, and each is right to rounding however flat
    /// it is.
    pub fn volume_m3(&self) -> f64 {
        let six = |tet: &[u32; 4]| {
            let [a, b, c, d] = tet.map(|v| &self.vertices[v as usize]);
            orient3(a, b, c, d)
        };
        self.tetrahedra.iter().map(six).sum::<f64>() / 6.0
    }

    /// How many faces of the input have no space inside on either side: they hang out of an enclosed space, or
    /// lie between two that are outside.
    pub fn faces_outside(&self) -> usize {
        self.boundary.len() - self.preserved_faces()
    }
}
