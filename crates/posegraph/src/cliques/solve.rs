//! Steps from the factor, no further down than they change.

use super::tree::CliqueTree;

impl<const D: usize> CliqueTree<D> {
    /// Solves from the roots down; returns the variables whose steps changed.
    ///
    /// A clique that was not made in the last change is left alone, with all beneath it, where no
    /// step of its separator changed. A change of at most `threshold` in every entry of a clique is
    /// dropped, so that what is dropped does not add up (wildfire, Kaess et al. 2012).
    pub(crate) fn solve(&mut self, threshold: f64, changed: &mut Vec<usize>) {
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
            let mut largest = 0.0f64;
            for (variable, x) in clique.frontals.iter().zip(x.chunks_exact(D)) {
                for (old, new) in self.steps[*variable].iter().zip(x) {
                    largest = largest.max((old - new).abs());
                }
            }
            if largest > threshold {
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

/// The inner product, summed in eight strands.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
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
