//! Step 5, second part: where a surface touches itself, it does so at common corners and edges.

use std::collections::BTreeMap;

use super::surgery::Surgery;
use crate::bvh::{Aabb, Bvh};
use crate::mesh::position_classes;
use crate::predicates::{in_triangle, on_segment};
use crate::{Point3, Polyhedron};

/// The mesh with its edges and faces divided at every vertex that lies exactly on them; the same mesh
/// where none does.
///
/// Where operands touch at a part of an edge, each has vertices in the middle of edges of the other.
/// Both get corners there, at the same places, so that what they have in common are whole edges.
/// O(f log f) where few boxes of faces hold vertices of others.
pub(super) fn conforming(mesh: Polyhedron) -> Polyhedron {
    let places = position_classes(mesh.vertices());
    let firsts: Vec<u32> =
        (0..).zip(&places).filter(|&(v, &first)| v == first).map(|(v, _)| v).collect();
    let boxes: Vec<Aabb> =
        firsts.iter().map(|&v| Aabb::around([&mesh.vertices()[v as usize]])).collect();
    let tree = Bvh::new(&boxes);
    let mut found: Vec<(u32, Point3)> = Vec::new();
    for face in 0..mesh.faces().len() {
        let corners = mesh.corners(face);
        let own = mesh.faces()[face].map(|vertex| places[vertex as usize]);
        tree.each_touching(&Aabb::around(corners), |index| {
            let vertex = firsts[index as usize];
            let place = &mesh.vertices()[vertex as usize];
            if !own.contains(&vertex) && in_triangle(place, corners) {
                found.push((face as u32, *place));
            }
        });
    }
    if found.is_empty() {
        return mesh;
    }
    let mut surgery = Surgery::of(mesh);
    let mut pieces: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (face, place) in found {
        let waiting = pieces.get(&face).cloned().unwrap_or_else(|| vec![face]);
        let before = surgery.faces.len() as u32;
        for piece in waiting {
            if divide(&mut surgery, piece, &place) {
                break;
            }
        }
        for new in before..surgery.faces.len() as u32 {
            let root = surgery.root_of[new as usize];
            pieces.entry(root).or_insert_with(|| vec![root]).push(new);
        }
    }
    surgery.done()
}

/// Divides a face, or a side of it, at a place on it; whether that is settled.
fn divide(surgery: &mut Surgery, face: u32, place: &Point3) -> bool {
    let corners = surgery.corners(face);
    if corners.contains(&place) {
        return true;
    }
    for i in 0..3 {
        if on_segment(place, corners[i], corners[(i + 1) % 3]) {
            let side = 3 * face + i as u32;
            let divides = surgery.divides(side, place);
            if divides {
                surgery.divide_side(side, *place);
            }
            return divides;
        }
    }
    let inside = in_triangle(place, corners);
    if inside {
        surgery.divide_face(face, *place);
    }
    inside
}
