//! Steps 3 and 4: flat faces, and pairs of faces that meet where they should not.

use std::ops::ControlFlow;

use super::faces_meet::meet;
use crate::bvh::Bvh;
use crate::mesh::position_classes;
use crate::predicates::is_collinear;
use crate::{Point3, Polyhedron};

/// How two faces meet that should not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contact {
    /// They pass through each other.
    Cross,
    /// They have a point in common, and neither passes through the other.
    Touch,
    /// They lie in one plane and have an area in common.
    Overlap,
}

/// Two faces that have more in common than corners and edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The faces, ascending.
    pub faces: [u32; 2],
    /// How they meet.
    pub contact: Contact,
    /// Near where they meet, to rounding.
    pub at: Point3,
}

/// The faces whose corners lie exactly on one line, ascending.
pub(super) fn flat_faces(mesh: &Polyhedron) -> Vec<u32> {
    let is_flat = |face: &usize| {
        let [a, b, c] = mesh.corners(*face);
        is_collinear(a, b, c)
    };
    (0..mesh.faces().len()).filter(is_flat).map(|face| face as u32).collect()
}

/// The pairs of faces that have more in common than corners and edges at the same places, at most
/// `limit` of them, ascending; exact.
///
/// Flat faces are left out: they are found by themselves. O(n log n) where few boxes touch.
pub fn crossings(mesh: &Polyhedron, limit: usize) -> Vec<Crossing> {
    crossings_of(mesh, &flat_faces(mesh), limit)
}

pub(super) fn crossings_of(mesh: &Polyhedron, flat: &[u32], limit: usize) -> Vec<Crossing> {
    let place_of = position_classes(mesh.vertices());
    let places = |face: u32| mesh.faces()[face as usize].map(|vertex| place_of[vertex as usize]);
    let mut found = Vec::new();
    if limit == 0 {
        return found;
    }
    Bvh::of_faces(mesh).each_pair(|a, b| {
        let is_flat = |face: u32| flat.binary_search(&face).is_ok();
        if !is_flat(a) && !is_flat(b) {
            let meeting =
                meet(mesh.corners(a as usize), places(a), mesh.corners(b as usize), places(b));
            if let Some((contact, at)) = meeting {
                found.push(Crossing { faces: [a, b], contact, at });
            }
        }
        if found.len() < limit { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    found.sort_by_key(|crossing| crossing.faces);
    found
}
