//! What is inside and what is open, found another way.

use maps3d::relative::{OpenPart, STEPS};
use nalgebra::Point3;
use solid::Polyhedron;

/// How deep a point lies in the fan of tetrahedra of a view, metres: in the one where it lies deepest, its
/// least distance from the four planes. Negative outside; near 0 also between two tetrahedra.
pub fn depth_in_fan(view: &Polyhedron, surface: usize, point: &Point3<f64>) -> f64 {
    let mut deepest_m = f64::NEG_INFINITY;
    for face in 0..surface {
        let [a, b, c] = view.corners(face).map(|p| p.coords);
        let apex = nalgebra::Vector3::zeros();
        let mut least_m = f64::INFINITY;
        for (p, q, r, inner) in [(a, b, c, apex), (a, b, apex, c), (b, c, apex, a), (c, a, apex, b)]
        {
            let normal = (q - p).cross(&(r - p));
            let normal = normal / normal.norm();
            let inner_m = normal.dot(&(inner - p));
            least_m = least_m.min(normal.dot(&(point.coords - p)) * inner_m.signum());
        }
        deepest_m = deepest_m.max(least_m);
    }
    deepest_m
}

/// Whether a place of a face is open, by crossings of a ray; `None` nearer than so many steps to where that
/// changes.
pub fn is_open(open: &OpenPart, [x, y]: [f64; 2], near: f64) -> Option<bool> {
    let rings = open.rings();
    let mut odd = false;
    for ring in rings.rings() {
        let mut a = ring[ring.len() - 1].map(f64::from);
        for b in ring {
            let b = b.map(f64::from);
            let way = [b[0] - a[0], b[1] - a[1]];
            let squared = way[0] * way[0] + way[1] * way[1];
            let along = ((x - a[0]) * way[0] + (y - a[1]) * way[1]) / squared;
            let along = along.clamp(0.0, 1.0);
            let off = [a[0] + along * way[0] - x, a[1] + along * way[1] - y];
            if off[0].hypot(off[1]) < near {
                return None;
            }
            if (a[1] > y) != (b[1] > y) && x < a[0] + way[0] * (y - a[1]) / way[1] {
                odd = !odd;
            }
            a = b;
        }
    }
    Some(odd)
}

/// A random place of a face, on its grid.
pub fn place(numbers: &mut super::scene::Numbers) -> [f64; 2] {
    let (mut s, mut t) = (numbers.next(), numbers.next());
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    [s, t].map(|share| share * f64::from(STEPS))
}
