//! Step 4: borders between labels.

use super::star::Mesh;
use crate::Point3;

/// Neighbours across edges that part two labels, ascending.
fn border_neighbours(mesh: &Mesh, vertex: u32) -> Vec<u32> {
    let faces = &mesh.at[vertex as usize];
    let first = mesh.labels[faces[0] as usize];
    if faces.iter().all(|&face| mesh.labels[face as usize] == first) {
        return Vec::new();
    }
    let parts = |other: &u32| {
        let beside = faces.iter().filter(|&&face| mesh.faces[face as usize].contains(other));
        let mut labels = beside.map(|&face| mesh.labels[face as usize]);
        let first = labels.next();
        labels.any(|label| Some(label) != first)
    };
    mesh.neighbours(vertex).into_iter().filter(parts).collect()
}

fn distance_to_segment(p: &Point3, a: &Point3, b: &Point3) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 { ((p - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + along * share)).norm()
}

/// How far the border moves when `from` is drawn into `to`, metres: 0 inside a region; `None` where
/// labels forbid it.
pub(super) fn shift_m(mesh: &Mesh, from: u32, to: u32) -> Option<f64> {
    match border_neighbours(mesh, from)[..] {
        [] => Some(0.0),
        [a, b] if a == to || b == to => {
            let other = if a == to { b } else { a };
            // The face between them is all that its region has here: it would vanish or be cut.
            let closes = mesh.faces_at_edge(from, to).any(|face| face.contains(&other));
            if closes && border_neighbours(mesh, to).contains(&other) {
                return None;
            }
            let [p, q, r] = [from, to, other].map(|vertex| &mesh.vertices[vertex as usize]);
            Some(distance_to_segment(p, q, r))
        }
        _ => None,
    }
}
