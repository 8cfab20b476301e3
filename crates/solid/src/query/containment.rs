//! Whether a point lies inside.

use std::f64::consts::PI;

use super::Solid;
use super::ray::Passage;
use crate::bvh::Aabb;
use crate::predicates::{in_triangle, is_collinear, on_segment};
use crate::{Point3, Vector3};

/// How many segments are tried before the solid angle decides.
const TRIES: u32 = 32;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Inside the surface.
    Inside,
    /// On a face, exactly.
    Boundary,
    /// Outside of it.
    Outside,
}

impl Solid<'_> {
    /// Where a point lies; exact for a closed mesh. Overlapping sheets count by parity.
    pub fn side(&self, point: &Point3) -> Side {
        let Some((low, high)) = self.bounds else { return Side::Outside };
        if !Aabb::around([&low, &high]).touches(&Aabb::around([point])) {
            return Side::Outside;
        }
        if self.is_on_surface(point) {
            return Side::Boundary;
        }
        let reach = (high - low).norm() * 2.0 + 1.0;
        let odd = (0..TRIES).find_map(|attempt| self.crosses_odd(point, attempt, reach));
        let inside = odd.unwrap_or_else(|| self.solid_angle(point).abs() > 2.0 * PI);
        if inside { Side::Inside } else { Side::Outside }
    }

    /// Whether a point lies exactly on a face.
    pub fn is_on_surface(&self, point: &Point3) -> bool {
        let mut on = false;
        self.faces.each_touching(&Aabb::around([point]), |face| {
            on = on || {
                let [a, b, c] = self.mesh.corners(face as usize);
                if is_collinear(a, b, c) {
                    [(a, b), (b, c), (c, a)].iter().any(|(s, t)| on_segment(point, s, t))
                } else {
                    in_triangle(point, [a, b, c])
                }
            };
        });
        on
    }

    /// Whether a segment to the outside crosses the surface an odd number of times; `None` where it
    /// meets an edge or a corner.
    fn crosses_odd(&self, point: &Point3, attempt: u32, reach_m: f64) -> Option<bool> {
        let to = point + direction(attempt) * reach_m;
        let (mut odd, mut clean) = (false, true);
        self.faces.each_on_segment(point, &to, |face| match self.passage(face, point, &to) {
            Passage::Through { .. } => odd = !odd,
            Passage::Grazes { .. } | Passage::Along => clean = false,
            Passage::Misses => {}
        });
        clean.then_some(odd)
    }

    /// The solid angle under which the surface is seen, `4 pi` from inside (van Oosterom and
    /// Strackee 1983).
    fn solid_angle(&self, point: &Point3) -> f64 {
        let angle = |face: usize| {
            let [a, b, c] = self.mesh.corners(face).map(|corner| corner - point);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            2.0 * a.dot(&b.cross(&c)).atan2(below)
        };
        (0..self.mesh.faces().len()).map(angle).sum()
    }
}

/// Directions all over the sphere, one for each attempt, none along an axis or a diagonal.
fn direction(attempt: u32) -> Vector3 {
    let golden = PI * (5.0_f64.sqrt() - 1.0);
    let z = 1.0 - 2.0 * (f64::from(attempt * 13 % TRIES) + 0.317_831) / f64::from(TRIES);
    let turn = golden * f64::from(attempt) + 0.734_192;
    let ring = (1.0 - z * z).sqrt();
    Vector3::new(ring * turn.cos(), ring * turn.sin(), z)
}
