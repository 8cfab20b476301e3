//! How much a vertex contributes to the shape, in metres.

use nalgebra::{Matrix3, Vector3};

use crate::tolerance::{EIGENVALUE_SLOPE, EIGENVALUE_STEP, LINE_SHARE};

/// How the contribution of a vertex inside of the image is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Contribution {
    /// The distance to the centroid of the neighbours (\[Mos15\] 3.5.2; its eq. 3.1 lacks 1/k).
    #[default]
    Centroid,
    /// The distance to the plane that is nearest to the neighbours, measured along its normal.
    LeastSquares,
    /// The difference in z to the plane `z = a x + b y + d` nearest to the neighbours in z
    /// (\[Mos15\] 3.5.3): blind to planes along the viewing axis, where any d fits.
    LeastSquaresVertical,
}

type Point = Vector3<f64>;

/// The contribution of a vertex with these neighbours, at least three, metres.
#[inline]
pub(super) fn contribution(kind: Contribution, point: [f32; 3], neighbours: &[[f32; 3]]) -> f64 {
    let share = 1.0 / neighbours.len() as f64;
    let from_point = |neighbour: &[f32; 3]| {
        [0, 1, 2].map(|axis| f64::from(neighbour[axis]) - f64::from(point[axis]))
    };
    let [mut x, mut y, mut z] = [0.0; 3];
    if kind == Contribution::Centroid {
        for neighbour in neighbours {
            let [dx, dy, dz] = from_point(neighbour);
            (x, y, z) = (x + dx, y + dy, z + dz);
        }
        return (x * x + y * y + z * z).sqrt() * share;
    }
    let [mut xx, mut xy, mut xz, mut yy, mut yz, mut zz] = [0.0; 6];
    for neighbour in neighbours {
        let [dx, dy, dz] = from_point(neighbour);
        (x, y, z) = (x + dx, y + dy, z + dz);
        (xx, xy, xz) = (xx + dx * dx, xy + dx * dy, xz + dx * dz);
        (yy, yz, zz) = (yy + dy * dy, yz + dy * dz, zz + dz * dz);
    }
    // About the middle of the neighbours, seen from which the point is at the opposite.
    let off = Point::new(-x * share, -y * share, -z * share);
    (xx, xy, xz) = (xx + x * off.x, xy + x * off.y, xz + x * off.z);
    (yy, yz, zz) = (yy + y * off.y, yz + y * off.z, zz + z * off.z);
    if kind == Contribution::LeastSquaresVertical {
        let det = xx * yy - xy * xy;
        // Neighbours above one line fix no slope; the plane through their middle is level.
        if det <= LINE_SHARE * (xx + yy) * (xx + yy) {
            return off.z.abs();
        }
        let a = (xz * yy - yz * xy) / det;
        let b = (yz * xx - xz * xy) / det;
        return (off.z - a * off.x - b * off.y).abs();
    }
    off_plane(&Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz), &off)
}

/// How far `off` leads along the eigenvector of the smallest eigenvalue of a symmetric matrix without
/// negative ones; 0 where every direction is as good.
///
/// Newton's method from 0 runs up to the smallest root of the characteristic polynomial and never
/// beyond it. The adjugate of what is left is `n n'` times a number, `n` being the eigenvector, so `n`
/// itself need not be found.
fn off_plane(m: &Matrix3<f64>, off: &Point) -> f64 {
    let scale = m.trace();
    if scale.is_nan() || scale <= 0.0 {
        return 0.0;
    }
    let m = m / scale;
    // l^3 - l^2 + p l - q, as the trace is 1.
    let p = m[(0, 0)] * m[(1, 1)] + m[(0, 0)] * m[(2, 2)] + m[(1, 1)] * m[(2, 2)]
        - m[(0, 1)] * m[(0, 1)]
        - m[(0, 2)] * m[(0, 2)]
        - m[(1, 2)] * m[(1, 2)];
    let q = m.determinant();
    let mut l = 0.0;
    for _ in 0..12 {
        let value = ((l - 1.0) * l + p) * l - q;
        let slope = (3.0 * l - 2.0) * l + p;
        if slope <= EIGENVALUE_SLOPE {
            break;
        }
        let step = value / slope;
        l -= step;
        if step.abs() < EIGENVALUE_STEP {
            break;
        }
    }
    let [xx, yy, zz] = [0, 1, 2].map(|i| m[(i, i)] - l);
    let [xy, xz, yz] = [m[(0, 1)], m[(0, 2)], m[(1, 2)]];
    let [axx, ayy, azz] = [yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy];
    let size = axx + ayy + azz;
    if size > LINE_SHARE {
        let [axy, axz, ayz] = [xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz];
        let along = (axx * off.x + 2.0 * (axy * off.y + axz * off.z)) * off.x
            + (ayy * off.y + 2.0 * ayz * off.z) * off.y
            + azz * off.z * off.z;
        return (along.max(0.0) / size).sqrt();
    }
    // Two eigenvalues meet: neighbours on one line, or spread evenly. Any perpendicular will do.
    let rows = [Point::new(xx, xy, xz), Point::new(xy, yy, yz), Point::new(xz, yz, zz)];
    let longest = |a: &Point, b: &Point| a.norm_squared().total_cmp(&b.norm_squared());
    let Some(row) = rows.into_iter().max_by(longest) else { return 0.0 };
    let axis = if row.x.abs() <= row.y.abs().min(row.z.abs()) { Point::x() } else { Point::y() };
    let axis = if row.norm() > LINE_SHARE { row.cross(&axis) } else { axis };
    axis.try_normalize(0.0).map_or(0.0, |normal| normal.dot(off).abs())
}

