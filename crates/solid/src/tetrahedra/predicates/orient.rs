//! On which side of a plane, filtered.

use robust::Coord3D;

use super::P3;

/// What the floating determinant of three differences may be off, relative to the product of the
/// largest differences of each axis: Shewchuk's bound of stage A, with every term at its largest.
const ORIENT_BOUND: f64 = 5.2e-15;
/// Below this, products may have underflown, and the bound says nothing.
const TINY: f64 = 1e-250;

#[inline]
pub(crate) fn coord(p: &P3) -> Coord3D<f64> {
    Coord3D { x: p[0], y: p[1], z: p[2] }
}

#[inline]
pub(crate) fn max3(a: f64, b: f64, c: f64) -> f64 {
    let (a, b, c) = (a.abs(), b.abs(), c.abs());
    let ab = if a > b { a } else { b };
    if ab > c { ab } else { c }
}

/// Positive when `d` lies on the side from which `a`, `b`, `c` run counter-clockwise; the sign is
/// exact, and zero means coplanar.
#[inline]
pub(crate) fn orient(a: &P3, b: &P3, c: &P3, d: &P3) -> f64 {
    let (ax, ay, az) = (a[0] - d[0], a[1] - d[1], a[2] - d[2]);
    let (bx, by, bz) = (b[0] - d[0], b[1] - d[1], b[2] - d[2]);
    let (cx, cy, cz) = (c[0] - d[0], c[1] - d[1], c[2] - d[2]);
    let det = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    let (mx, my, mz) = (max3(ax, bx, cx), max3(ay, by, cy), max3(az, bz, cz));
    let bound = ORIENT_BOUND * mx * my * mz;
    if (det > bound || det < -bound) && bound > TINY {
        return -det;
    }
    if mx == 0.0 || my == 0.0 || mz == 0.0 {
        return 0.0;
    }
    exact(a, b, c, d)
}

#[cold]
#[inline(never)]
fn exact(a: &P3, b: &P3, c: &P3, d: &P3) -> f64 {
    -robust::orient3d(coord(a), coord(b), coord(c), coord(d))
}
