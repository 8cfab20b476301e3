//! The largest eigenvalue of a symmetric operator (Lanczos 1950), with full reorthogonalisation.

use pose::nalgebra::{DMatrix, SymmetricEigen};

use crate::linear::dot;

/// An eigenvalue with its vector.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Eigenpair {
    pub(crate) value: f64,
    pub(crate) vector: Vec<f64>,
    /// Length of `A v - value v`: an eigenvalue lies this near.
    pub(crate) residual: f64,
}

/// Steps at most; an inverse whose shift is within a factor of 10 of its eigenvalue needs few.
const STEPS: usize = 120;

/// The largest eigenvalue of `P A P`, `A` given by its action in place on vectors of `rows` numbers and
/// `P` keeping the rows that `kept` tells.
///
/// Starts from a fixed vector, so that the result is the same in every run. Ends where the residual is
/// below 1e-10 of the value. Cost: an action and `O(rows · steps)` for each step.
pub(crate) fn largest_eigenpair(
    rows: usize,
    kept: impl Fn(usize) -> bool,
    mut action: impl FnMut(&mut [f64]),
) -> Eigenpair {
    let keep = |v: &mut [f64]| {
        for (row, x) in v.iter_mut().enumerate() {
            if !kept(row) {
                *x = 0.0;
            }
        }
    };
    let mut v: Vec<f64> = (0..rows).map(scattered).collect();
    keep(&mut v);
    let norm = dot(&v, &v).sqrt().max(f64::MIN_POSITIVE);
    v.iter_mut().for_each(|x| *x /= norm);
    let mut basis = vec![v];
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    loop {
        let last = &basis[basis.len() - 1];
        let mut w = last.clone();
        action(&mut w);
        keep(&mut w);
        diagonal.push(dot(&w, last));
        for _ in 0..2 {
            for b in &basis {
                let share = dot(&w, b);
                w.iter_mut().zip(b).for_each(|(w, b)| *w -= share * b);
            }
        }
        let length = dot(&w, &w).sqrt();
        let steps = diagonal.len();
        let tridiagonal = DMatrix::from_fn(steps, steps, |a, b| match a.abs_diff(b) {
            0 => diagonal[a],
            1 => beside[a.min(b)],
            _ => 0.0,
        });
        let eigen = SymmetricEigen::new(tridiagonal);
        let (top, value) =
            eigen.eigenvalues.iter().copied().enumerate().fold(
                (0, f64::NEG_INFINITY),
                |best, (k, x)| if x > best.1 { (k, x) } else { best },
            );
        let weights = eigen.eigenvectors.column(top);
        let residual = (length * weights[steps - 1]).abs();
        if residual <= 1e-10 * value.abs()
            || steps == STEPS.min(rows)
            || length == 0.0
            || !length.is_finite()
        {
            let mut vector = vec![0.0; rows];
            for (b, &share) in basis.iter().zip(weights.iter()) {
                vector.iter_mut().zip(b).for_each(|(v, b)| *v += share * b);
            }
            return Eigenpair { value, vector, residual };
        }
        w.iter_mut().for_each(|x| *x /= length);
        beside.push(length);
        basis.push(w);
    }
}

/// A number in (-1, 1) that is scattered but fixed for each index (the finaliser of SplitMix64).
fn scattered(index: usize) -> f64 {
    let mut z = (index as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use pose::nalgebra::{DMatrix, DVector, SymmetricEigen};

    use super::{largest_eigenpair, scattered};

    #[test]
    fn the_largest_eigenvalue_of_the_kept_rows_is_found() {
        let rows = 30;
        let half = DMatrix::from_fn(rows, rows, |a, b| scattered(a * rows + b));
        let matrix = &half + half.transpose();
        let kept = |row: usize| row % 3 != 2;
        let found = largest_eigenpair(rows, kept, |v| {
            let product = &matrix * DVector::from_column_slice(v);
            v.copy_from_slice(product.as_slice());
        });
        let indices: Vec<usize> = (0..rows).filter(|&row| kept(row)).collect();
        let part =
            DMatrix::from_fn(indices.len(), indices.len(), |a, b| matrix[(indices[a], indices[b])]);
        let dense = SymmetricEigen::new(part).eigenvalues.max();
        assert!((found.value - dense).abs() <= found.residual + 1e-9 * dense, "{found:?}");
        assert!(found.residual <= 1e-6 * dense);
        assert!((0..rows).all(|row| kept(row) || found.vector[row] == 0.0));
    }
}
