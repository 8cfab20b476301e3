//! What a camera could see from the places that a robot reaches.

use geometry::Point3;
use worlds::{CameraParams, World3d};

use super::lattice::Lattice;

/// Steps to a place from which a voxel may be seen.
type Offset = [i64; 3];

/// Every place is tried up to this distance, every second one along each axis up to twice as far, every
/// fourth beyond; metres.
const ALL_WITHIN_M: f64 = 1.5;

/// Which of the `free` voxels can be seen from the centre of a `reached` one. Cost: a few rays for each
/// voxel that can; some thousands for each that cannot.
pub(super) fn visible(
    world: &World3d,
    lattice: &Lattice,
    camera: &CameraParams,
    reached: &[bool],
    free: &[bool],
) -> Vec<bool> {
    let offsets = offsets(lattice, camera);
    let mut seen = vec![false; lattice.len()];
    for at in (0..lattice.len()).filter(|&at| free[at]) {
        let (steps, centre) = (lattice.steps(at), lattice.centre(at));
        seen[at] = offsets.iter().any(|offset| {
            let from = lattice.index([0, 1, 2].map(|k| steps[k] + offset[k]));
            let from = from.filter(|&from| reached[from]);
            from.is_some_and(|from| !world.caster().blocked(&lattice.centre(from), &centre))
        });
    }
    seen
}

/// Steps from a voxel to the places from which the camera has it in view at some yaw, the nearest first.
fn offsets(lattice: &Lattice, params: &CameraParams) -> Vec<Offset> {
    let camera = params.camera();
    let body_from_camera = params.body_from_camera();
    let reach_m = params.far_m / (0.5 * params.fov_down_rad).cos();
    let reach = (reach_m / lattice.cell_m).ceil() as i64;
    let mut offsets: Vec<(f64, Offset)> = Vec::new();
    for x in -reach..=reach {
        for y in -reach..=reach {
            for z in -reach..=reach {
                let [dx, dy, dz] = [x, y, z].map(|step| step as f64 * lattice.cell_m);
                let distance_m = (dx * dx + dy * dy + dz * dz).sqrt();
                let grain = match distance_m / ALL_WITHIN_M {
                    share if share <= 1.0 => 1,
                    share if share <= 2.0 => 2,
                    _ => 4,
                };
                if [x, y, z].iter().any(|step| step % grain != 0) {
                    continue;
                }
                // Turned towards it, the voxel lies straight ahead, above or below.
                let ahead = Point3::new(dx.hypot(dy), 0.0, -dz);
                let in_camera = body_from_camera.inverse_transform(&ahead);
                let row = camera.pixel_of(&in_camera).map(|[_, row]| row);
                let rows = params.rows as f64 - 1.0;
                if in_camera.z <= params.far_m && row.is_some_and(|r| (0.0..=rows).contains(&r)) {
                    offsets.push((distance_m, [x, y, z]));
                }
            }
        }
    }
    offsets.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    offsets.into_iter().map(|(_, offset)| offset).collect()
}
