//! Inside or outside a sphere, never on it.

use super::orient::{coord, max3};
use super::{P3, orient};

/// As for the orientation: Shewchuk's bound of stage A with every term at its largest.
const SPHERE_BOUND: f64 = 1.3e-13;
/// Below this, products may have underflown.
const TINY: f64 = 1e-250;

/// Whether `e` lies inside the sphere through `a`, `b`, `c`, `d`, which must be positively oriented.
/// The second of each pair is the rank of the point.
///
/// Points on the sphere are decided as if each point were lifted off the paraboloid by a number
/// that is vanishingly small beside that of every point of higher rank: the tetrahedra are those of
/// a weighted triangulation with generic weights, so that none is flat and the answers never
/// contradict one another (\[EM90\], with the lifting coordinate alone perturbed, as \[Lev16\]).
#[inline]
pub(crate) fn in_sphere(
    a: (&P3, u32),
    b: (&P3, u32),
    c: (&P3, u32),
    d: (&P3, u32),
    e: (&P3, u32),
) -> bool {
    let value = in_sphere_sign(a.0, b.0, c.0, d.0, e.0);
    if value != 0.0 {
        return value > 0.0;
    }
    tie(a, b, c, d, e)
}

/// Positive when `e` lies inside the sphere through the positively oriented `a`, `b`, `c`, `d`; the
/// sign is exact, and zero means on it.
#[inline]
fn in_sphere_sign(a: &P3, b: &P3, c: &P3, d: &P3, e: &P3) -> f64 {
    let (ax, ay, az) = (a[0] - e[0], a[1] - e[1], a[2] - e[2]);
    let (bx, by, bz) = (b[0] - e[0], b[1] - e[1], b[2] - e[2]);
    let (cx, cy, cz) = (c[0] - e[0], c[1] - e[1], c[2] - e[2]);
    let (dx, dy, dz) = (d[0] - e[0], d[1] - e[1], d[2] - e[2]);
    let ab = ax * by - bx * ay;
    let bc = bx * cy - cx * by;
    let cd = cx * dy - dx * cy;
    let da = dx * ay - ax * dy;
    let ac = ax * cy - cx * ay;
    let bd = bx * dy - dx * by;
    let abc = az * bc - bz * ac + cz * ab;
    let bcd = bz * cd - cz * bd + dz * bc;
    let cda = cz * da + dz * ac + az * cd;
    let dab = dz * ab + az * bd + bz * da;
    let lift_a = ax * ax + ay * ay + az * az;
    let lift_b = bx * bx + by * by + bz * bz;
    let lift_c = cx * cx + cy * cy + cz * cz;
    let lift_d = dx * dx + dy * dy + dz * dz;
    let det = (lift_d * abc - lift_c * dab) + (lift_b * cda - lift_a * bcd);
    let pair = |p: f64, q: f64| if p > q { p } else { q };
    let mx = pair(max3(ax, bx, cx), dx.abs());
    let my = pair(max3(ay, by, cy), dy.abs());
    let mz = pair(max3(az, bz, cz), dz.abs());
    let most = max3(mx, my, mz);
    let bound = SPHERE_BOUND * mx * my * mz * most * most;
    if (det > bound || det < -bound) && bound > TINY {
        return -det;
    }
    exact(a, b, c, d, e)
}

#[cold]
#[inline(never)]
fn exact(a: &P3, b: &P3, c: &P3, d: &P3, e: &P3) -> f64 {
    -robust::insphere(coord(a), coord(b), coord(c), coord(d), coord(e))
}

/// The sign of the coefficient of the first lift, in order of rank, that has one.
#[cold]
#[inline(never)]
fn tie(a: (&P3, u32), b: (&P3, u32), c: (&P3, u32), d: (&P3, u32), e: (&P3, u32)) -> bool {
    let points = [a, b, c, d, e];
    let mut ranked = [0usize, 1, 2, 3, 4];
    ranked.sort_unstable_by_key(|&i| points[i].1);
    for i in ranked {
        if i == 4 {
            // Lifting the asked point takes it out of the sphere, for the four are not coplanar.
            return false;
        }
        let mut four = [a.0, b.0, c.0, d.0];
        four[i] = e.0;
        let value = orient(four[0], four[1], four[2], four[3]);
        if value != 0.0 {
            return value > 0.0;
        }
    }
    false
}
