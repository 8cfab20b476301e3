//! Rows of `X` that belong to one rotation, kept orthonormal.

use pose::nalgebra::Matrix3;

use super::problem::Block;

/// `X` has `r` columns of `rows` numbers; vertex `i` owns rows `B i .. B i + d`, its rotation, and row
/// `B i + d`, its translation.
pub(crate) fn for_each_vertex<const B: usize>(rows: usize, mut f: impl FnMut(usize, usize)) {
    for vertex in 0..rows / B {
        f(vertex, vertex * B);
    }
}

/// `sym(G_i R_iᵀ)` of each vertex: the Lagrange multipliers of orthonormality where `G = M X`.
pub(crate) fn multipliers<const B: usize>(rows: usize, x: &[f64], g: &[f64]) -> Vec<Block<B>> {
    let mut all = vec![[[0.0; B]; B]; rows / B];
    for (x, g) in x.chunks_exact(rows).zip(g.chunks_exact(rows)) {
        for_each_vertex::<B>(rows, |vertex, at| {
            let block = &mut all[vertex];
            for a in 0..B - 1 {
                for b in 0..=a {
                    block[a][b] += 0.5 * (g[at + a] * x[at + b] + g[at + b] * x[at + a]);
                }
            }
        });
    }
    for block in &mut all {
        for a in 0..B - 1 {
            for b in 0..a {
                block[b][a] = block[a][b];
            }
        }
    }
    all
}

/// `G ← G - Λ X` in the rows of rotations.
pub(crate) fn subtract_product<const B: usize>(
    rows: usize,
    multipliers: &[Block<B>],
    x: &[f64],
    g: &mut [f64],
) {
    for (x, g) in x.chunks_exact(rows).zip(g.chunks_exact_mut(rows)) {
        for_each_vertex::<B>(rows, |vertex, at| {
            let block = &multipliers[vertex];
            for a in 0..B - 1 {
                let mut sum = 0.0;
                for b in 0..B - 1 {
                    sum += block[a][b] * x[at + b];
                }
                g[at + a] -= sum;
            }
        });
    }
}

/// `X + V` with the rows of each rotation replaced by the nearest orthonormal ones.
///
/// The nearest ones, and not those of Gram and Schmidt: only then does the step follow the geodesic to
/// second order, without which Newton's model is wrong along stiff curved valleys.
pub(crate) fn retract<const B: usize>(rows: usize, x: &[f64], v: &[f64]) -> Vec<f64> {
    let mut y: Vec<f64> = x.iter().zip(v).map(|(x, v)| x + v).collect();
    orthonormalise::<B>(rows, &mut y);
    y
}

/// Replaces the rows of each rotation by the nearest orthonormal ones: `(Y Yᵀ)^-½ Y`.
pub(crate) fn orthonormalise<const B: usize>(rows: usize, y: &mut [f64]) {
    let (d, rank) = (B - 1, y.len() / rows);
    for_each_vertex::<B>(rows, |_, at| {
        // The third row of a rotation of the plane stands for itself.
        let mut gram = Matrix3::<f64>::identity();
        for a in 0..d {
            for b in 0..d {
                gram[(a, b)] = (0..rank).map(|c| y[c * rows + at + a] * y[c * rows + at + b]).sum();
            }
        }
        let eigen = gram.symmetric_eigen();
        let root = eigen.eigenvalues.map(|x: f64| 1.0 / x.max(f64::MIN_POSITIVE).sqrt());
        let factor =
            eigen.eigenvectors * Matrix3::from_diagonal(&root) * eigen.eigenvectors.transpose();
        for c in 0..rank {
            let mut row = [0.0; 3];
            for (a, x) in row.iter_mut().enumerate().take(d) {
                *x = (0..d).map(|b| factor[(a, b)] * y[c * rows + at + b]).sum();
            }
            y[c * rows + at..][..d].copy_from_slice(&row[..d]);
        }
    });
}
