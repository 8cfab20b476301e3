//! A start for a mesh that names none.

use geometry::rays::MeshCaster;
use geometry::{Point3, Vector3};

/// Points of the lattice along each axis.
const LATTICE: usize = 24;

/// The point of a lattice over the bounds that is farthest from all triangles, of those from which rays
/// to all 26 sides of a cube meet something; the first of equals.
pub(super) fn open_place(caster: &MeshCaster, (low, high): (Point3, Point3)) -> Option<Point3> {
    let step = (high - low) / LATTICE as f64;
    let mut best: Option<(f64, Point3)> = None;
    for i in 0..LATTICE * LATTICE * LATTICE {
        let [x, y, z] = [i % LATTICE, i / LATTICE % LATTICE, i / LATTICE / LATTICE];
        let share = Vector3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5);
        let at = low + step.component_mul(&share);
        let open_m = caster.distance_to(&at);
        if best.is_none_or(|(best_m, _)| open_m > best_m) && is_closed_in(caster, &at) {
            best = Some((open_m, at));
        }
    }
    best.filter(|(open_m, _)| *open_m > 0.0).map(|(_, at)| at)
}

fn is_closed_in(caster: &MeshCaster, at: &Point3) -> bool {
    (0..27).filter(|side| *side != 13).all(|side| {
        let [x, y, z] = [side % 3, side / 3 % 3, side / 9].map(|s| f64::from(s) - 1.0);
        caster.cast(at, &Vector3::new(x, y, z).normalize(), f64::MAX).is_some()
    })
}
