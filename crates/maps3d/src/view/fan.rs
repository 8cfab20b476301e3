//! The tetrahedra of a view, placed.

use pose::Se3;
use solid::predicates::{in_envelope, orient3};
use solid::{Point3, Polyhedron, SolidError, Tetrahedra, tetrahedra};

/// The fan of a view's polyhedron around its camera, in the frame that `target_from_camera` leads to.
/// Tetrahedra that rounding turned over are left out. O(n log n) for n faces.
///
/// # Errors
/// [`SolidError::NotStar`] where rounding made the view none, [`SolidError::OutsideEnvelope`] where the pose
/// is out of this world.
pub(crate) fn placed_fan(
    in_camera: &Polyhedron,
    target_from_camera: &Se3,
) -> Result<Tetrahedra, SolidError> {
    let mut fan = tetrahedra::fan(in_camera, &Point3::origin())?;
    for (vertex, point) in fan.vertices.iter_mut().enumerate() {
        *point = target_from_camera.transform(point);
        if !in_envelope(point) {
            let [x, y, z] = point.coords.into();
            return Err(SolidError::OutsideEnvelope { vertex, x, y, z });
        }
    }
    Ok(without_flat(fan))
}

fn without_flat(mut fan: Tetrahedra) -> Tetrahedra {
    let sound = |tet: &[u32; 4]| {
        let [a, b, c, d] = tet.map(|v| &fan.vertices[v as usize]);
        orient3(a, b, c, d) > 0.0
    };
    let mut new_of = vec![None; fan.tetrahedra.len()];
    let mut kept = 0;
    for (new, tet) in new_of.iter_mut().zip(&fan.tetrahedra) {
        if sound(tet) {
            *new = Some(kept);
            kept += 1;
        }
    }
    let renamed = |old: Option<u32>| old.and_then(|t| new_of[t as usize]);
    let keep = |t: usize| new_of[t].is_some();
    let of = |t: usize| fan.neighbours[t].map(renamed);
    let neighbours: Vec<_> = (0..fan.tetrahedra.len()).filter(|&t| keep(t)).map(of).collect();
    let tetrahedra: Vec<_> =
        (0..fan.tetrahedra.len()).filter(|&t| keep(t)).map(|t| fan.tetrahedra[t]).collect();
    for face in &mut fan.boundary {
        face.tetrahedra = face.tetrahedra.map(renamed);
    }
    Tetrahedra { neighbours, tetrahedra, ..fan }
}
