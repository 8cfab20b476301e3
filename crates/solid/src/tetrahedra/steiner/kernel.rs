//! The point that lies deepest behind some planes.

use crate::tetrahedra::predicates::P3;

/// More pivots than this are not made.
const MOST_PIVOTS: usize = 300;

/// A half space: `normal`, of length 1, points into it; `offset` is the depth of the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub(super) normal: P3,
    pub(super) offset: f64,
}

impl HalfSpace {
    /// The side of the triangle from which its corners run counter-clockwise, seen from `origin`;
    /// `None` where the triangle has no area in doubles.
    pub(super) fn of(a: &P3, b: &P3, c: &P3, origin: &P3) -> Option<Self> {
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        if length < 1e-200 {
            return None;
        }
        let normal = n.map(|x| x / length);
        Some(Self { normal, offset: (0..3).map(|k| normal[k] * (origin[k] - a[k])).sum() })
    }
}

/// The point, relative to the origin and not much farther from it than `reach`, whose least depth
/// behind all planes is largest, that depth, and the four planes that bound it, the weightiest first;
/// numbers from `spaces.len()` on stand for the reach. Floats: callers check exactly what they need.
///
/// The linear programme is solved by the dual simplex method: four planes bound the depth, and of those
/// violated most the next one takes the place of one of them.
pub(super) fn deepest(spaces: &[HalfSpace], reach: f64) -> (P3, f64, [usize; 4]) {
    let s = 1.0 / 3.0f64.sqrt();
    let far = [[s, s, s], [s, -s, -s], [-s, s, -s], [-s, -s, s]];
    let n = spaces.len();
    let row = |i: usize| -> [f64; 5] {
        let (normal, offset) =
            if i < n { (spaces[i].normal, spaces[i].offset) } else { (far[i - n], reach) };
        // n . x - r = -offset
        [normal[0], normal[1], normal[2], -1.0, -offset]
    };
    let mut basis = [n, n + 1, n + 2, n + 3];
    let mut weight = [0.25; 4];
    let (mut x, mut depth) = ([0.0; 3], 0.0);
    for _ in 0..MOST_PIVOTS {
        let Some(found) = solve(basis.map(row)) else { break };
        x = [found[0], found[1], found[2]];
        depth = found[3];
        let gap = |i: usize| {
            let [a, b, c, _, minus] = row(i);
            a * x[0] + b * x[1] + c * x[2] - minus - depth
        };
        let Some((worst, least)) = (0..n).map(|i| (i, gap(i))).min_by(|p, q| p.1.total_cmp(&q.1))
        else {
            break;
        };
        if least >= -1e-13 * (reach + depth.abs()) || basis.contains(&worst) {
            break;
        }
        // The entering row as a sum of those of the basis.
        let rows = basis.map(row);
        let target = row(worst);
        let columns =
            [0, 1, 2, 3].map(|k| [rows[0][k], rows[1][k], rows[2][k], rows[3][k], target[k]]);
        let Some(share) = solve(columns) else { break };
        let leaving = (0..4)
            .filter(|&i| share[i] > 1e-12)
            .min_by(|&i, &j| (weight[i] / share[i]).total_cmp(&(weight[j] / share[j])));
        let Some(leaving) = leaving else { break };
        let theta = weight[leaving] / share[leaving];
        for i in 0..4 {
            weight[i] = (weight[i] - theta * share[i]).max(0.0);
        }
        weight[leaving] = theta;
        basis[leaving] = worst;
    }
    let mut order = [0, 1, 2, 3];
    order.sort_by(|&i, &j| weight[j].total_cmp(&weight[i]));
    (x, depth, order.map(|i| basis[i]))
}

/// The solution of four linear equations; `None` where they are dependent in doubles.
fn solve(mut m: [[f64; 5]; 4]) -> Option<[f64; 4]> {
    for k in 0..4 {
        let pivot = (k..4).max_by(|&i, &j| m[i][k].abs().total_cmp(&m[j][k].abs()))?;
        m.swap(k, pivot);
        if m[k][k].abs() < 1e-14 {
            return None;
        }
        for i in 0..4 {
            if i != k {
                let factor = m[i][k] / m[k][k];
                let row = m[k];
                for (x, y) in m[i].iter_mut().zip(row) {
                    *x -= factor * y;
                }
            }
        }
    }
    Some([0, 1, 2, 3].map(|k| m[k][4] / m[k][k]))
}

#[cfg(test)]
mod tests {
    use super::{HalfSpace, deepest};

    #[test]
    fn the_middle_of_a_box_is_deepest() {
        let origin = [0.2, 0.3, 0.1];
        let mut spaces = Vec::new();
        for k in 0..3 {
            let mut normal = [0.0; 3];
            normal[k] = 1.0;
            spaces.push(HalfSpace { normal, offset: origin[k] });
            normal[k] = -1.0;
            // The box is 1 by 2 by 3.
            spaces.push(HalfSpace { normal, offset: k as f64 + 1.0 - origin[k] });
        }
        let (x, depth, _) = deepest(&spaces, 100.0);
        assert!((depth - 0.5).abs() < 1e-9, "{depth}");
        assert!((x[0] + origin[0] - 0.5).abs() < 1e-9, "{x:?}");
    }

    #[test]
    fn what_cannot_be_has_no_depth() {
        let up = HalfSpace { normal: [0.0, 0.0, 1.0], offset: -1.0 };
        let down = HalfSpace { normal: [0.0, 0.0, -1.0], offset: -1.0 };
        let (_, depth, active) = deepest(&[up, down], 50.0);
        assert!(depth < 0.0, "{depth}");
        assert!(active.contains(&0) && active.contains(&1));
    }
}
