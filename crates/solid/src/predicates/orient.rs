//! On which side of a plane, or of a projected line, a point lies.

use robust::{Coord, Coord3D};

use crate::Point3;

/// The largest magnitude of a coordinate for which the predicates are exact.
pub const LARGEST: f64 = 1e50;
/// The smallest magnitude, zero apart, of a coordinate for which the predicates are exact: below
/// the smallest number that a 32-bit float can hold.
pub const SMALLEST: f64 = 1e-45;

/// Whether all coordinates lie where the predicates are exact; false for NaN and infinities.
#[inline]
pub fn in_envelope(p: &Point3) -> bool {
    p.iter().all(|c| *c == 0.0 || (SMALLEST..=LARGEST).contains(&c.abs()))
}

/// The sign of a predicate: -1, 0 or 1.
#[inline]
pub fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// Six times the signed volume of the tetrahedron `a`, `b`, `c`, `d`: positive when `d` lies on the
/// side from which `a`, `b`, `c` run counter-clockwise.
///
/// The sign is exact inside the envelope; the value is an estimate. Some 20 ns unless the points are
/// nearly coplanar.
#[inline]
pub fn orient3(a: &Point3, b: &Point3, c: &Point3, d: &Point3) -> f64 {
    let coord = |p: &Point3| Coord3D { x: p.x, y: p.y, z: p.z };
    -robust::orient3d(coord(a), coord(b), coord(c), coord(d))
}

/// Twice the signed area of `a`, `b`, `c` projected along axis `axis` (0, 1, 2), which is that
/// component of the normal `(b - a) x (c - a)`; the sign is exact inside the envelope.
#[inline]
pub fn orient_dropping(axis: usize, a: &Point3, b: &Point3, c: &Point3) -> f64 {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let coord = |p: &Point3| Coord { x: p[u], y: p[v] };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// An axis along which the triangle does not project to a line, or `None` when the three points are
/// exactly collinear. The axis is the one of the largest component of the normal, as far as floats
/// tell.
#[inline]
pub fn facing_axis(a: &Point3, b: &Point3, c: &Point3) -> Option<usize> {
    let normal = (b - a).cross(&(c - a));
    let first = normal.iamax();
    (0..3).map(|step| (first + step) % 3).find(|&axis| orient_dropping(axis, a, b, c) != 0.0)
}

/// Whether three points lie exactly on one line.
#[inline]
pub fn is_collinear(a: &Point3, b: &Point3, c: &Point3) -> bool {
    facing_axis(a, b, c).is_none()
}
