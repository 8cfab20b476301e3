//! Step 5, last part: where faces coincide, the obstacle wins.

use super::covered::{border_m, cut};
use crate::bvh::{Aabb, Bvh};
use crate::{Label, Point3, Polyhedron, Vector3};

/// Faces nearer than this coincide, metres: ten times the jitter.
pub const COINCIDENT_M: f64 = 1e-7;

/// How much the cosine of the angle between the normals of coincident faces may fall short of 1.
pub(super) const PARALLEL: f64 = 1e-6;

/// An obstacle face, and the way that it looks.
struct Face<'a> {
    corners: [&'a Point3; 3],
    looks: Vector3,
    /// The place of its mesh in the list of meshes.
    mesh: u32,
    vertices: [u32; 3],
}

/// The obstacle faces of several meshes, to be found by place.
pub(super) struct Obstacles<'a> {
    faces: Vec<Face<'a>>,
    tree: Bvh,
}

impl<'a> Obstacles<'a> {
    /// Each mesh with the sense in which its faces look: 1, or -1 where the operation turns them.
    pub(super) fn of(meshes: &[(&'a Polyhedron, f64)]) -> Self {
        let mut faces = Vec::new();
        for (number, &(mesh, sense)) in (0..).zip(meshes) {
            let labels = mesh.labels().iter().enumerate();
            let obstacle = labels.filter(|&(_, &label)| label == Label::Obstacle);
            faces.extend(obstacle.filter_map(|(face, _)| {
                let looks = mesh.scaled_normal(face).try_normalize(0.0)? * sense;
                let (corners, vertices) = (mesh.corners(face), mesh.faces()[face]);
                Some(Face { corners, looks, mesh: number, vertices })
            }));
        }
        let boxes: Vec<Aabb> = faces.iter().map(|face| Aabb::around(face.corners)).collect();
        Self { tree: Bvh::new(&boxes), faces }
    }

    /// For each side of each obstacle face the obstacle face of the same mesh across it; `u32::MAX` where
    /// there is none. O(f log f).
    pub(super) fn across(&self) -> Vec<[u32; 3]> {
        let mut sides = Vec::with_capacity(3 * self.faces.len());
        for (number, face) in self.faces.iter().enumerate() {
            let [a, b, c] = face.vertices;
            for (i, (s, t)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                sides.push((face.mesh, [s.min(t), s.max(t)], number as u32, i));
            }
        }
        sides.sort_unstable();
        let mut across = vec![[u32::MAX; 3]; self.faces.len()];
        for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if let [(_, _, f, i), (_, _, g, j)] = *edge {
                across[f as usize][i] = g;
                across[g as usize][j] = f;
            }
        }
        across
    }

    /// Calls `found` with the number and the corners of each obstacle face whose box comes within `eps_m` of that of
    /// `points` and that looks the way of `normal`, of length 1.
    pub(super) fn each_near<'b>(
        &self,
        points: impl IntoIterator<Item = &'b Point3>,
        normal: &Vector3,
        eps_m: f64,
        mut found: impl FnMut(u32, [&'a Point3; 3]),
    ) {
        self.tree.each_touching(&Aabb::around(points).grown(eps_m), |index| {
            let face = &self.faces[index as usize];
            if face.looks.dot(normal) > 1.0 - PARALLEL {
                found(index, face.corners);
            }
        });
    }

    /// Whether the middle of a face lies on an obstacle face that looks the same way.
    fn coincides(&self, mesh: &Polyhedron, face: usize, eps_m: f64) -> bool {
        let corners = mesh.corners(face);
        let [a, b, c] = corners;
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        let Some(normal) = mesh.scaled_normal(face).try_normalize(0.0) else { return false };
        let border = border_m(eps_m, middle.coords.amax());
        let mut found = false;
        self.each_near([&middle], &normal, eps_m, |_, other| {
            found = found || lies_on(&middle, other, eps_m, border);
        });
        found
    }
}

/// Whether a point is at most `eps_m` from a triangle's plane, and at most `border_m` outside of its
/// sides.
fn lies_on(p: &Point3, corners: [&Point3; 3], eps_m: f64, border_m: f64) -> bool {
    let [a, b, c] = corners;
    let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { return false };
    (p - a).dot(&normal).abs() <= eps_m
        && (0..3).all(|i| {
            let side = corners[(i + 1) % 3] - corners[i];
            let inward = normal.cross(&side);
            (p - corners[i]).dot(&inward) >= -border_m * inward.norm()
        })
}

/// The mesh after the last part of the rule, and the faces of it that became obstacle, ascending.
pub(super) fn settle(
    mesh: Polyhedron,
    obstacles: &Obstacles<'_>,
    eps_m: f64,
) -> (Polyhedron, Vec<u32>) {
    let mut labels = mesh.labels().to_vec();
    let mut changed = Vec::new();
    for (face, label) in labels.iter_mut().enumerate() {
        if *label == Label::Frontier && obstacles.coincides(&mesh, face, eps_m) {
            *label = Label::Obstacle;
            changed.push(face as u32);
        }
    }
    let (vertices, faces, _, origins) = mesh.into_parts();
    (Polyhedron::from_sound_parts(vertices, faces, labels, origins), changed)
}

/// The mesh with frontier made obstacle where it lies within `eps_m` of an obstacle face of one of
/// `views` that looks the same way.
///
/// A frontier face that is covered in part is cut along the border of the covered part, to
/// `eps_m / 1000`, and so are its neighbours where the border meets their edges: what was a closed
/// 2-manifold stays one. O((f + v) log v) for f faces of the mesh and v of the views, and what is cut.
pub fn obstacle_wins(mesh: &Polyhedron, views: &[Polyhedron], eps_m: f64) -> Polyhedron {
    let views: Vec<_> = views.iter().map(|view| (view, 1.0)).collect();
    let obstacles = Obstacles::of(&views);
    settle(cut(mesh.clone(), &obstacles, eps_m), &obstacles, eps_m).0
}
