//! Which factors are no longer what their linear models say.

use super::Incremental;
use crate::factors::{Factor, Manifold};

/// The mean `χ²` of a factor counts as at least this: poses without contradiction have none.
const LEAST_CHI2: f64 = 1e-12;

impl<P: Manifold<D>, const D: usize> Incremental<P, D> {
    /// The mean `χ²` of a factor in use, by the linear models.
    pub(super) fn mean_chi2(&self) -> f64 {
        let chi2 = self.linearised_chi2 - self.tree.explained();
        (chi2 / self.factors.len().max(1) as f64).max(LEAST_CHI2)
    }

    /// Gathers the vertices that are to be linearised anew: those with long steps
    /// ([`relinearise`](super::IncrementalOptions::relinearise)), and those at both ends of factors of
    /// which the linear model leaves out too much ([`bend`](super::IncrementalOptions::bend)).
    ///
    /// Only vertices that moved in the last solve are looked at, and their factors.
    pub(super) fn gather_bent(&mut self, bent: &mut Vec<usize>) {
        bent.clear();
        let longest = self.options.relinearise;
        let limit = self.options.bend * self.mean_chi2();
        for at in 0..self.moved.len() {
            let vertex = self.moved[at];
            let length = self.tree.step(vertex).amax();
            if length > longest {
                bent.push(vertex);
            }
            for place in 0..self.terms_of[vertex].len() {
                let index = self.terms_of[vertex][place];
                if std::mem::replace(&mut self.looked_at[index], true) {
                    continue;
                }
                let factor = self.factors[index];
                let (from, to) = (factor.from, factor.to);
                let length = self.tree.step(from).amax().max(self.tree.step(to).amax());
                // Both ends are taken already, or what is left out is of second order and too small.
                if length > longest || factor.information.trace() * length.powi(4) < limit {
                    continue;
                }
                if self.bend(&factor) > limit {
                    let far = |&end: &usize| self.tree.step(end).amax() > 0.0;
                    bent.extend([from, to].into_iter().filter(far));
                }
            }
        }
        for &vertex in &self.moved {
            for &index in &self.terms_of[vertex] {
                self.looked_at[index] = false;
            }
        }
        bent.sort_unstable();
        bent.dedup();
    }

    /// Takes note of the `χ²` of a factor where it was linearised; 0 where it is gone.
    pub(super) fn learn_chi2(&mut self, index: usize, chi2: f64) {
        self.linearised_chi2 += chi2 - std::mem::replace(&mut self.factor_chi2[index], chi2);
    }

    /// By how much a factor is off its linear model, as `χ²`.
    fn bend(&self, factor: &Factor<P, D>) -> f64 {
        let (from, to) = (factor.from, factor.to);
        let kind = self.options.error;
        let linear =
            P::linearize(kind, &factor.from_from_to, &self.linearised[from], &self.linearised[to]);
        let change = linear.by_from * self.tree.step(from) + linear.by_to * self.tree.step(to);
        let error = P::error(kind, &factor.from_from_to, &self.pose(from), &self.pose(to));
        let gap = error - linear.error - change;
        gap.dot(&(factor.information * gap))
    }
}
