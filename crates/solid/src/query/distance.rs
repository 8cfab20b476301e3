//! How far a point is from the surface.

use super::Solid;
use crate::Point3;
use crate::bvh::Aabb;

/// The point of a triangle that is nearest to `p`, to rounding (Ericson 2005, 5.1.5); a flat triangle
/// counts as its sides.
pub fn closest_on_triangle(p: &Point3, [a, b, c]: [&Point3; 3]) -> Point3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = va + vb + vc;
    if whole <= 0.0 {
        return *a;
    }
    a + ab * (vb / whole) + ac * (vc / whole)
}

/// Distance from a point to a triangle, metres, to rounding.
pub fn distance_to_triangle(p: &Point3, triangle: [&Point3; 3]) -> f64 {
    (p - closest_on_triangle(p, triangle)).norm()
}

impl Solid<'_> {
    /// Distance from a point to the nearest face, metres, to rounding; infinite without faces.
    ///
    /// Looks into boxes around the point that double until a face is found: near points are cheap.
    pub fn distance_m(&self, point: &Point3) -> f64 {
        let Some((low, high)) = self.bounds else { return f64::INFINITY };
        let size = (high - low).norm();
        let outside = (0..3).map(|i| (low[i] - point[i]).max(point[i] - high[i]).max(0.0));
        let mut reach = outside.fold(0.0, f64::max) + size * 1e-3;
        loop {
            let mut nearest = f64::INFINITY;
            self.faces.each_touching(&Aabb::around([point]).grown(reach), |face| {
                nearest =
                    nearest.min(distance_to_triangle(point, self.mesh.corners(face as usize)));
            });
            // Whatever is outside of the box is farther than its reach.
            if nearest <= reach || reach > 4.0 * (size + (point - low).norm()) {
                return nearest;
            }
            reach *= 2.0;
        }
    }
}
