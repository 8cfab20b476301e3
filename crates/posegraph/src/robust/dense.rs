//! Small symmetric matrices of any size.

use pose::nalgebra::{SMatrix, SVector};

/// The lower Cholesky factor; `None` where the matrix is not positive definite.
pub(super) fn cholesky<const D: usize>(matrix: &SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
    let mut lower = SMatrix::zeros();
    for column in 0..D {
        for row in column..D {
            let mut entry = matrix[(row, column)];
            for before in 0..column {
                entry -= lower[(row, before)] * lower[(column, before)];
            }
            if row > column {
                lower[(row, column)] = entry / lower[(column, column)];
            } else if entry > 0.0 && entry.is_finite() {
                lower[(row, row)] = f64::sqrt(entry);
            } else {
                return None;
            }
        }
    }
    Some(lower)
}

/// `L⁻¹ x`.
pub(super) fn forward<const D: usize>(
    lower: &SMatrix<f64, D, D>,
    mut x: SVector<f64, D>,
) -> SVector<f64, D> {
    for row in 0..D {
        for before in 0..row {
            x[row] -= lower[(row, before)] * x[before];
        }
        x[row] /= lower[(row, row)];
    }
    x
}

/// `xᵀ A⁻¹ x` and `√det A`; `None` where `A` is not positive definite.
pub(super) fn quadratic<const D: usize>(
    matrix: &SMatrix<f64, D, D>,
    x: &SVector<f64, D>,
) -> Option<(f64, f64)> {
    let lower = cholesky(matrix)?;
    let root = (0..D).map(|k| lower[(k, k)]).product();
    Some((forward(&lower, *x).norm_squared(), root))
}

/// The inverse of an information matrix; directions without information get 1e-9 of the largest
/// entry. `None` where there is no information at all.
pub(super) fn covariance<const D: usize>(
    information: &SMatrix<f64, D, D>,
) -> Option<SMatrix<f64, D, D>> {
    let largest = (0..D).map(|k| information[(k, k)]).fold(0.0, f64::max);
    let floor = SMatrix::<f64, D, D>::identity() * (1e-9 * largest);
    let lower = cholesky(information).or_else(|| cholesky(&(information + floor)))?;
    let mut columns = SMatrix::<f64, D, D>::zeros();
    for k in 0..D {
        let unit = SVector::from_fn(|row, _| f64::from(u8::from(row == k)));
        columns.set_column(k, &forward(&lower, unit));
    }
    Some(columns.tr_mul(&columns))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pose::nalgebra::{Matrix3, Vector3};

    #[test]
    fn the_covariance_is_the_inverse() {
        let matrix = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 2.0);
        let inverse = covariance(&matrix).unwrap();
        assert!((inverse * matrix - Matrix3::identity()).norm() < 1e-14);
        let x = Vector3::new(1.0, -2.0, 0.3);
        let expected = x.dot(&(inverse * x));
        let (found, root) = quadratic(&matrix, &x).unwrap();
        assert!((found - expected).abs() < 1e-14);
        assert!((root * root - matrix.determinant()).abs() < 1e-12);
        assert_eq!(covariance(&Matrix3::zeros()), None);
    }
}