/// The relevance of the middle one of three points of a line (\[Mos15\] eq. 3.7, after Latecki and
/// Lakämper): turn angle times the product of both lengths over their sum, metres times radians.
pub(super) fn relevance(before: &Point, point: &Point, after: &Point) -> f64 {
    let (one, two) = (point - before, after - point);
    let (a, b) = (one.norm(), two.norm());
    let turn = one.cross(&two).norm().atan2(one.dot(&two));
    if a + b > 0.0 { turn * a * b / (a + b) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(x: f64, y: f64, z: f64) -> Point {
        Point::new(x, y, z)
    }

    #[test]
    fn a_plane_along_the_viewing_axis_is_seen_by_the_normal_alone() {
        // Neighbours on x = 1, the point 0.1 beside it.
        let ring = [[1.0, 0.0, 2.0], [1.0, 1.0, 2.5], [1.0, 1.0, 3.5], [1.0, 0.0, 4.0]];
        let point = [1.1, 0.5, 3.0];
        let normal = contribution(Contribution::LeastSquares, point, &ring);
        assert!((normal - 0.1).abs() < 1e-7, "{normal}");
        let vertical = contribution(Contribution::LeastSquaresVertical, point, &ring);
        assert!(vertical < 1e-7, "{vertical}");
        let centroid = contribution(Contribution::Centroid, point, &ring);
        assert!((centroid - 0.1).abs() < 1e-7, "{centroid}");
    }

    #[test]
    fn relevance_is_that_of_the_formula() {
        let [a, b, c] = [at(0.0, 0.0, 1.0), at(2.0, 0.0, 1.0), at(2.0, 3.0, 1.0)];
        let right = std::f64::consts::FRAC_PI_2 * 6.0 / 5.0;
        assert!((relevance(&a, &b, &c) - right).abs() < 1e-12);
        assert_eq!(relevance(&a, &at(1.0, 0.0, 1.0), &b), 0.0);
        assert_eq!(relevance(&a, &a, &a), 0.0);
    }

    proptest! {
        #[test]
        fn the_distance_is_that_along_an_eigenvector(
            points in prop::collection::vec((-2.0..2.0, -2.0..2.0, 0.5..8.0), 3..9),
            point in (-2.0..2.0, -2.0..2.0, 0.5..8.0),
        ) {
            let short = |(x, y, z): (f64, f64, f64)| [x as f32, y as f32, z as f32];
            let points: Vec<[f32; 3]> = points.into_iter().map(short).collect();
            let point = short(point);
            let exact: Vec<Point> =
                points.iter().map(|p| Point::from(p.map(f64::from))).collect();
            let middle = exact.iter().sum::<Point>() / points.len() as f64;
            let spread: Matrix3<f64> =
                exact.iter().map(|p| (p - middle) * (p - middle).transpose()).sum();
            let eigen = spread.symmetric_eigen();
            let least = eigen.eigenvalues.imin();
            let off = Point::from(point.map(f64::from)) - middle;
            let expected = eigen.eigenvectors.column(least).dot(&off).abs();
            let found = contribution(Contribution::LeastSquares, point, &points);
            // Where the two smallest nearly meet, the direction is not determined.
            let mut sorted: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
            sorted.sort_by(f64::total_cmp);
            prop_assume!(sorted[1] - sorted[0] > 1e-4 * spread.trace());
            prop_assert!((found - expected).abs() <= 1e-6 * (1.0 + expected), "{found} {expected}");
            let centroid = contribution(Contribution::Centroid, point, &points);
            prop_assert!((centroid - off.norm()).abs() <= 1e-9 * (1.0 + centroid));
        }
    }
}
