//! The certificate matrix and the sign of its smallest eigenvalue.

use super::lanczos::largest_eigenpair;
use crate::synchronize::problem::{Block, Problem};
use crate::synchronize::sparse::{BlockCholesky, Part};

/// What is known of the smallest eigenvalue of `S_R`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Smallest {
    /// Whether `S_R + η I` was factorised: no eigenvalue is below `-η`.
    pub(crate) positive: bool,
    /// The smallest eigenvalue; 0 where `positive`, since the poses themselves are in the null space.
    pub(crate) eigenvalue: f64,
    /// What it is known to.
    pub(crate) precision: f64,
    /// A direction of negative curvature, one number for each row of `X`; empty where `positive`.
    pub(crate) direction: Vec<f64>,
}

/// `S = M - Λ` with the translations eliminated by its factorisation.
///
/// `S_R = S_RR - S_Rt S_tt⁻¹ S_tR` is the matrix `Q̃ - Λ` of Rosen et al. 2019, eq. 107. The
/// translation of the first vertex of each component is struck out, after which `S_tt` is positive
/// definite; then `S + η I_R` is positive definite where and only where `S_R + η I` is (the
/// complement of Schur), so one sparse Cholesky decides, and `S_R`, which is dense, is never formed.
pub(crate) struct DualMatrix<'a, const B: usize> {
    problem: &'a Problem<B>,
    multipliers: &'a [Block<B>],
    factor: BlockCholesky,
}

impl<'a, const B: usize> DualMatrix<'a, B> {
    pub(crate) fn new(problem: &'a Problem<B>, multipliers: &'a [Block<B>]) -> Self {
        Self { problem, multipliers, factor: BlockCholesky::new(&problem.pattern, B) }
    }

    fn factorize(&mut self, shift: f64) -> bool {
        let (problem, into) = (self.problem, &mut self.factor);
        let struck = |vertex: usize, row: usize| row + 1 == B && problem.anchor[vertex] == vertex;
        into.clear();
        for (vertex, (block, multiplier)) in
            problem.diagonal().iter().zip(self.multipliers).enumerate()
        {
            for a in 0..B {
                for b in 0..=a {
                    let value = match (struck(vertex, a) || struck(vertex, b), a == b) {
                        (true, true) => 1.0,
                        (true, false) => 0.0,
                        (false, true) if a + 1 < B => block[a][a] - multiplier[a][a] + shift,
                        (false, _) => block[a][b] - multiplier[a][b],
                    };
                    into.add(Part::Diagonal(vertex), a, b, value);
                }
            }
        }
        for (pair, (&(low, high), block)) in
            problem.pattern.pairs.iter().zip(problem.below()).enumerate()
        {
            for a in 0..B {
                for b in 0..B {
                    if !struck(high as usize, a) && !struck(low as usize, b) {
                        into.add(Part::Below(pair), a, b, block[a][b]);
                    }
                }
            }
        }
        into.factorize()
    }

    /// The smallest eigenvalue of `S_R`: one factorisation where none is below `-eta`; else a shift
    /// that makes it positive definite is found by factors of 10, and Lanczos on the inverse of the
    /// shifted matrix gives the eigenvalue with its vector.
    ///
    /// Where rounding spoils the factorisation, `eta` grows by tens up to `most`, and the precision
    /// tells so.
    pub(crate) fn smallest(&mut self, eta: f64, most: f64) -> Smallest {
        let mut eta = eta;
        loop {
            if self.factorize(eta) {
                let (precision, direction) = (eta, Vec::new());
                return Smallest { positive: true, eigenvalue: 0.0, precision, direction };
            }
            if eta * 10.0 > most {
                break;
            }
            eta *= 10.0;
        }
        let (largest, _) = self.problem.largest_diagonal();
        let mut shift = eta.max(f64::MIN_POSITIVE.sqrt());
        loop {
            shift *= 10.0;
            if self.factorize(shift) {
                break;
            }
            if shift > 1e3 * largest {
                // Beyond the norm of the matrix only numbers that are no numbers are left.
                let eigenvalue = f64::NAN;
                return Smallest {
                    positive: false,
                    eigenvalue,
                    precision: f64::INFINITY,
                    direction: Vec::new(),
                };
            }
        }
        let rows = self.problem.rows();
        let struck: Vec<usize> =
            (0..rows / B).filter(|&v| self.problem.anchor[v] == v).map(|v| v * B + B - 1).collect();
        let rotation = |row: usize| row % B + 1 != B;
        let factor = &mut self.factor;
        let pair = largest_eigenpair(rows, rotation, |v| {
            for &row in &struck {
                v[row] = 0.0;
            }
            factor.solve(v);
        });
        // The largest eigenvalue of the inverse belongs to the smallest of the shifted matrix.
        let eigenvalue = 1.0 / pair.value - shift;
        let precision = pair.residual / (pair.value * pair.value);
        let mut direction = pair.vector;
        for row in (0..rows).filter(|&row| !rotation(row)) {
            direction[row] = 0.0;
        }
        // One more solve gives the translations that go with these rotations.
        factor.solve(&mut direction);
        for &row in &struck {
            direction[row] = 0.0;
        }
        let norm = direction.iter().enumerate().filter(|&(row, _)| rotation(row));
        let norm = norm.map(|(_, x)| x * x).sum::<f64>().sqrt();
        direction.iter_mut().for_each(|x| *x /= norm);
        Smallest { positive: false, eigenvalue, precision, direction }
    }
}
