//! The certificate by dense algebra, from the formulas of the problem alone.

use pose::nalgebra::{DMatrix, SymmetricEigen};
use posegraph::synchronize::{Columns, isotropic_weights};
use posegraph::{FactorGraph, Rigid};

/// SE-Sync's data matrix over `[t_i R_i]`, translations last, `d + 1` rows for each vertex.
pub fn data_matrix<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>) -> DMatrix<f64> {
    let (d, count) = (P::DIM, graph.ids.len());
    let size = d + 1;
    let mut m = DMatrix::zeros(count * size, count * size);
    for factor in &graph.factors {
        let (kappa, tau) = isotropic_weights::<P, D>(&factor.information);
        let columns: Columns = factor.from_from_to.columns();
        // One residual for each column of [R t]: x_to[k] - Σ_l T[l][k] x_from[l].
        for k in 0..size {
            let mut row = DMatrix::zeros(1, count * size);
            row[(0, factor.to * size + k)] += 1.0;
            for l in 0..d {
                row[(0, factor.from * size + l)] -= columns[k][l];
            }
            if k == d {
                row[(0, factor.from * size + d)] -= 1.0;
            }
            m += row.transpose() * &row * if k == d { tau } else { kappa };
        }
    }
    m
}

/// The poses as a matrix with `d` columns, in the rows of [`data_matrix`].
pub fn stacked<P: Rigid<D>, const D: usize>(poses: &[P]) -> DMatrix<f64> {
    let size = P::DIM + 1;
    DMatrix::from_fn(poses.len() * size, P::DIM, |row, axis| {
        poses[row / size].columns()[row % size][axis]
    })
}

/// The smallest eigenvalue of `Q̃ - Λ`, translations eliminated by a dense pseudo-inverse.
pub fn smallest_eigenvalue<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    poses: &[P],
) -> f64 {
    let (d, count) = (P::DIM, poses.len());
    let size = d + 1;
    let m = data_matrix(graph);
    let x = stacked(poses);
    let rotation: Vec<usize> = (0..count * size).filter(|row| row % size != d).collect();
    let translation: Vec<usize> = (0..count * size).filter(|row| row % size == d).collect();
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |a, b| m[(rows[a], columns[b])])
    };
    let inverse = part(&translation, &translation).pseudo_inverse(1e-9).unwrap();
    let mixed = part(&rotation, &translation);
    let mut s = part(&rotation, &rotation) - &mixed * inverse * mixed.transpose();
    let r = DMatrix::from_fn(rotation.len(), d, |a, axis| x[(rotation[a], axis)]);
    let product = &s * &r;
    for vertex in 0..count {
        let block = product.rows(vertex * d, d) * r.rows(vertex * d, d).transpose();
        let multiplier = (&block + block.transpose()) * 0.5;
        let mut part = s.view_mut((vertex * d, vertex * d), (d, d));
        part -= multiplier;
    }
    SymmetricEigen::new(s).eigenvalues.min()
}
