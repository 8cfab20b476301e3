//! What is done about information matrices that are not what they should be.

use std::borrow::Cow;

use pose::nalgebra::SMatrix;

use super::{Factor, FactorGraph, Manifold};

/// An eigenvalue this much below 0, as a share of the largest, is rounding.
const ROUNDING: f64 = 1e-12;

/// Sweeps of Jacobi's method; it needs six to ten for matrices of this size.
const SWEEPS: usize = 30;

/// What was done about information matrices that are not what they should be.
///
/// Each is replaced by its symmetric part, which has the same cost; where that has negative
/// eigenvalues, by the nearest positive semidefinite matrix, which sets them to 0. A negative
/// eigenvalue would reward disagreement, and the cost would have no minimum. Factors that are not
/// finite, lead from a vertex to itself or to a vertex that does not exist are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InformationPolicy {
    /// Factors whose matrix was not symmetric.
    pub symmetrised: usize,
    /// Factors whose matrix had an eigenvalue below 0.
    pub projected: usize,
    /// The smallest eigenvalue that was set to 0, or 0.
    pub smallest_eigenvalue: f64,
    /// Indices of factors that were left out.
    pub left_out: Vec<usize>,
}

/// The factors of a graph as the optimiser uses them, and what was changed.
///
/// Borrowed where nothing had to be changed; factors left out stay in place.
pub(crate) fn admissible<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
) -> (Cow<'_, [Factor<P, D>]>, InformationPolicy) {
    let mut policy = InformationPolicy::default();
    let mut factors = Cow::Borrowed(graph.factors.as_slice());
    let count = graph.ids.len();
    // Most graphs repeat one matrix over and over.
    let mut last_good = None;
    for (index, factor) in graph.factors.iter().enumerate() {
        let leads = factor.from < count && factor.to < count && factor.from != factor.to;
        let information = &factor.information;
        let finite =
            factor.from_from_to.is_finite() && information.iter().all(|entry| entry.is_finite());
        if !(leads && finite) {
            policy.left_out.push(index);
            continue;
        }
        if last_good == Some(information) {
            continue;
        }
        let symmetric = is_symmetric(information);
        if symmetric && has_cholesky(information) {
            last_good = Some(information);
            continue;
        }
        let half = information.transpose() * 0.5 + information * 0.5;
        let (projected, smallest) = nearest_semidefinite(&half);
        policy.symmetrised += usize::from(!symmetric);
        if let Some(projected) = projected {
            policy.projected += 1;
            policy.smallest_eigenvalue = policy.smallest_eigenvalue.min(smallest);
            factors.to_mut()[index].information = projected;
        } else if !symmetric {
            factors.to_mut()[index].information = half;
        }
    }
    (factors, policy)
}

/// The information matrix as the optimiser uses it, see [`InformationPolicy`]; all entries finite.
pub(crate) fn admissible_information<const D: usize>(
    information: &SMatrix<f64, D, D>,
) -> SMatrix<f64, D, D> {
    if is_symmetric(information) && has_cholesky(information) {
        return *information;
    }
    let half = information.transpose() * 0.5 + information * 0.5;
    nearest_semidefinite(&half).0.unwrap_or(half)
}

fn is_symmetric<const D: usize>(matrix: &SMatrix<f64, D, D>) -> bool {
    (0..D).all(|row| (0..row).all(|column| matrix[(row, column)] == matrix[(column, row)]))
}

/// Whether a symmetric matrix has a Cholesky factor.
fn has_cholesky<const D: usize>(matrix: &SMatrix<f64, D, D>) -> bool {
    let mut lower = *matrix;
    for column in 0..D {
        for before in 0..column {
            let share = lower[(column, before)];
            for row in column..D {
                lower[(row, column)] -= share * lower[(row, before)];
            }
        }
        let pivot = lower[(column, column)];
        if pivot <= 0.0 || !pivot.is_finite() {
            return false;
        }
        let root = pivot.sqrt();
        for row in column..D {
            lower[(row, column)] /= root;
        }
    }
    true
}

/// The nearest positive semidefinite matrix to a symmetric one, `None` where it is one, and the
/// smallest eigenvalue.
fn nearest_semidefinite<const D: usize>(
    matrix: &SMatrix<f64, D, D>,
) -> (Option<SMatrix<f64, D, D>>, f64) {
    let (values, vectors) = eigen(matrix);
    let largest = values.iter().fold(0.0f64, |most, value| most.max(value.abs()));
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    if smallest >= -ROUNDING * largest {
        return (None, smallest);
    }
    let mut nearest = SMatrix::zeros();
    for (index, &value) in values.iter().enumerate().filter(|(_, value)| **value > 0.0) {
        let vector = vectors.column(index);
        nearest += vector * vector.transpose() * value;
    }
    (Some((nearest + nearest.transpose()) * 0.5), smallest)
}

/// Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations.
fn eigen<const D: usize>(matrix: &SMatrix<f64, D, D>) -> ([f64; D], SMatrix<f64, D, D>) {
    let mut a = *matrix;
    let mut vectors = SMatrix::<f64, D, D>::identity();
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for p in 0..D {
            for q in p + 1..D {
                let off = a[(p, q)];
                if off.abs() <= f64::EPSILON * 0.01 * (a[(p, p)] * a[(q, q)]).abs().sqrt()
                    || off.abs() < f64::MIN_POSITIVE
                {
                    continue;
                }
                rotated = true;
                let theta = (a[(q, q)] - a[(p, p)]) / (2.0 * off);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                let s = t * c;
                for k in 0..D {
                    let (x, y) = (a[(k, p)], a[(k, q)]);
                    (a[(k, p)], a[(k, q)]) = (c * x - s * y, s * x + c * y);
                }
                for k in 0..D {
                    let (x, y) = (a[(p, k)], a[(q, k)]);
                    (a[(p, k)], a[(q, k)]) = (c * x - s * y, s * x + c * y);
                    let (x, y) = (vectors[(k, p)], vectors[(k, q)]);
                    (vectors[(k, p)], vectors[(k, q)]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
        if !rotated {
            break;
        }
    }
    (std::array::from_fn(|index| a[(index, index)]), vectors)
}
