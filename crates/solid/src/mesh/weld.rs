//! Vertices at one place made one.

use std::cmp::Ordering;

use super::{Face, Label, Origin, Polyhedron};
use crate::Point3;

/// Orders points by x, y and z; the coordinates must be numbers. 0.0 and -0.0 are one place.
fn by_place(a: &Point3, b: &Point3) -> Ordering {
    let axis = |i: usize| a[i].partial_cmp(&b[i]).unwrap_or(Ordering::Equal);
    axis(0).then_with(|| axis(1)).then_with(|| axis(2))
}

/// For each point the first point at exactly the same place. O(n log n).
pub fn position_classes(points: &[Point3]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&i, &j| {
        by_place(&points[i as usize], &points[j as usize]).then(i.cmp(&j))
    });
    let mut first_of = vec![0; points.len()];
    let mut first = 0;
    for (rank, &vertex) in order.iter().enumerate() {
        let same = rank > 0 && points[order[rank - 1] as usize] == points[vertex as usize];
        if !same {
            first = vertex;
        }
        first_of[vertex as usize] = first;
    }
    first_of
}

/// A welded mesh and what became of its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Welded {
    /// The mesh, without two vertices at one place and without vertices that no face uses.
    pub mesh: Polyhedron,
    /// Faces of the input that lost a corner by it and are gone, ascending.
    pub collapsed: Vec<u32>,
}

/// Makes vertices at exactly the same place one, and drops vertices that no face uses.
///
/// Faces two of whose corners become one are left out. Nothing moves. What was a 2-manifold that
/// touches itself at a vertex or along an edge is none afterwards.
pub fn weld(mesh: &Polyhedron) -> Welded {
    let first_of = position_classes(mesh.vertices());
    let mut new_of = vec![u32::MAX; mesh.vertices().len()];
    let mut vertices = Vec::new();
    let mut faces: Vec<Face> = Vec::new();
    let mut labels: Vec<Label> = Vec::new();
    let mut origins: Option<Vec<Origin>> = mesh.origins().map(|_| Vec::new());
    let mut collapsed = Vec::new();
    for (face, corners) in mesh.faces().iter().enumerate() {
        let [a, b, c] = corners.map(|vertex| first_of[vertex as usize]);
        if a == b || b == c || c == a {
            collapsed.push(face as u32);
            continue;
        }
        faces.push([a, b, c].map(|vertex| {
            let new = &mut new_of[vertex as usize];
            if *new == u32::MAX {
                *new = vertices.len() as u32;
                vertices.push(mesh.vertices()[vertex as usize]);
            }
            *new
        }));
        labels.push(mesh.labels()[face]);
        if let (Some(origins), Some(old)) = (&mut origins, mesh.origins()) {
            origins.push(old[face]);
        }
    }
    Welded { mesh: Polyhedron::from_sound_parts(vertices, faces, labels, origins), collapsed }
}
