//! How much a vertex contributes to the shape, in metres.

use nalgebra::{Matrix3, Vector3};

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
pub(super) fn contribution(kind: Contribution, point: &Point, neighbours: &[Point]) -> f64 {
    let share = 1.0 / neighbours.len() as f64;
    let middle = neighbours.iter().sum::<Point>() * share;
    let off = point - middle;
    if kind == Contribution::Centroid {
        return off.norm();
    }
    let [mut xx, mut xy, mut xz, mut yy, mut yz, mut zz] = [0.0; 6];
    for neighbour in neighbours {
        let d = neighbour - middle;
        xx += d.x * d.x;
        xy += d.x * d.y;
        xz += d.x * d.z;
        yy += d.y * d.y;
        yz += d.y * d.z;
        zz += d.z * d.z;
    }
    if kind == Contribution::LeastSquaresVertical {
        let det = xx * yy - xy * xy;
        // Neighbours above one line fix no slope; the plane through their middle is level.
        if det <= 1e-12 * (xx + yy) * (xx + yy) {
            return off.z.abs();
        }
        let a = (xz * yy - yz * xy) / det;
        let b = (yz * xx - xz * xy) / det;
        return (off.z - a * off.x - b * off.y).abs();
    }
    let spread = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    smallest_direction(&spread).map_or(0.0, |normal| normal.dot(&off).abs())
}

/// The unit eigenvector of the smallest eigenvalue of a symmetric matrix without negative ones.
///
/// Newton's method from 0 runs up to the smallest root of the characteristic polynomial and never
/// beyond it. The eigenvector is perpendicular to the rows of what is left. `None` where every
/// direction is as good.
fn smallest_direction(m: &Matrix3<f64>) -> Option<Point> {
    let scale = m.trace();
    if scale.is_nan() || scale <= 0.0 {
        return None;
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
        if slope <= 1e-14 {
            break;
        }
        let step = value / slope;
        l -= step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    let rows = [0, 1, 2].map(|i| {
        let mut row: Point = m.row(i).transpose();
        row[i] -= l;
        row
    });
    let candidates = [rows[0].cross(&rows[1]), rows[1].cross(&rows[2]), rows[2].cross(&rows[0])];
    let longest =
        candidates.into_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    let length = longest.norm();
    if length > 1e-12 {
        return Some(longest / length);
    }
    // Two eigenvalues meet: neighbours on one line, or spread evenly. Any perpendicular will do.
    let row = rows.into_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    let axis = if row.x.abs() <= row.y.abs().min(row.z.abs()) { Point::x() } else { Point::y() };
    let axis = if row.norm() > 1e-12 { row.cross(&axis) } else { axis };
    let length = axis.norm();
    (length > 0.0).then(|| axis / length)
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
        let ring = [at(1.0, 0.0, 2.0), at(1.0, 1.0, 2.5), at(1.0, 1.0, 3.5), at(1.0, 0.0, 4.0)];
        let point = at(1.1, 0.5, 3.0);
        let normal = contribution(Contribution::LeastSquares, &point, &ring);
        assert!((normal - 0.1).abs() < 1e-9, "{normal}");
        let vertical = contribution(Contribution::LeastSquaresVertical, &point, &ring);
        assert!(vertical < 1e-9, "{vertical}");
        let centroid = contribution(Contribution::Centroid, &point, &ring);
        assert!((centroid - 0.1).abs() < 1e-9, "{centroid}");
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
        fn the_normal_is_that_of_the_eigenvectors(
            points in prop::collection::vec((-2.0..2.0, -2.0..2.0, 0.5..8.0_f64), 3..9),
        ) {
            let points: Vec<Point> = points.into_iter().map(|(x, y, z)| at(x, y, z)).collect();
            let middle = points.iter().sum::<Point>() / points.len() as f64;
            let spread: Matrix3<f64> =
                points.iter().map(|p| (p - middle) * (p - middle).transpose()).sum();
            let normal = smallest_direction(&spread).expect("spread");
            let least = spread.symmetric_eigenvalues().min();
            let along = (normal.transpose() * spread * normal)[(0, 0)];
            prop_assert!((along - least).abs() <= 1e-9 * spread.trace(), "{along} {least}");
        }
    }
}
