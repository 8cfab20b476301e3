//! The tetrahedra of a star-shaped view.

use super::result::{BoundaryFace, Tetrahedra};
use crate::predicates::orient3;
use crate::{Point3, Polyhedron, SolidError};

/// Joins each face of a closed polyhedron to a point that sees all of them from inside, or lies on some
/// of them: for a view, the sensor. Faces in whose plane the point lies need no tetrahedron.
///
/// It cannot fail for star-shaped input, adds no point but `origin` where that is no vertex, and is
/// linear in the number of faces: an oracle for volume and membership, and a way out where
/// [`tetrahedralize`](super::tetrahedralize) refuses.
///
/// # Errors
///
/// [`SolidError::NotStar`] names the first face that `origin`, metres, in the frame of the mesh, sees
/// from outside.
pub fn fan(mesh: &Polyhedron, origin: &Point3) -> Result<Tetrahedra, SolidError> {
    let mut vertices = mesh.vertices().to_vec();
    let known = vertices.iter().position(|v| v == origin);
    let apex = known.unwrap_or(vertices.len()) as u32;
    let steiner_points = usize::from(known.is_none());
    if known.is_none() {
        vertices.push(*origin);
    }
    let mut tetrahedra = Vec::new();
    let mut boundary = Vec::new();
    let mut halves: Vec<([u32; 2], u32, u8)> = Vec::new();
    for (face, (&corners, &label)) in mesh.faces().iter().zip(mesh.labels()).enumerate() {
        let [a, b, c] = mesh.corners(face);
        // Faces are counter-clockwise from outside, so that what is inside sees them clockwise.
        let side = orient3(a, b, c, origin);
        if side > 0.0 {
            return Err(SolidError::NotStar { face, x: origin.x, y: origin.y, z: origin.z });
        }
        let mut own = None;
        if side < 0.0 {
            let t = tetrahedra.len() as u32;
            let [x, y, z] = corners;
            tetrahedra.push([x, z, y, apex]);
            for (i, [p, q]) in [[z, y], [x, y], [x, z]].into_iter().enumerate() {
                halves.push(([p.min(q), p.max(q)], t, i as u8));
            }
            own = Some(t);
        }
        boundary.push(BoundaryFace { corners, face: face as u32, label, tetrahedra: [own, None] });
    }
    let mut neighbours = vec![[None; 4]; tetrahedra.len()];
    halves.sort_unstable();
    for pair in halves.windows(2) {
        let [(edge, t, i), (other, u, j)] = [pair[0], pair[1]];
        if edge == other {
            neighbours[t as usize][i as usize] = Some(u);
            neighbours[u as usize][j as usize] = Some(t);
        }
    }
    Ok(Tetrahedra { vertices, tetrahedra, neighbours, boundary, steiner_points })
}
