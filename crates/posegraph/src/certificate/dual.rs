//! The certificate matrix and the sign of its smallest eigenvalue.

use super::lanczos::largest_eigenpair;
use crate::synchronize::problem::{Block, Problem};
use crate::synchronize::sparse::{BlockCholesky, Part};
use crate::synchronize::stiefel::subtract_product;

/// What is known of the smallest eigenvalue of `S_R`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Smallest {
    /// Whether `S_R + η I` was factorised: no eigenvalue is below `-η`.
    pub(crate) positive: bool,
    /// The smallest eigenvalue; 0 where `positive`, since the poses themselves are in the null space.
    pub(crate) eigenvalue: f64,
    /// What it is known to.
    pub(crate) precision: f64,
    /// No point of any rank costs less than this; minus infinity where that is not known.
    pub(crate) lower_bound: f64,
    /// Whether that is known from the matrix without one rotation of each component.
    pub(crate) held: bool,
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

    /// Factorises `S + shift I_R`, one rotation of each component struck out where it is `held`.
    fn factorize(&mut self, shift: f64, held: bool) -> bool {
        let (problem, into) = (self.problem, &mut self.factor);
        let struck = |vertex: usize, row: usize| is_struck(problem, held, vertex, row);
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

    /// The smallest eigenvalue of `S_R` at the point `x` of this cost: one factorisation where none is
    /// below `-eta`; else a shift that makes it positive definite is found by factors of 10, and
    /// Lanczos on the inverse of the shifted matrix gives the eigenvalue with its vector.
    ///
    /// Where rounding spoils the factorisation, `eta` grows by tens up to `most`, and the precision
    /// tells so. Where that leaves more than `gap` between the cost and its bound, one rotation is
    /// held, see [`bound_held`](Self::bound_held).
    pub(crate) fn smallest(&mut self, x: &[f64], cost: f64, limits: &TestLimits) -> Smallest {
        let TestLimits { eta, most, gap } = *limits;
        let trace: f64 =
            self.multipliers.iter().flat_map(|block| (0..B - 1).map(|k| block[k][k])).sum();
        let columns = (self.problem.rows() / B * (B - 1)) as f64;
        let first_rank = x.len() == self.problem.rows() * (B - 1);
        let positive = |precision: f64, lower_bound: f64, held: bool| Smallest {
            positive: true,
            eigenvalue: 0.0,
            precision,
            lower_bound,
            held,
            direction: Vec::new(),
        };
        let mut eta = eta;
        loop {
            if self.factorize(eta, false) {
                let bound = trace - eta * columns;
                if cost - bound > gap && first_rank {
                    let narrow = self.bound_held(x, cost, most);
                    return positive(eta, bound.max(narrow), narrow > bound);
                }
                return positive(eta, bound, false);
            }
            // Neither may be a number where the entries of the matrix are not.
            let wider = eta * 10.0;
            if !(wider.is_finite() && wider <= most) {
                break;
            }
            eta = wider;
        }
        if first_rank {
            let bound = self.bound_held(x, cost, most);
            if cost - bound <= gap {
                return positive(10.0 * eta, bound, true);
            }
        }
        let (largest, _) = self.problem.largest_diagonal();
        let mut shift = eta.max(f64::MIN_POSITIVE.sqrt());
        loop {
            shift *= 10.0;
            if self.factorize(shift, false) {
                break;
            }
            if !(shift.is_finite() && shift <= 1e3 * largest) {
                // Beyond the norm of the matrix only numbers that are no numbers are left.
                let eigenvalue = f64::NAN;
                return Smallest {
                    positive: false,
                    eigenvalue,
                    precision: f64::INFINITY,
                    lower_bound: f64::NEG_INFINITY,
                    held: false,
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
        let lower_bound = f64::NEG_INFINITY;
        Smallest { positive: false, eigenvalue, precision, lower_bound, held: false, direction }
    }

    /// What no poses cost less than, by the matrix without one rotation of each component; minus
    /// infinity where that is not positive definite.
    ///
    /// Any feasible `Y` can be turned, `C` orthogonal, so that `W = Y - X C` vanishes at the vertex
    /// that is held. With `G = S X`, which is the gradient and nearly 0, and `S_h` the matrix without
    /// the rows of that vertex,
    ///
    /// `F(Y) = F(X) + 2 ⟨W, G C⟩ + ⟨W, S_h W⟩ ≥ F(X) - ⟨G, S_h⁻¹ G⟩`.
    ///
    /// `S_h` has none of the null space of `S`, so it is factorised minus `shift`, far above what
    /// rounding does to it, instead of plus `η`: the bound does not suffer from entries of `1e14`. Holds at
    /// rank `d`; at a higher one `S_h` keeps a null space.
    fn bound_held(&mut self, x: &[f64], cost: f64, shift: f64) -> f64 {
        if !self.factorize(-shift, true) {
            return f64::NEG_INFINITY;
        }
        let (problem, rows) = (self.problem, self.problem.rows());
        let mut gradient = vec![0.0; x.len()];
        problem.cost_and_product(x, &mut gradient);
        subtract_product(rows, self.multipliers, x, &mut gradient);
        for (index, entry) in gradient.iter_mut().enumerate() {
            let row = index % rows;
            if is_struck(problem, true, row / B, row % B) {
                *entry = 0.0;
            }
        }
        let mut step = gradient.clone();
        self.factor.solve(&mut step);
        let decrement: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        // What rounding leaves of a sum of squares.
        cost - decrement - 1e-12 * cost - 1e-24 * problem.scale
    }
}

/// What a test of the certificate may spend and has to show.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TestLimits {
    /// Eigenvalues above minus this count as not negative.
    pub(crate) eta: f64,
    /// What `eta` may grow to where the factorisation loses more digits than that.
    pub(crate) most: f64,
    /// The gap between the cost and its bound that is asked for.
    pub(crate) gap: f64,
}

/// Whether a row of a vertex is struck out of the matrix: the translation of the first vertex of each
/// component, and, where it is `held`, its rotation.
fn is_struck<const B: usize>(problem: &Problem<B>, held: bool, vertex: usize, row: usize) -> bool {
    if row + 1 == B {
        problem.anchor[vertex] == vertex
    } else {
        held && problem.component[vertex] == vertex
    }
}
