//! Sparse Cholesky of symmetric matrices of square blocks whose size is known at run time only.
//!
//! Beside [`crate::linear`], whose blocks have the size of a pose: here the same graph gives matrices
//! with 1, `d`, `d + 1` or, at rank `r`, more rows for each vertex, and several right-hand sides.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::simplicial;
use faer::sparse::linalg::cholesky::supernodal::{
    self, SupernodalLltRef, SymbolicSupernodalCholesky,
};
use faer::sparse::linalg::{SymbolicSupernodalParams, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

/// Which pairs of vertices are joined: the pattern that all matrices of one graph share.
///
/// Vertices are renumbered by minimum degree (AMD, Amestoy et al. 1996), so that factors fill little.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// New index of each vertex.
    pub(crate) position: Vec<usize>,
    /// Vertex at each new index.
    pub(crate) vertex: Vec<usize>,
    /// Pairs of new indices `(low, high)`, ascending, each once.
    pub(crate) pairs: Vec<(u32, u32)>,
}

impl Pattern {
    /// From pairs of vertices below `count`, in any order, repeated or not.
    pub(crate) fn new(count: usize, joined: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pairs: Vec<(u32, u32)> =
            joined.map(|(a, b)| (a.min(b) as u32, a.max(b) as u32)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let (vertex, position) = minimum_degree(count, &pairs);
        for pair in &mut pairs {
            let (a, b) = (position[pair.0 as usize] as u32, position[pair.1 as usize] as u32);
            *pair = (a.min(b), a.max(b));
        }
        pairs.sort_unstable();
        Self { position, vertex, pairs }
    }

    /// Number of vertices.
    pub(crate) fn count(&self) -> usize {
        self.vertex.len()
    }

    /// Index in [`pairs`](Self::pairs) of a pair of new indices.
    pub(crate) fn find(&self, a: usize, b: usize) -> usize {
        let pair = (a.min(b) as u32, a.max(b) as u32);
        self.pairs.binary_search(&pair).expect("the pattern was built from these pairs")
    }
}

fn minimum_degree(count: usize, pairs: &[(u32, u32)]) -> (Vec<usize>, Vec<usize>) {
    let mut starts = vec![0usize; count + 1];
    for &(low, _) in pairs {
        starts[low as usize + 1] += 1;
    }
    for k in 0..count {
        starts[k + 1] += starts[k];
    }
    let rows: Vec<usize> = pairs.iter().map(|&(_, high)| high as usize).collect();
    let symbolic = SymbolicSparseColMat::new_checked(count, count, starts, None, rows);
    let (mut order, mut inverse) = (vec![0; count], vec![0; count]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(count, pairs.len()));
    let done = amd::order(
        &mut order,
        &mut inverse,
        symbolic.as_ref(),
        amd::Control::default(),
        MemStack::new(&mut memory),
    );
    if done.is_err() {
        // Only an overflow of indices ends here: keep the given order, which is as correct.
        order = (0..count).collect();
        inverse = order.clone();
    }
    (order, inverse)
}

/// Which part of a symmetric block matrix is written.
pub(crate) enum Part {
    /// The diagonal block of a vertex, by new index.
    Diagonal(usize),
    /// The block below the diagonal of a pair, by its index: row `high`, column `low`.
    Below(usize),
}

/// When neighbouring supernodes are joined: up to so many columns, and such a share of zeros.
const RELAX: [(usize, f64); 4] = [(4, 1.0), (16, 0.8), (48, 0.1), (usize::MAX, 0.05)];

/// The analysed pattern of matrices with blocks of `b` rows, with memory for their values.
pub(crate) struct BlockCholesky {
    size: usize,
    lower: SymbolicSparseColMat<usize>,
    symbolic: SymbolicSupernodalCholesky<usize>,
    /// For each pair, the place of its block among those below the diagonal of its column.
    slot: Vec<usize>,
    pairs: Vec<(u32, u32)>,
    values: Vec<f64>,
    factor: Vec<f64>,
    memory: MemBuffer,
    ready: bool,
}

/// Right-hand sides that are solved for at the same time.
const WIDTH: usize = 4;

impl BlockCholesky {
    pub(crate) fn new(pattern: &Pattern, size: usize) -> Self {
        let count = pattern.count();
        let n = count * size;
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); count];
        let mut above: Vec<Vec<usize>> = vec![Vec::new(); count];
        let mut slot = Vec::with_capacity(pattern.pairs.len());
        for &(low, high) in &pattern.pairs {
            slot.push(below[low as usize].len());
            below[low as usize].push(high as usize);
            above[high as usize].push(low as usize);
        }
        let symbolic = analyse(size, &above);
        let (mut starts, mut rows) = (Vec::with_capacity(n + 1), Vec::new());
        for (column, below) in below.iter().enumerate() {
            for k in 0..size {
                starts.push(rows.len());
                rows.extend(column * size + k..(column + 1) * size);
                for &high in below {
                    rows.extend(high * size..(high + 1) * size);
                }
            }
        }
        starts.push(rows.len());
        let values = vec![0.0; rows.len()];
        let lower = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let memory = MemBuffer::new(
            supernodal::factorize_supernodal_numeric_llt_scratch::<usize, f64>(
                &symbolic,
                Par::Seq,
                Default::default(),
            )
            .or(symbolic.solve_in_place_scratch::<f64>(WIDTH, Par::Seq)),
        );
        let factor = vec![0.0; symbolic.len_val()];
        let pairs = pattern.pairs.clone();
        Self { size, lower, symbolic, slot, pairs, values, factor, memory, ready: false }
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.lower.nrows()
    }

    /// The largest number on the diagonal.
    pub(crate) fn largest_diagonal(&self) -> f64 {
        let starts = &self.lower.col_ptr()[..self.rows()];
        starts.iter().map(|&start| self.values[start]).fold(0.0, f64::max)
    }

    /// Sets every entry to 0.
    pub(crate) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds to the entry `(row, column)` of a block; above the diagonal of the matrix nothing is kept.
    #[inline]
    pub(crate) fn add(&mut self, part: Part, row: usize, column: usize, value: f64) {
        let size = self.size;
        let starts = self.lower.col_ptr();
        let index = match part {
            Part::Diagonal(_) if row < column => return,
            Part::Diagonal(vertex) => starts[vertex * size + column] + row - column,
            Part::Below(pair) => {
                let low = self.pairs[pair].0 as usize;
                starts[low * size + column] + (size - column) + self.slot[pair] * size + row
            }
        };
        self.values[index] += value;
    }

    /// Factorises; whether the matrix is numerically positive definite.
    pub(crate) fn factorize(&mut self) -> bool {
        self.ready = supernodal::factorize_supernodal_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new(self.lower.as_ref(), &self.values[..]),
            Default::default(),
            &self.symbolic,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        )
        .is_ok()
            && self.factor.iter().all(|x| x.is_finite());
        self.ready
    }

    /// Solves in place for right-hand sides that stand column after column.
    pub(crate) fn solve(&mut self, columns: &mut [f64]) {
        debug_assert!(self.ready, "solved without a factor");
        let n = self.rows();
        if n == 0 {
            return;
        }
        for chunk in columns.chunks_mut(WIDTH * n) {
            let width = chunk.len() / n;
            SupernodalLltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(chunk, n, width),
                Par::Seq,
                MemStack::new(&mut self.memory),
            );
        }
    }
}

