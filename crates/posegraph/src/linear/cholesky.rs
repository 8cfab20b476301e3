//! The Cholesky factor of a block matrix, by faer.

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::{simplicial, supernodal};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

use super::{BlockPattern, substitution};

/// When neighbouring supernodes are joined: up to so many columns, and such a share of zeros.
const RELAX: [(usize, f64); 4] = [(4, 1.0), (16, 0.8), (48, 0.1), (usize::MAX, 0.05)];

/// A matrix that has no Cholesky factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotPositiveDefinite;

/// A Cholesky factor whose pattern is found once and filled many times.
pub(crate) struct BlockCholesky<const D: usize> {
    lower: SymbolicSparseColMat<usize>,
    symbolic: supernodal::SymbolicSupernodalCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
    buffer: Vec<f64>,
}

impl<const D: usize> BlockCholesky<D> {
    /// The pattern of the factor; `None` where it has more entries than can be counted.
    pub(crate) fn new(pattern: &BlockPattern<D>) -> Option<Self> {
        let unknowns = pattern.blocks() * D;
        let (starts, rows) = upper_rows(pattern);
        let upper =
            SymbolicSparseColMatRef::new_unsorted_checked(unknowns, unknowns, &starts, None, &rows);
        let mut tree = vec![0isize; unknowns];
        let mut counts = vec![0usize; unknowns];
        let mut memory = MemBuffer::new(StackReq::any_of(&[
            simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(unknowns, rows.len()),
            supernodal::factorize_supernodal_symbolic_cholesky_scratch::<usize>(unknowns),
        ]));
        let tree = simplicial::prefactorize_symbolic_cholesky(
            &mut tree,
            &mut counts,
            upper,
            MemStack::new(&mut memory),
        );
        let symbolic = supernodal::factorize_supernodal_symbolic_cholesky(
            upper,
            tree,
            &counts,
            MemStack::new(&mut memory),
            SymbolicSupernodalParams { relax: Some(&RELAX) },
        )
        .ok()?;
        let scratch = supernodal::factorize_supernodal_numeric_llt_scratch::<usize, f64>(
            &symbolic,
            Par::Seq,
            Default::default(),
        );
        let (starts, rows) = lower_rows(pattern);
        let lower =
            SymbolicSparseColMat::new_unsorted_checked(unknowns, unknowns, starts, None, rows);
        let values = vec![0.0; symbolic.len_val()];
        let memory = MemBuffer::new(scratch);
        Some(Self { lower, symbolic, values, memory, buffer: Vec::new() })
    }

    /// Number of stored numbers in the factor.
    pub(crate) fn fill(&self) -> usize {
        self.values.len()
    }

    /// Computes the factor of the matrix with these numbers, laid out as the pattern says.
    pub(crate) fn factorize(&mut self, matrix: &[f64]) -> Result<(), NotPositiveDefinite> {
        let result = supernodal::factorize_supernodal_numeric_llt(
            &mut self.values,
            SparseColMatRef::new(self.lower.as_ref(), matrix),
            Default::default(),
            &self.symbolic,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        match result {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { .. }) => Err(NotPositiveDefinite),
        }
    }

    /// Writes the product of the symmetric matrix with these numbers and a vector, both in
    /// elimination order.
    pub(crate) fn multiply(&self, matrix: &[f64], vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        let (starts, rows) = (self.lower.col_ptr(), self.lower.row_idx());
        for (column, &x) in vector.iter().enumerate() {
            let entries = starts[column]..starts[column + 1];
            let (mut across, mut diagonal) = (0.0, 0.0);
            for (&row, &entry) in rows[entries.clone()].iter().zip(&matrix[entries]) {
                // Of a diagonal block both triangles are stored; one counts.
                if row > column {
                    product[row] += entry * x;
                    across += entry * vector[row];
                } else if row == column {
                    diagonal = entry;
                }
            }
            product[column] += across + diagonal * x;
        }
    }

    /// Solves for a right-hand side in elimination order, with the last factor.
    pub(crate) fn solve_in_place(&mut self, rhs: &mut [f64]) {
        substitution::solve_in_place(&self.symbolic, &self.values, rhs, &mut self.buffer);
    }
}

/// The rows of each column of the lower triangle, as the numbers are stored.
fn lower_rows<const D: usize>(pattern: &BlockPattern<D>) -> (Vec<usize>, Vec<usize>) {
    let mut starts = Vec::with_capacity(pattern.blocks() * D + 1);
    let mut rows = Vec::with_capacity(pattern.len());
    starts.push(0);
    for column in 0..pattern.blocks() {
        for _ in 0..D {
            for &row in std::iter::once(&column).chain(pattern.below(column)) {
                rows.extend(row * D..(row + 1) * D);
            }
            starts.push(rows.len());
        }
    }
    (starts, rows)
}

/// The rows of each column of the upper triangle.
fn upper_rows<const D: usize>(pattern: &BlockPattern<D>) -> (Vec<usize>, Vec<usize>) {
    let blocks = pattern.blocks();
    // The transpose of the lower triangle, by counting.
    let mut starts = vec![0; blocks + 1];
    for column in 0..blocks {
        for &row in pattern.below(column) {
            starts[row + 1] += 1;
        }
    }
    for row in 0..blocks {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let mut above = vec![0; starts[blocks]];
    for column in 0..blocks {
        for &row in pattern.below(column) {
            above[next[row]] = column;
            next[row] += 1;
        }
    }
    let mut scalar_starts = Vec::with_capacity(blocks * D + 1);
    let mut rows = Vec::with_capacity(pattern.len());
    scalar_starts.push(0);
    for block in 0..blocks {
        for inner in 0..D {
            for &row in &above[starts[block]..starts[block + 1]] {
                rows.extend(row * D..(row + 1) * D);
            }
            rows.extend(block * D..=block * D + inner);
            scalar_starts.push(rows.len());
        }
    }
    (scalar_starts, rows)
}
