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
        vertices.push(Point3::origin());
        faces.extend(closing_faces(mesh));
        labels.resize(faces.len(), Label::Frontier);
    }
    for face in &mut faces {
        *face = outward(camera, *face);
    }
    Ok(Polyhedron::try_new(vertices, faces, labels)?)
}

/// A face from each edge of the border to the camera, which is the vertex after those of the mesh.
pub(super) fn closing_faces(mesh: &ImageMesh) -> Vec<[u32; 3]> {
    let (border, origin) = (mesh.border(), mesh.pixels.len() as u32);
    let nexts = border.iter().cycle().skip(1);
    // The face within has this edge in order; the one without, in the other.
    border.iter().zip(nexts).map(|(&vertex, &next)| [next, vertex, origin]).collect()
}

/// A face that turns positively in the image, turned so that it looks outward.
pub(crate) fn outward(camera: &Camera, [a, b, c]: [u32; 3]) -> [u32; 3] {
    // Where the image shows the world mirrored, what turns positively there looks inward here.
    if camera.is_right_handed() { [a, b, c] } else { [a, c, b] }
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
