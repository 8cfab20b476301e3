//! From poses to the numbers of the normal equations.
//!
//! Factors are taken in batches. What each adds is worked out first, by as many threads as asked
//! for; then it is added in the order of the factors, by one. So the bits are the same for every
//! number of threads.

use std::thread;

use pose::nalgebra::{SMatrix, SVector};

use super::{HELD, Problem, Target};
use crate::factors::{Manifold, NormalBlocks};
use crate::linear::Slot;
use crate::solvers::Loss;

/// Factors worked out at a time by one thread alone: they stay in its cache.
const BATCH_ALONE: usize = 64;

/// Factors worked out at a time by each of several threads: enough to be worth starting them.
const BATCH_EACH: usize = 2048;

/// What one factor adds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<const D: usize> {
    chi2: f64,
    cost: f64,
    weight: f64,
    blocks: NormalBlocks<D>,
}

impl<P: Manifold<D>, const D: usize> Problem<'_, P, D> {
    /// Linearises at these poses; returns the cost there, with losses and weights.
    pub(crate) fn linearize(&mut self, poses: &[P]) -> f64 {
        self.expand(poses, false)
    }

    /// Linearises, and adds the second derivatives that this leaves out where they are known and
    /// factors have no loss: the matrix is then that of Newton's method, and may be indefinite.
    pub(crate) fn expand(&mut self, poses: &[P], second_order: bool) -> f64 {
        self.matrix.fill(0.0);
        self.gradient.fill(0.0);
        let count = self.factors.len();
        let each = if self.threads > 1 { BATCH_EACH } else { BATCH_ALONE };
        let mut parts = std::mem::take(&mut self.parts);
        parts.resize((each * self.threads).min(count), None);
        let mut cost = 0.0;
        let mut first = 0;
        while first < count {
            let batch = parts.len().min(count - first);
            let parts = &mut parts[..batch];
            if batch > each {
                let this = &*self;
                thread::scope(|scope| {
                    for (chunk, parts) in parts.chunks_mut(each).enumerate() {
                        let first = first + chunk * each;
                        scope.spawn(move || this.work_out(first, parts, poses, second_order));
                    }
                });
            } else {
                self.work_out(first, parts, poses, second_order);
            }
            for (index, part) in parts.iter().enumerate() {
                if let Some(part) = part {
                    cost += part.cost;
                    self.add(first + index, part);
                }
            }
            first += batch;
        }
        self.parts = parts;
        for (diagonal, slot) in self.diagonal.chunks_exact_mut(D).zip(&self.diagonals) {
            for (k, entry) in diagonal.iter_mut().enumerate() {
                *entry = self.matrix[slot.start + k * (slot.stride + 1)];
            }
        }
        cost
    }

    /// Works out what the factors from `first` on add; `None` for those that are left out.
    fn work_out(
        &self,
        first: usize,
        parts: &mut [Option<Part<D>>],
        poses: &[P],
        second_order: bool,
    ) {
        for (index, part) in (first..).zip(parts) {
            let given = self.given[index];
            if given == 0.0 && self.is_left_out(index) {
                *part = None;
                continue;
            }
            let factor = &self.factors[index];
            let (from, to) = (&poses[factor.from], &poses[factor.to]);
            let linear = P::linearize(self.kind, &factor.from_from_to, from, to);
            let chi2 = linear.error.dot(&(factor.information * linear.error));
            let loss = self.loss_of(factor);
            let mut blocks = P::normal_blocks(&linear, &factor.information);
            if second_order
                && loss == Loss::None
                && let Some(curvature) = P::curvature(self.kind, &linear, &factor.information)
            {
                curvature.add_to(&mut blocks, &to.between(from).adjoint());
            }
            let (cost, weight) = (given * loss.cost(chi2), given * loss.weight(chi2));
            *part = Some(Part { chi2, cost, weight, blocks });
        }
    }

    /// Adds what a factor adds.
    fn add(&mut self, index: usize, part: &Part<D>) {
        let Part { chi2, weight, blocks, .. } = part;
        self.factor_chi2[index] = *chi2;
        self.weights[index] = *weight;
        if *weight == 0.0 {
            return;
        }
        let Target { from, to, between } = self.targets[index];
        if from != HELD {
            add(&mut self.matrix, self.diagonals[from], *weight, &blocks.from_from);
            add_vector(&mut self.gradient, from, *weight, &blocks.gradient_from);
        }
        if to != HELD {
            add(&mut self.matrix, self.diagonals[to], *weight, &blocks.to_to);
            add_vector(&mut self.gradient, to, *weight, &blocks.gradient_to);
        }
        if from != HELD && to != HELD {
            if to > from {
                add(&mut self.matrix, between, *weight, &blocks.to_from);
            } else {
                add(&mut self.matrix, between, *weight, &blocks.to_from.transpose());
            }
        }
    }
}

#[inline]
fn add<const D: usize>(matrix: &mut [f64], slot: Slot, weight: f64, block: &SMatrix<f64, D, D>) {
    for column in 0..D {
        let start = slot.start + column * slot.stride;
        for (entry, part) in matrix[start..start + D].iter_mut().zip(block.column(column).iter()) {
            *entry += weight * part;
        }
    }
}

#[inline]
fn add_vector<const D: usize>(
    gradient: &mut [f64],
    position: usize,
    weight: f64,
    part: &SVector<f64, D>,
) {
    for (entry, part) in gradient[position * D..(position + 1) * D].iter_mut().zip(part.iter()) {
        *entry += weight * part;
    }
}
