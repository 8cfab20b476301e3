//! From points of higher rank back to poses.

use pose::nalgebra::{DMatrix, Matrix2, Matrix3, SymmetricEigen};

use super::Columns;
use super::problem::Problem;

/// The rotation nearest to a matrix by columns, in the Frobenius norm; the identity for the matrix 0.
pub(crate) fn nearest_rotation(dim: usize, columns: &Columns) -> Columns {
    let mut out = *columns;
    if dim == 2 {
        let m = Matrix2::new(columns[0][0], columns[1][0], columns[0][1], columns[1][1]);
        let (c, s) = (m[(0, 0)] + m[(1, 1)], m[(1, 0)] - m[(0, 1)]);
        let norm = c.hypot(s);
        let (c, s) = if norm > 0.0 { (c / norm, s / norm) } else { (1.0, 0.0) };
        out[0] = [c, s, 0.0];
        out[1] = [-s, c, 0.0];
    } else {
        let m = Matrix3::from_fn(|row, column| columns[column][row]);
        let mut rotation = Matrix3::identity();
        if m.iter().all(|x| x.is_finite()) {
            let svd = m.svd(true, true);
            if let (Some(u), Some(v_t)) = (svd.u, svd.v_t) {
                // Singular values come in no promised order where a determinant is flipped.
                let smallest = svd.singular_values.imin();
                let mut sign = Matrix3::identity();
                if (u * v_t).determinant() < 0.0 {
                    sign[(smallest, smallest)] = -1.0;
                }
                rotation = u * sign * v_t;
            }
        }
        for (k, column) in out.iter_mut().take(3).enumerate() {
            for (row, x) in column.iter_mut().enumerate() {
                *x = rotation[(row, k)];
            }
        }
    }
    out
}

/// A point of rank `d` with its rotations in SO(d), near to a point of any rank, and the squares of
/// that point's extents along its principal axes.
///
/// Each component is turned by its own principal axes (Rosen et al. 2019, algorithm 2): what the
/// leading `d` of them keep is projected vertex by vertex, after a reflection where most
/// determinants are negative.
pub(crate) fn round<const B: usize>(problem: &Problem<B>, x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (rows, d) = (problem.rows(), B - 1);
    let rank = x.len() / rows;
    let mut out = vec![0.0; rows * d];
    let mut spectrum = Vec::new();
    let count = rows / B;
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
    for vertex in 0..count {
        members[problem.component[vertex]].push(vertex);
    }
    for members in members.iter().filter(|members| !members.is_empty()) {
        let mut gram = DMatrix::<f64>::zeros(rank, rank);
        for &vertex in members {
            for k in 0..d {
                for a in 0..rank {
                    for b in 0..rank {
                        let (row, n) = (vertex * B + k, rows);
                        gram[(a, b)] += x[a * n + row] * x[b * n + row];
                    }
                }
            }
        }
        let eigen = SymmetricEigen::new(gram);
        let mut order: Vec<usize> = (0..rank).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        if spectrum.is_empty() {
            spectrum = order.iter().map(|&k| eigen.eigenvalues[k].max(0.0)).collect();
        }
        let turned = |row: usize, axis: usize| -> f64 {
            (0..rank).map(|c| x[c * rows + row] * eigen.eigenvectors[(c, order[axis])]).sum()
        };
        let mut turned: Vec<[[f64; 3]; 4]> = members
            .iter()
            .map(|&vertex| {
                let mut columns = [[0.0; 3]; 4];
                for (k, column) in columns.iter_mut().take(B).enumerate() {
                    for (axis, x) in column.iter_mut().take(d).enumerate() {
                        *x = turned(vertex * B + k, axis);
                    }
                }
                columns
            })
            .collect();
        let reflected = turned.iter().filter(|columns| determinant(d, columns) < 0.0).count();
        if 2 * reflected > members.len() {
            for column in turned.iter_mut().flatten() {
                column[d - 1] = -column[d - 1];
            }
        }
        for (&vertex, columns) in members.iter().zip(&turned) {
            let rotation = nearest_rotation(d, columns);
            for axis in 0..d {
                for k in 0..d {
                    out[axis * rows + vertex * B + k] = rotation[k][axis];
                }
                out[axis * rows + vertex * B + d] = columns[d][axis];
            }
        }
    }
    (out, spectrum)
}

fn determinant(d: usize, c: &Columns) -> f64 {
    if d == 2 {
        c[0][0] * c[1][1] - c[0][1] * c[1][0]
    } else {
        Matrix3::from_fn(|row, column| c[column][row]).determinant()
    }
}

#[cfg(test)]
mod tests {
    use super::nearest_rotation;

    #[test]
    fn reflections_go_to_the_nearest_rotation() {
        // Of the axes of a reflection the one that matters least is turned round.
        let mirrored = [[3.0, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 2.0], [7.0, 8.0, 9.0]];
        let found = nearest_rotation(3, &mirrored);
        let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [7.0, 8.0, 9.0]];
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-12);
        }
        let plane = [[2.0, 0.0, 0.0], [0.0, -1.0, 0.0], [4.0, 5.0, 0.0], [0.0; 3]];
        assert_eq!(nearest_rotation(2, &plane)[0], [1.0, 0.0, 0.0]);
        let nothing = nearest_rotation(3, &[[0.0; 3]; 4]);
        let (a, b) = (nothing[0], nothing[1]);
        assert!((a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()).abs() < 1e-12);
        assert!((a.iter().map(|a| a * a).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
