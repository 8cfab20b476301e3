//! Taking a factor back.

use super::{Incremental, Update};
use crate::PoseGraphError;
use crate::factors::Manifold;

impl<P: Manifold<D>, const D: usize> Incremental<P, D> {
    /// Takes a factor back, by its index in the order of adding, and optimises.
    ///
    /// Only the cliques above it are eliminated anew. Where the graph comes apart, the lowest vertex of
    /// the part that lost its anchor is held where it is. Cost beside the elimination: one search over
    /// the graph. Nothing changes on an error: no such factor, or it was withdrawn before.
    pub fn withdraw(&mut self, factor: usize) -> Result<Update, PoseGraphError> {
        let len = self.factors.len();
        if self.withdrawn.get(factor).copied().unwrap_or(true) {
            return Err(PoseGraphError::UnknownFactor { factor, len });
        }
        self.withdrawn[factor] = true;
        self.learn_chi2(factor, 0.0);
        let (from, to) = (self.factors[factor].from, self.factors[factor].to);
        for vertex in [from, to] {
            self.terms_of[vertex].retain(|&index| index != factor);
            self.touched.push(vertex);
        }
        let reached = self.reached_from(from);
        if !reached[to]
            && let Some(held) = self.islands.part(from, &reached)
        {
            // It stays where it is seen now.
            self.linearised[held] = self.pose(held);
            self.tree.reset_step(held);
            let factors = self.terms_of[held].clone();
            for index in factors {
                self.refresh(index);
            }
            self.rename(held);
        }
        let last = self.len().saturating_sub(1);
        Ok(self.descend(&[last]))
    }

    /// Which vertices factors in use lead to from a vertex.
    fn reached_from(&self, vertex: usize) -> Vec<bool> {
        let mut reached = vec![false; self.len()];
        reached[vertex] = true;
        let mut open = vec![vertex];
        while let Some(vertex) = open.pop() {
            for &index in &self.terms_of[vertex] {
                let factor = &self.factors[index];
                let other = if factor.from == vertex { factor.to } else { factor.from };
                if !std::mem::replace(&mut reached[other], true) {
                    open.push(other);
                }
            }
        }
        reached
    }
}
