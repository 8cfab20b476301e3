//! The elimination order.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// The blocks of a symmetric graph in the order in which they are to be eliminated.
///
/// The graph holds the strict upper triangle by columns: `rows[starts[j]..starts[j + 1]]` are the
/// blocks below `j` that meet block `j`, each once. The order is a postorder of the elimination
/// tree.
pub(crate) fn minimum_degree(starts: &[usize], rows: &[usize]) -> Vec<usize> {
    let count = starts.len() - 1;
    let mut order = vec![0; count];
    let mut inverse = vec![0; count];
    let upper = SymbolicSparseColMatRef::new_unsorted_checked(count, count, starts, None, rows);
    let mut memory = MemBuffer::new(amd::order_maybe_unsorted_scratch::<usize>(count, rows.len()));
    let stack = MemStack::new(&mut memory);
    let control = amd::Control::default();
    if amd::order_maybe_unsorted(&mut order, &mut inverse, upper, control, stack).is_err() {
        // Only indices too large for their type are refused; any order is right then.
        return (0..count).collect();
    }
    order
}
