//! What input is turned away, and why.

use crate::mesh::position_classes;
use crate::predicates::in_envelope;
use crate::validity::check;
use crate::{Defect, Point3, Polyhedron, SolidError};

/// What of space is inside.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Inside {
    /// What is behind an odd number of faces: for closed polyhedra, their shells and cavities.
    #[default]
    Odd,
    /// All that cannot be reached from outside, nor from one of these points, without passing a face:
    /// for complexes with inner faces.
    Enclosed(Vec<Point3>),
}

/// Input that passed the gate.
pub(super) struct Sound {
    /// The places, each once.
    pub(super) points: Vec<[f64; 3]>,
    /// For each vertex of the input its place; `u32::MAX` where no face uses it.
    pub(super) place_of: Vec<u32>,
    /// The faces over places, with the number of the input face.
    pub(super) faces: Vec<([u32; 3], u32)>,
}

/// Checks that all coordinates can be decided on.
pub(crate) fn check_points(points: &[Point3]) -> Result<(), SolidError> {
    match points.iter().position(|p| !in_envelope(p)) {
        Some(vertex) => {
            let [x, y, z] = points[vertex].coords.into();
            Err(SolidError::OutsideEnvelope { vertex, x, y, z })
        }
        None => Ok(()),
    }
}

/// Makes vertices at one place one, leaves out faces that lose a corner by that, and checks what is
/// left: no flat face, no two faces that meet elsewhere than at common corners and edges, and for
/// [`Inside::Odd`] an even number of faces at each edge.
pub(super) fn admit(mesh: &Polyhedron, inside: &Inside) -> Result<Sound, SolidError> {
    let class = position_classes(mesh.vertices());
    let mut place_of = vec![u32::MAX; class.len()];
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for (face, corners) in mesh.faces().iter().enumerate() {
        let [a, b, c] = corners.map(|v| class[v as usize]);
        if a == b || b == c || c == a {
            continue;
        }
        let places = [a, b, c].map(|first| {
            if place_of[first as usize] == u32::MAX {
                place_of[first as usize] = vertices.len() as u32;
                vertices.push(mesh.vertices()[first as usize]);
            }
            place_of[first as usize]
        });
        faces.push((places, face as u32));
    }
    for (v, &first) in class.iter().enumerate() {
        place_of[v] = place_of[first as usize];
    }
    let points = vertices.iter().map(|p| [p.x, p.y, p.z]).collect();
    let labels = faces.iter().map(|&(_, face)| mesh.labels()[face as usize]).collect();
    let welded = Polyhedron::try_new(vertices, faces.iter().map(|f| f.0).collect(), labels)?;
    let original = |face: u32| faces[face as usize].1;
    let defects: Vec<Defect> = check(&welded)
        .defects
        .into_iter()
        .filter_map(|defect| match defect {
            Defect::FlatFace { face } => Some(Defect::FlatFace { face: original(face) }),
            Defect::Crossing(mut crossing) => {
                crossing.faces = crossing.faces.map(original);
                Some(Defect::Crossing(crossing))
            }
            Defect::OpenEdge { vertices, faces } if *inside == Inside::Odd => {
                Some(Defect::OpenEdge {
                    vertices,
                    faces: faces.into_iter().map(original).collect(),
                })
            }
            _ => None,
        })
        .collect();
    if !defects.is_empty() {
        return Err(SolidError::NoVolume { defects });
    }
    Ok(Sound { points, place_of, faces })
}
