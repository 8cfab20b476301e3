//! The first tetrahedron and its four ghosts.

use crate::tetrahedra::mesh::{FACE, GHOST, Mesh, Tet};
use crate::tetrahedra::predicates::{P3, orient};

/// Four points, by index, that are not coplanar and positively oriented, each the first that serves;
/// `None` where all points lie in one plane. O(n) at worst.
pub(super) fn first_four(points: &[P3]) -> Option<[u32; 4]> {
    let a = 0;
    let b = (1..points.len()).find(|&i| points[i] != points[a])?;
    let c = (b + 1..points.len()).find(|&i| !collinear(&points[a], &points[b], &points[i]))?;
    for d in c + 1..points.len() {
        let side = orient(&points[a], &points[b], &points[c], &points[d]);
        if side > 0.0 {
            return Some([a as u32, b as u32, c as u32, d as u32]);
        }
        if side < 0.0 {
            return Some([a as u32, c as u32, b as u32, d as u32]);
        }
    }
    None
}

/// Whether three points lie on one line, exactly.
fn collinear(a: &P3, b: &P3, c: &P3) -> bool {
    (0..3).all(|axis| {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let coord = |p: &P3| robust::Coord { x: p[u], y: p[v] };
        robust::orient2d(coord(a), coord(b), coord(c)) == 0.0
    })
}

/// Makes the first tetrahedron of an empty mesh, and its ghosts.
pub(super) fn plant(mesh: &mut Mesh, corners: [u32; 4]) {
    let first = mesh.take_slot();
    mesh.tets[first as usize] = Tet { v: corners, n: [0; 4] };
    let mut ghosts = [0; 4];
    for (f, face) in FACE.iter().enumerate() {
        let ghost = mesh.take_slot();
        let [x, y, z] = face.map(|i| corners[i]);
        // Seen from the ghost's side the face runs the other way.
        mesh.tets[ghost as usize] = Tet { v: [x, z, y, GHOST], n: [0; 4] };
        mesh.join(4 * first + f as u32, 4 * ghost + 3);
        ghosts[f] = ghost;
    }
    for f in 0..4 {
        for g in f + 1..4 {
            // The ghosts of faces f and g share the edge that lacks both corners, f and g.
            let at = |ghost: u32, missing: usize| {
                let index = mesh.tet(ghost).index_of(corners[missing]);
                4 * ghost + index.unwrap_or(0) as u32
            };
            let (a, b) = (at(ghosts[f], g), at(ghosts[g], f));
            mesh.join(a, b);
        }
    }
    for corner in corners {
        mesh.at[corner as usize] = first;
    }
}
