//! Steps from the factor, no further down than they change.

use super::tree::CliqueTree;
use crate::linear::dot;

impl<const D: usize> CliqueTree<D> {
    /// Solves from the roots down; returns the variables whose steps changed.
    ///
    /// A clique that was not made in the last change is left alone, with all beneath it, where no
    /// step of its separator changed. The steps of a clique are left as they are where changing them
    /// lowers the cost by at most `least`: by `‖Lᵀ Δ‖²` with its diagonal block `L` of the factor. They
    /// are held against where they should be every time, so that what is dropped does not add up
    /// (wildfire, Kaess et al. 2012, by cost instead of by length).
    pub(crate) fn solve(&mut self, least: f64, changed: &mut Vec<usize>) {
        changed.clear();
        let mut work = std::mem::take(&mut self.work);
        for &slot in &self.made {
            self.cliques[slot].marked = true;
        }
        work.stack.clear();
        work.stack.extend(self.roots.iter().rev());
        while let Some(at) = work.stack.pop() {
            let clique = &mut self.cliques[at];
            let made = std::mem::take(&mut clique.marked);
            if !made && !clique.separator.iter().any(|&variable| work.moved[variable]) {
                continue;
            }
            let clique = &self.cliques[at];
            let width = clique.frontals.len() * D;
            let rows = width + clique.separator.len() * D;
            let x = &mut work.numbers;
            x.clear();
            x.extend_from_slice(&clique.rhs);
            for &variable in &clique.separator {
                x.extend_from_slice(self.steps[variable].as_slice());
            }
            for column in (0..width).rev() {
                let numbers = &clique.factor[column * rows..(column + 1) * rows];
                let known = dot(&numbers[column + 1..], &x[column + 1..]);
                x[column] = (x[column] - known) / numbers[column];
            }
            let old = &mut work.change;
            old.clear();
            for variable in &clique.frontals {
                old.extend_from_slice(self.steps[*variable].as_slice());
            }
            if gain(old, &x[..width], &clique.factor, rows) > least {
                for (variable, x) in clique.frontals.iter().zip(x.chunks_exact(D)) {
                    self.steps[*variable].copy_from_slice(x);
                    work.moved[*variable] = true;
                    changed.push(*variable);
                }
            }
            // Cliques made in this change may hang beneath one whose steps stay.
            work.stack.extend(clique.children.iter().rev());
        }
        for &variable in &*changed {
            work.moved[variable] = false;
        }
        self.made.clear();
        self.work = work;
    }
}

/// By how much the cost of a clique's columns falls from old steps to the solution; leaves the change
/// in `old`.
fn gain(old: &mut [f64], solution: &[f64], factor: &[f64], rows: usize) -> f64 {
    for (old, new) in old.iter_mut().zip(solution) {
        *old -= new;
    }
    let width = old.len();
    let share = |column: usize| {
        dot(&factor[column * rows + column..column * rows + width], &old[column..]).powi(2)
    };
    (0..width).map(share).sum()
}
