//! Step 4: what has no volume is no solid, and a flat face is none.

use super::surgery::Surgery;
use crate::predicates::{is_collinear, on_segment};
use crate::{Point3, Polyhedron};

/// Parts thinner than this share of their largest coordinate are leaves: no more than rounding.
const LEAF: f64 = 8.0 * f64::EPSILON;

/// The mesh without parts that bound no volume (two sheets that lie on each other), and without faces
/// whose corners lie on one line.
///
/// The thickness of a part, faces joined by vertices, is twice its volume over its area. A flat face
/// goes with the edge that its middle corner lies on: the face across is divided there. O(f).
pub(super) fn tidied(mesh: Polyhedron) -> Polyhedron {
    unflattened(without_leaves(mesh))
}

/// For each face the number of its part; and how many parts there are.
fn parts(mesh: &Polyhedron) -> (Vec<usize>, usize) {
    let mut parent: Vec<u32> = (0..mesh.vertices().len() as u32).collect();
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    for &[a, b, c] in mesh.faces() {
        let first = root(&mut parent, a);
        for other in [b, c] {
            let other = root(&mut parent, other);
            parent[other as usize] = first;
        }
    }
    let mut number = vec![usize::MAX; parent.len()];
    let mut count = 0;
    let of_face = |&[a, _, _]: &[u32; 3]| {
        let number = &mut number[root(&mut parent, a) as usize];
        if *number == usize::MAX {
            *number = count;
            count += 1;
        }
        *number
    };
    (mesh.faces().iter().map(of_face).collect(), count)
}

/// Six times the volume, twice the area, and the largest coordinate of a part.
#[derive(Clone, Copy)]
struct Measure {
    about: Point3,
    six_m3: f64,
    twice_m2: f64,
    reach_m: f64,
}

fn without_leaves(mesh: Polyhedron) -> Polyhedron {
    let (part_of, count) = parts(&mesh);
    let mut measures: Vec<Option<Measure>> = vec![None; count];
    for (face, &part) in part_of.iter().enumerate() {
        let corners = mesh.corners(face);
        let measure = measures[part].get_or_insert(Measure {
            about: *corners[0],
            six_m3: 0.0,
            twice_m2: 0.0,
            reach_m: 0.0,
        });
        let [a, b, c] = corners.map(|corner| corner - measure.about);
        measure.six_m3 += a.dot(&b.cross(&c));
        measure.twice_m2 += (b - a).cross(&(c - a)).norm();
        measure.reach_m = corners.iter().map(|p| p.coords.amax()).fold(measure.reach_m, f64::max);
    }
    let is_leaf = |measure: &Option<Measure>| {
        // Volume over area is a third of six volumes over twice the area, and twice that is thickness.
        measure.is_some_and(|m| m.six_m3.abs() * 2.0 / 3.0 <= LEAF * m.reach_m * m.twice_m2)
    };
    let leaves: Vec<bool> = measures.iter().map(is_leaf).collect();
    if !leaves.contains(&true) {
        return mesh;
    }
    let kept: Vec<usize> = (0..part_of.len()).filter(|&face| !leaves[part_of[face]]).collect();
    let (vertices, faces, labels, origins) = mesh.into_parts();
    let mut new_of = vec![u32::MAX; vertices.len()];
    for &face in &kept {
        faces[face].iter().for_each(|&v| new_of[v as usize] = 0);
    }
    let mut left = Vec::with_capacity(vertices.len());
    for (new, &vertex) in new_of.iter_mut().zip(&vertices).filter(|(new, _)| **new == 0) {
        *new = left.len() as u32;
        left.push(vertex);
    }
    Polyhedron::from_sound_parts(
        left,
        kept.iter().map(|&face| faces[face].map(|v| new_of[v as usize])).collect(),
        kept.iter().map(|&face| labels[face]).collect(),
        origins.map(|origins| kept.iter().map(|&face| origins[face]).collect()),
    )
}

fn unflattened(mesh: Polyhedron) -> Polyhedron {
    let is_flat = |corners: [&Point3; 3]| is_collinear(corners[0], corners[1], corners[2]);
    let flat: Vec<u32> = (0..mesh.faces().len() as u32)
        .filter(|&face| is_flat(mesh.corners(face as usize)))
        .collect();
    if flat.is_empty() {
        return mesh;
    }
    let mut surgery = Surgery::of(mesh);
    // A flip may leave the flat face across flat; each round brings it one face nearer to one that is
    // not, so that there are no more rounds than flat faces.
    let mut left = flat;
    for _ in 0..left.len() {
        let mut again = Vec::new();
        for face in left {
            if is_flat(surgery.corners(face)) && !unflatten(&mut surgery, face) {
                again.push(face);
            }
        }
        if again.is_empty() {
            break;
        }
        left = again;
    }
    surgery.done()
}

/// Divides the face across the longest side of a flat face, which goes; false where that does not do.
fn unflatten(surgery: &mut Surgery, face: u32) -> bool {
    let [a, b, c] = surgery.corners(face);
    let middle = [(b, c, a), (c, a, b), (a, b, c)]
        .into_iter()
        .position(|(from, to, at)| from != to && on_segment(at, from, to));
    // Corner i lies on the side between the two others, which starts at corner i + 1.
    let Some(i) = middle else { return false };
    let side = 3 * face + (i as u32 + 1) % 3;
    let at = *surgery.corners(face)[i];
    let Some(across) = surgery.beside(side).nth(1) else { return false };
    if !surgery.divides_across(side, &at) || surgery.flip(side).is_none() {
        return false;
    }
    // The flat face was no face at all: both are parts of the one across.
    surgery.liken(face, across);
    true
}
