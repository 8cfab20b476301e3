//! Step 1: error quadrics.

use crate::{Point3, Vector3};

/// Area-weighted sum of squared distances to planes, as a function of a point; relative to a fixed
/// origin, so that little cancels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    /// xx xy xz yy yz zz.
    a: [f64; 6],
    b: Vector3,
    c: f64,
}

impl Quadric {
    /// Of the plane through a triangle, weighted by its area.
    pub(super) fn of(corners: [&Point3; 3], origin: &Point3) -> Self {
        let [p, q, r] = corners.map(|corner| corner - origin);
        let scaled = (q - p).cross(&(r - p));
        let Some(n) = scaled.try_normalize(0.0) else { return Self::default() };
        let (area, d) = (0.5 * scaled.norm(), -n.dot(&p));
        let a = [n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z];
        Self { a: a.map(|x| x * area), b: n * (d * area), c: d * d * area }
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.a.iter_mut().zip(other.a) {
            *mine += theirs;
        }
        self.b += other.b;
        self.c += other.c;
    }

    pub(super) fn at(&self, point: &Point3, origin: &Point3) -> f64 {
        let p = point - origin;
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let square = xx * p.x * p.x
            + yy * p.y * p.y
            + zz * p.z * p.z
            + 2.0 * (xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z);
        (square + 2.0 * self.b.dot(&p) + self.c).max(0.0)
    }
}
