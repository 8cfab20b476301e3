//! How valid the polyhedron of a view is, from the proof in the image plane.

use nalgebra::Point3;
use sensing::Camera;
use solid::{Polyhedron, Validity, check};

use super::join::{closing_faces, outward};
use crate::image::FilledImage;
use crate::triangulate::{ImageMesh, check_planar};

/// How far the rays of vertices may lie from those of their pixels, pixels.
///
/// The height of a triangle on pixels is at least one over its longest side, so above 4e-5: corners that
/// move by less than this neither turn a face over nor tangle the border of the image.
const OFF_PX: f64 = 1e-6;

/// What [`solid::check`] says of a polyhedron that was [joined](super::join) from a mesh, without a look at
/// pairs of faces.
///
/// 1. The mesh is a planar triangulation of the image ([`check_planar`]) without a vertex to spare.
/// 2. The polyhedron has its faces, the camera, and one face from there to each edge of the border.
/// 3. Rounding has moved no vertex off the ray of its pixel by more than a millionth of a pixel: less than
///    would turn a face over, as seen from the camera. So a ray meets the surface once still.
///
/// Then the polyhedron is closed, oriented, a 2-manifold, and does not meet itself. Where a step fails,
/// or the polyhedron is open, pairs of faces are looked at. O(n log n).
pub fn validity(image: &FilledImage, mesh: &ImageMesh, polyhedron: &Polyhedron) -> Validity {
    let proved = is_joined(mesh, image.camera(), polyhedron)
        && is_on_rays(mesh, image.camera(), polyhedron.vertices())
        && check_planar(mesh, image.columns(), image.rows()).is_ok();
    if !proved {
        return check(polyhedron);
    }
    Validity {
        closed: true,
        oriented: true,
        manifold: true,
        self_intersecting: false,
        defects: Vec::new(),
    }
}

/// Step 2, and that every vertex of the mesh has a face.
fn is_joined(mesh: &ImageMesh, camera: &Camera, polyhedron: &Polyhedron) -> bool {
    let (vertices, faces) = (polyhedron.vertices(), polyhedron.faces());
    let (count, surface) = (mesh.pixels.len(), mesh.triangles.len());
    if vertices.len() != count + 1 || vertices[count] != Point3::origin() {
        return false;
    }
    let mut used = vec![false; count];
    for &vertex in mesh.triangles.iter().flatten() {
        match used.get_mut(vertex as usize) {
            Some(used) => *used = true,
            None => return false,
        }
    }
    let closing = closing_faces(mesh);
    if used.contains(&false) || faces.len() != surface + closing.len() {
        return false;
    }
    let expected = mesh.triangles.iter().chain(&closing);
    faces.iter().zip(expected).all(|(&face, &expected)| face == outward(camera, expected))
}

/// Step 3.
fn is_on_rays(mesh: &ImageMesh, camera: &Camera, vertices: &[Point3<f64>]) -> bool {
    // Back on the image, numbers have this many digits.
    let digits = 8.0 * f64::EPSILON * (camera.cx.abs().max(camera.cy.abs()) + 32_768.0);
    digits < OFF_PX
        && mesh.pixels.iter().zip(vertices).all(|(pixel, point)| {
            let [column, row] = pixel.map(f64::from);
            let off = |slope: f64, focal: f64, center: f64, at: f64| {
                (slope * focal + (center - at)).abs() < OFF_PX - digits
            };
            point.z > 0.0
                && off(point.x / point.z, camera.fx, camera.cx, column)
                && off(point.y / point.z, camera.fy, camera.cy, row)
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Made, ViewOptions, polyhedron};
    use sensing::DepthImage;
    use solid::Label;

    fn made(open: bool) -> Made {
        let depths = (0..30).map(|i| 1.0 + (i * 7 % 5) as f32).collect();
        let image = DepthImage::new(6, Camera::new(5.0, 5.0, 2.5, 2.0), depths);
        polyhedron(&image, &ViewOptions { open, ..Default::default() }).expect("valid")
    }

    #[test]
    fn what_is_broken_is_looked_at_face_by_face() {
        let Made { image, mesh, polyhedron, .. } = made(false);
        let (vertices, faces) = (polyhedron.vertices().to_vec(), polyhedron.faces().to_vec());
        let of = |vertices: &[Point3<f64>], faces: &[[u32; 3]]| {
            let labels = vec![Label::Obstacle; faces.len()];
            let broken = Polyhedron::try_new(vertices.to_vec(), faces.to_vec(), labels);
            let broken = broken.expect("a mesh");
            let told = validity(&image, &mesh, &broken);
            assert_eq!(told, check(&broken));
            told.is_valid()
        };
        assert!(of(&vertices, &faces));
        assert!(!of(&vertices, &faces[1..]));
        let mut turned = faces.clone();
        turned[3].swap(0, 1);
        assert!(!of(&vertices, &turned));
        let mut moved = vertices.clone();
        moved[8] = Point3::new(vertices[30].x - 1.0, 0.3, vertices[15].z);
        assert!(!of(&moved, &faces));
        let mut behind = vertices;
        behind[30].z = -0.5;
        of(&behind, &faces);
    }

    #[test]
    fn an_open_surface_is_not_closed() {
        let Made { image, mesh, polyhedron, .. } = made(true);
        let told = validity(&image, &mesh, &polyhedron);
        assert!(!told.closed && !told.self_intersecting);
        assert_eq!(told, check(&polyhedron));
    }

    #[test]
    fn a_camera_without_digits_left_proves_nothing() {
        let Made { mesh, polyhedron, .. } = made(false);
        let far = Camera::new(5.0, 5.0, 1e12, 2.0);
        assert!(!is_on_rays(&mesh, &far, polyhedron.vertices()));
        assert!(!is_on_rays(&mesh, &Camera::new(5.0, 5.0, 2.6, 2.0), polyhedron.vertices()));
    }
}
