//! The surface joined to the camera.

use nalgebra::Point3;
use sensing::Camera;
use solid::{Label, Polyhedron};

use crate::Maps3dError;
use crate::triangulate::ImageMesh;

/// The polyhedron of a view, in the frame `camera`: the lifted faces, and unless it is left `open` a
/// face from the camera to each edge of the border (\[Mos15\] 3.8, scenario 7; its switch `-o`).
///
/// Faces look outward. Those that lead to the camera are frontier (5.7.1). The first vertices and faces
/// are those of the mesh; the camera is the last vertex. What holds of a mesh that
/// [`check_planar`](crate::triangulate::check_planar) accepts: the closed polyhedron is a 2-manifold of
/// positive volume that does not intersect itself, since a ray from the camera meets it once, and
/// moving a vertex along its ray does not change that. A rigid transform rounds, and may.
///
/// # Errors
/// [`Maps3dError::Solid`] where labels do not match faces.
pub fn join(
    mesh: &ImageMesh,
    labels: &[Label],
    camera: &Camera,
    open: bool,
) -> Result<Polyhedron, Maps3dError> {
    let mut vertices: Vec<Point3<f64>> = mesh.points_in_camera(camera);
    let mut faces = mesh.triangles.clone();
    let mut labels = labels.to_vec();
    if !open {
        let origin = vertices.len() as u32;
        vertices.push(Point3::origin());
        let border = mesh.border();
        for (i, &vertex) in border.iter().enumerate() {
            // The face within has this edge in order; the one without, in the other.
            let next = border[(i + 1) % border.len()];
            faces.push([next, vertex, origin]);
            labels.push(Label::Frontier);
        }
    }
    if !camera.is_right_handed() {
        // The image shows the world mirrored: what turns positively there looks inward here.
        for face in &mut faces {
            face.swap(1, 2);
        }
    }
    Ok(Polyhedron::try_new(vertices, faces, labels)?)
}

/// The volume between the camera and the surface, cubic metres.
///
/// A sum of tetrahedra with the camera as a corner, all of them positive: no digits are lost, as they
/// are in the sum of a general mesh when it is long and thin. O(faces).
pub fn volume_m3(mesh: &ImageMesh, camera: &Camera) -> f64 {
    let points = mesh.points_in_camera(camera);
    let six: f64 = mesh
        .triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| points[vertex as usize].coords);
            a.dot(&b.cross(&c)).abs()
        })
        .sum();
    six / 6.0
}
