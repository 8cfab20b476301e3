//! The dense kernel: some columns of a symmetric matrix eliminated.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{BlockStructure, matmul as triangular_matmul};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};

/// Columns that are eliminated one by one before the rest is updated at once.
const PANEL: usize = 48;

/// From this many multiplications on faer's kernels are faster.
const LARGE: usize = 8_000;

/// From this many columns on they are faster for the panel too.
const WIDE: usize = 12;

/// A pivot below this share of what stood on the diagonal is rounding.
const ROUNDING: f64 = 1e-14;

/// Eliminates the first `width` of `width + rest` columns; returns the directions left undetermined.
///
/// `factor` holds the first columns, all rows; `update` the lower triangle of the others. A direction
/// with a pivot that is not positive is held: its column becomes that of the identity.
pub(super) fn eliminate_panel(
    width: usize,
    rest: usize,
    factor: &mut [f64],
    rhs: &mut [f64],
    update: &mut [f64],
    update_rhs: &mut [f64],
) -> usize {
    let rows = width + rest;
    let mut undetermined = 0;
    let diagonal: Vec<f64> = (0..width).map(|k| factor[k * rows + k]).collect();
    for start in (0..width).step_by(PANEL) {
        let end = (start + PANEL).min(width);
        if end - start >= WIDE && dense_columns(start, end, rows, factor, &diagonal) {
            forward(start, end, rows, factor, rhs, update_rhs);
        } else {
            undetermined += columns(start, end, rows, factor, rhs, update_rhs, &diagonal);
        }
        trailing_columns(start, end, width, rows, factor);
    }
    if rest > 0 {
        trailing(width, rest, factor, update);
    }
    undetermined
}

/// Eliminates columns `start..end` with dense kernels, the right-hand side left alone; `false`, and
/// nothing done, where a pivot is not positive.
fn dense_columns(
    start: usize,
    end: usize,
    rows: usize,
    factor: &mut [f64],
    diagonal: &[f64],
) -> bool {
    let size = end - start;
    let panel = &mut factor[start * rows..end * rows];
    let mut top: Vec<f64> = Vec::with_capacity(size * size);
    for column in panel.chunks_exact(rows) {
        top.extend_from_slice(&column[start..end]);
    }
    let params = Default::default();
    let scratch = cholesky_in_place_scratch::<f64>(size, Par::Seq, params);
    let result = cholesky_in_place(
        MatMut::from_column_major_slice_mut(&mut top, size, size),
        Default::default(),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        params,
    );
    let sound = |k: usize| top[k * size + k].powi(2) > ROUNDING * diagonal[start + k];
    if result.is_err() || !(0..size).all(sound) {
        return false;
    }
    for (column, top) in panel.chunks_exact_mut(rows).zip(top.chunks_exact(size)) {
        column[start..end].copy_from_slice(top);
    }
    let below = MatMut::from_column_major_slice_mut(panel, rows, size)
        .submatrix_mut(end, 0, rows - end, size)
        .transpose_mut();
    let top = MatRef::from_column_major_slice(&top, size, size);
    solve_lower_triangular_in_place(top, below, Par::Seq);
    true
}

/// Solves the right-hand side forward through columns `start..end`.
fn forward(
    start: usize,
    end: usize,
    rows: usize,
    factor: &[f64],
    rhs: &mut [f64],
    update_rhs: &mut [f64],
) {
    let width = rhs.len();
    for column in start..end {
        let this = &factor[column * rows..(column + 1) * rows];
        let solved = rhs[column] / this[column];
        rhs[column] = solved;
        subtract(&mut rhs[column + 1..], &this[column + 1..width], solved);
        subtract(update_rhs, &this[width..], solved);
    }
}

/// Takes a multiple of one row of numbers off another.
#[inline]
fn subtract(target: &mut [f64], numbers: &[f64], share: f64) {
    for (target, &number) in target.iter_mut().zip(numbers) {
        *target -= share * number;
    }
}

/// Eliminates columns `start..end`, whose earlier columns have been taken off them.
fn columns(
    start: usize,
    end: usize,
    rows: usize,
    factor: &mut [f64],
    rhs: &mut [f64],
    update_rhs: &mut [f64],
    diagonal: &[f64],
) -> usize {
    let mut undetermined = 0;
    for column in start..end {
        let (before, after) = factor.split_at_mut((column + 1) * rows);
        let this = &mut before[column * rows..];
        let pivot = this[column];
        if pivot > ROUNDING * diagonal[column] && pivot.is_finite() {
            let root = pivot.sqrt();
            let inverse = 1.0 / root;
            this[column] = root;
            for number in &mut this[column + 1..] {
                *number *= inverse;
            }
            rhs[column] *= inverse;
        } else {
            undetermined += 1;
            this[column] = 1.0;
            this[column + 1..].fill(0.0);
            rhs[column] = 0.0;
        }
        let solved = rhs[column];
        let split = rhs.len();
        subtract(&mut rhs[column + 1..], &this[column + 1..split], solved);
        subtract(update_rhs, &this[split..], solved);
        for (other, target) in after.chunks_exact_mut(rows).take(end - column - 1).enumerate() {
            let row = column + 1 + other;
            let share = this[row];
            subtract(&mut target[row..], &this[row..], share);
        }
    }
    undetermined
}

/// Takes columns `start..end` off the later ones of the panel.
fn trailing_columns(start: usize, end: usize, width: usize, rows: usize, factor: &mut [f64]) {
    if end == width {
        return;
    }
    let (done, later) = factor.split_at_mut(end * rows);
    let done = MatRef::from_column_major_slice(&done[start * rows..], rows, end - start).submatrix(
        end,
        0,
        rows - end,
        end - start,
    );
    let later = MatMut::from_column_major_slice_mut(later, rows, width - end).submatrix_mut(
        end,
        0,
        rows - end,
        width - end,
    );
    let top = done.submatrix(0, 0, width - end, end - start);
    matmul(later, Accum::Add, done, top.transpose(), -1.0, Par::Seq);
}

/// Takes all columns of the panel off the update.
fn trailing(width: usize, rest: usize, factor: &[f64], update: &mut [f64]) {
    let rows = width + rest;
    if width * rest * rest / 2 >= LARGE {
        let below =
            MatRef::from_column_major_slice(factor, rows, width).submatrix(width, 0, rest, width);
        triangular_matmul(
            MatMut::from_column_major_slice_mut(update, rest, rest),
            BlockStructure::TriangularLower,
            Accum::Add,
            below,
            BlockStructure::Rectangular,
            below.transpose(),
            BlockStructure::Rectangular,
            -1.0,
            Par::Seq,
        );
        return;
    }
    let mut column = 0;
    while column < width {
        let take = (width - column).min(3);
        let part = |k: usize| &factor[(column + k) * rows + width..(column + k + 1) * rows];
        match take {
            3 => {
                let (a, b, c) = (part(0), part(1), part(2));
                for (at, target) in update.chunks_exact_mut(rest).enumerate() {
                    let (x, y, z) = (a[at], b[at], c[at]);
                    let below = a[at..].iter().zip(&b[at..]).zip(&c[at..]);
                    for (target, ((a, b), c)) in target[at..].iter_mut().zip(below) {
                        *target -= x * a + y * b + z * c;
                    }
                }
            }
            _ => {
                for k in 0..take {
                    let a = part(k);
                    for (at, target) in update.chunks_exact_mut(rest).enumerate() {
                        let x = a[at];
                        for (target, a) in target[at..].iter_mut().zip(&a[at..]) {
                            *target -= x * a;
                        }
                    }
                }
            }
        }
        column += take;
    }
}