/// The pattern of the factor, its columns gathered into supernodes.
fn analyse(size: usize, above: &[Vec<usize>]) -> SymbolicSupernodalCholesky<usize> {
    let n = above.len() * size;
    let (mut starts, mut rows) = (Vec::with_capacity(n + 1), Vec::new());
    for (column, above) in above.iter().enumerate() {
        for k in 0..size {
            starts.push(rows.len());
            for &low in above {
                rows.extend(low * size..(low + 1) * size);
            }
            rows.extend(column * size..=column * size + k);
        }
    }
    starts.push(rows.len());
    let upper = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows);
    let (mut tree, mut counts) = (vec![0isize; n], vec![0usize; n]);
    let mut memory = MemBuffer::new(
        simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(n, rows.len())
            .or(supernodal::factorize_supernodal_symbolic_cholesky_scratch::<usize>(n)),
    );
    let tree = simplicial::prefactorize_symbolic_cholesky(
        &mut tree,
        &mut counts,
        upper,
        MemStack::new(&mut memory),
    );
    supernodal::factorize_supernodal_symbolic_cholesky(
        upper,
        tree,
        &counts,
        MemStack::new(&mut memory),
        SymbolicSupernodalParams { relax: Some(&RELAX) },
    )
    .expect("the factor fits into memory")
}

#[cfg(test)]
mod tests {
    use pose::nalgebra::{DMatrix, DVector};

    use super::{BlockCholesky, Part, Pattern};

    #[test]
    fn solutions_are_those_of_the_dense_matrix() {
        let joined = [(0, 3), (1, 3), (2, 0), (4, 1), (3, 0), (5, 2), (4, 5)];
        let pattern = Pattern::new(6, joined.into_iter());
        for size in [1, 3, 6] {
            let n = 6 * size;
            let mut system = BlockCholesky::new(&pattern, size);
            let mut dense = DMatrix::<f64>::zeros(n, n);
            let value = |k: usize| ((k * 37 + 11) % 19) as f64 / 19.0 - 0.5;
            for vertex in 0..6 {
                for row in 0..size {
                    for column in 0..size {
                        let far = if row == column { 10.0 * size as f64 } else { 0.0 };
                        let entry = far + value(vertex + row.max(column) * 5 + row.min(column));
                        system.add(Part::Diagonal(vertex), row, column, entry);
                        dense[(vertex * size + row, vertex * size + column)] += entry;
                    }
                }
            }
            for (pair, &(low, high)) in pattern.pairs.iter().enumerate() {
                for row in 0..size {
                    for column in 0..size {
                        let entry = value(pair * 7 + row * 3 + column);
                        system.add(Part::Below(pair), row, column, entry);
                        let (a, b) = (high as usize * size + row, low as usize * size + column);
                        dense[(a, b)] += entry;
                        dense[(b, a)] += entry;
                    }
                }
            }
            assert!(system.factorize());
            let mut columns: Vec<f64> = (0..5 * n).map(value).collect();
            let right = columns.clone();
            system.solve(&mut columns);
            for (x, right) in columns.chunks(n).zip(right.chunks(n)) {
                let gap: DVector<f64> =
                    &dense * DVector::from_column_slice(x) - DVector::from_column_slice(right);
                assert!(gap.amax() < 1e-10, "{size} rows: {}", gap.amax());
            }
            for vertex in 0..6 {
                system.add(Part::Diagonal(vertex), 0, 0, -100.0 * size as f64);
            }
            assert!(!system.factorize());
        }
    }
}
