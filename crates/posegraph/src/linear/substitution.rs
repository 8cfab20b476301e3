//! Forward and backward substitution for one right-hand side.
//!
//! faer's own goes through its general products, whose overhead on the narrow supernodes of a pose
//! graph is several times the work. The loops are compiled for the widest vectors of the machine that
//! they run on, by pulp, as faer's kernels are; the order of the sums, and with it the bits, is one for all.

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use pulp::Arch;

/// Columns that are added together.
const TOGETHER: usize = 4;

/// The columns of one supernode.
struct Supernode<'a> {
    /// The first of its columns.
    start: usize,
    /// Number of its columns.
    width: usize,
    /// Rows beneath the block on the diagonal.
    below: &'a [usize],
    /// The numbers, column after column.
    values: &'a [f64],
}

#[inline(always)]
fn supernode<'a>(
    symbolic: &'a SymbolicSupernodalCholesky<usize>,
    values: &'a [f64],
    index: usize,
) -> Supernode<'a> {
    let start = symbolic.supernode_begin()[index];
    let starts = symbolic.col_ptr_for_val();
    Supernode {
        start,
        width: symbolic.supernode_end()[index] - start,
        below: symbolic.supernode(index).pattern(),
        values: &values[starts[index]..starts[index + 1]],
    }
}

/// Solves `L Lᵀ x = b` in place, `L` the factor with these numbers; `buffer` is memory to work in.
pub(super) fn solve_in_place(
    symbolic: &SymbolicSupernodalCholesky<usize>,
    values: &[f64],
    rhs: &mut [f64],
    buffer: &mut Vec<f64>,
) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for index in 0..symbolic.n_supernodes() {
                supernode(symbolic, values, index).forward(rhs, buffer);
            }
            for index in (0..symbolic.n_supernodes()).rev() {
                supernode(symbolic, values, index).backward(rhs, buffer);
            }
        },
    );
}

impl Supernode<'_> {
    /// Its part of `L x = b`, and what it takes from the rows beneath.
    #[inline(always)]
    fn forward(&self, rhs: &mut [f64], buffer: &mut Vec<f64>) {
        let rows = self.width + self.below.len();
        let own = &mut rhs[self.start..self.start + self.width];
        for (at, column) in self.values.chunks_exact(rows).enumerate() {
            let (known, later) = own.split_at_mut(at + 1);
            known[at] /= column[at];
            for (entry, factor) in later.iter_mut().zip(&column[at + 1..]) {
                *entry -= factor * known[at];
            }
        }
        buffer.clear();
        buffer.resize(self.below.len(), 0.0);
        add_columns(self.values, rows, self.width, own, buffer);
        for (&row, sum) in self.below.iter().zip(&*buffer) {
            rhs[row] -= sum;
        }
    }

    /// Its part of `Lᵀ x = b`, where those of all later columns are known.
    #[inline(always)]
    fn backward(&self, rhs: &mut [f64], buffer: &mut Vec<f64>) {
        let rows = self.width + self.below.len();
        buffer.clear();
        buffer.extend(self.below.iter().map(|&row| rhs[row]));
        let own = &mut rhs[self.start..self.start + self.width];
        for (at, column) in self.values.chunks_exact(rows).enumerate().rev() {
            let known = dot(&column[at + 1..self.width], &own[at + 1..]);
            own[at] = (own[at] - known - dot(&column[self.width..], buffer)) / column[at];
        }
    }
}

/// Adds to `sums` columns of `rows` numbers each, from row `from` on, each as many times as `times`
/// says.
#[inline(always)]
fn add_columns(values: &[f64], rows: usize, from: usize, times: &[f64], sums: &mut [f64]) {
    for (times, columns) in times.chunks(TOGETHER).zip(values.chunks(TOGETHER * rows)) {
        let column = |at: usize| columns[at * rows + from..(at + 1) * rows].iter();
        if let &[p, q, r, s] = times {
            let four = column(0).zip(column(1)).zip(column(2).zip(column(3)));
            for (sum, ((a, b), (c, d))) in sums.iter_mut().zip(four) {
                *sum += a * p + b * q + (c * r + d * s);
            }
        } else {
            for (at, times) in times.iter().enumerate() {
                for (sum, entry) in sums.iter_mut().zip(column(at)) {
                    *sum += entry * times;
                }
            }
        }
    }
}

/// The inner product, summed in eight strands.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_head, a_tail) = a.as_chunks::<8>();
    let (b_head, b_tail) = b.as_chunks::<8>();
    let mut strands = [0.0; 8];
    for (a, b) in a_head.iter().zip(b_head) {
        for k in 0..8 {
            strands[k] += a[k] * b[k];
        }
    }
    let tail: f64 = a_tail.iter().zip(b_tail).map(|(a, b)| a * b).sum();
    strands.iter().sum::<f64>() + tail
}

#[cfg(test)]
mod tests {
    use pose::nalgebra::{DMatrix, DVector};

    use crate::linear::{BlockCholesky, BlockPattern, NotPositiveDefinite};

    /// A ring of blocks with chords, and the same matrix in full: what is known of it is its diagonal
    /// and where blocks are.
    fn held_to_dense<const D: usize>(count: usize) {
        let pairs = (0..count).flat_map(|k| [(k, (k + 1) % count), (k, (3 * k + 7) % count)]);
        let pattern = BlockPattern::<D>::new(count, pairs);
        let mut cholesky = BlockCholesky::new(&pattern).expect("a small matrix");
        let rows = count * D;
        let value = |k: usize| ((k * 37 + 11) % 19) as f64 / 19.0 - 0.5;
        let mut matrix = vec![0.0; pattern.len()];
        let mut dense = DMatrix::<f64>::zeros(rows, rows);
        for column in 0..count {
            let below = std::iter::once(column).chain(pattern.below(column).iter().copied());
            for (at, row) in below.enumerate() {
                let slot = pattern.diagonal(column);
                for i in 0..D {
                    for j in 0..D {
                        let far = if row == column && i == j { 12.0 * D as f64 } else { 0.0 };
                        let (low, high) = if row == column { (i.min(j), i.max(j)) } else { (i, j) };
                        let entry = far + value(7 * row + 3 * column + 5 * low + high);
                        matrix[slot.start + at * D + j * slot.stride + i] = entry;
                        dense[(row * D + i, column * D + j)] = entry;
                        dense[(column * D + j, row * D + i)] = entry;
                    }
                }
            }
        }
        assert_eq!(cholesky.factorize(&matrix), Ok(()));
        let right: Vec<f64> = (0..rows).map(value).collect();
        let right = DVector::from_vec(right);
        let mut product = vec![f64::NAN; rows];
        cholesky.multiply(&matrix, right.as_slice(), &mut product);
        assert!((&dense * &right - DVector::from_vec(product)).amax() < 1e-12);
        let mut solution = right.as_slice().to_vec();
        cholesky.solve_in_place(&mut solution);
        assert!((&dense * DVector::from_vec(solution) - &right).amax() < 1e-12);
        for entry in &mut matrix {
            *entry = -*entry;
        }
        assert_eq!(cholesky.factorize(&matrix), Err(NotPositiveDefinite));
    }

    #[test]
    fn products_and_solutions_are_those_of_the_dense_matrix() {
        for count in [1, 2, 5, 40] {
            held_to_dense::<3>(count);
            held_to_dense::<6>(count);
        }
    }
}
