//! Step 3: where faces coincide, the obstacle wins.

use crate::bvh::{Aabb, Bvh};
use crate::{Label, Point3, Polyhedron};

/// Faces nearer than this coincide, metres: ten times the jitter.
pub const COINCIDENT_M: f64 = 1e-7;

/// How much the cosine of the angle between the normals of coincident faces may fall short of 1.
const PARALLEL: f64 = 1e-6;

/// The obstacle faces of several meshes, to be found by place.
pub(super) struct Obstacles<'a> {
    faces: Vec<(&'a Polyhedron, usize, f64)>,
    tree: Bvh,
}

impl<'a> Obstacles<'a> {
    /// Each mesh with the sense in which its faces look: 1, or -1 where the operation turns them.
    pub(super) fn of(meshes: &[(&'a Polyhedron, f64)]) -> Self {
        let mut faces = Vec::new();
        for &(mesh, sense) in meshes {
            let labels = mesh.labels().iter().enumerate();
            let obstacle = labels.filter(|&(_, &label)| label == Label::Obstacle);
            faces.extend(obstacle.map(|(face, _)| (mesh, face, sense)));
        }
        let around =
            |&(mesh, face, _): &(&Polyhedron, usize, f64)| Aabb::around(mesh.corners(face));
        let boxes: Vec<Aabb> = faces.iter().map(around).collect();
        Self { tree: Bvh::new(&boxes), faces }
    }

    /// Whether the middle of a face lies on an obstacle face that looks the same way.
    fn coincides(&self, mesh: &Polyhedron, face: usize, eps_m: f64) -> bool {
        let [a, b, c] = mesh.corners(face);
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        let Some(normal) = mesh.scaled_normal(face).try_normalize(0.0) else { return false };
        let mut found = false;
        self.tree.each_touching(&Aabb::around([&middle]).grown(eps_m), |index| {
            let (other, of, sense) = self.faces[index as usize];
            found = found || {
                let theirs = other.scaled_normal(of).try_normalize(0.0);
                theirs.is_some_and(|theirs| {
                    sense * theirs.dot(&normal) > 1.0 - PARALLEL
                        && lies_on(&middle, other.corners(of), &theirs, eps_m)
                })
            };
        });
        found
    }
}

/// Whether a point is at most `eps_m` from a triangle's plane and from the inside of its sides.
fn lies_on(p: &Point3, corners: [&Point3; 3], normal: &crate::Vector3, eps_m: f64) -> bool {
    (p - corners[0]).dot(normal).abs() <= eps_m
        && (0..3).all(|i| {
            let side = corners[(i + 1) % 3] - corners[i];
            let inward = normal.cross(&side);
            (p - corners[i]).dot(&inward) >= -eps_m * inward.norm()
        })
}

/// The labels of `mesh` after the rule, and the faces that it changed, ascending.
pub(super) fn settle(
    mesh: &Polyhedron,
    obstacles: &Obstacles<'_>,
    eps_m: f64,
) -> (Vec<Label>, Vec<u32>) {
    let mut labels = mesh.labels().to_vec();
    let mut changed = Vec::new();
    for (face, label) in labels.iter_mut().enumerate() {
        if *label == Label::Frontier && obstacles.coincides(mesh, face, eps_m) {
            *label = Label::Obstacle;
            changed.push(face as u32);
        }
    }
    (labels, changed)
}

/// The mesh with every frontier face made obstacle whose middle lies within `eps_m` of an obstacle
/// face of one of `views` that looks the same way.
///
/// Neither vertices nor faces change. O((f + v) log v) for f faces of the mesh and v of the views.
pub fn obstacle_wins(mesh: &Polyhedron, views: &[Polyhedron], eps_m: f64) -> Polyhedron {
    let views: Vec<_> = views.iter().map(|view| (view, 1.0)).collect();
    let (labels, _) = settle(mesh, &Obstacles::of(&views), eps_m);
    relabelled(mesh.clone(), labels)
}

pub(super) fn relabelled(mesh: Polyhedron, labels: Vec<Label>) -> Polyhedron {
    let (vertices, faces, _, origins) = mesh.into_parts();
    Polyhedron::from_sound_parts(vertices, faces, labels, origins)
}
