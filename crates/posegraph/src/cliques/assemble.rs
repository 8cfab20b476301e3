//! The front of a clique: its terms and the updates of its children, added up and eliminated.

use pose::nalgebra::{SMatrix, SVector};

use super::front::eliminate_panel;
use super::tree::{Clique, CliqueTree, HELD, Term};

impl<const D: usize> CliqueTree<D> {
    /// Fills in the numbers of a clique whose children are done.
    pub(super) fn eliminate(&mut self, at: usize, terms: &[Term<D>], terms_of: &[Vec<usize>]) {
        let mut clique = std::mem::take(&mut self.cliques[at]);
        let (width, rest) = (clique.frontals.len(), clique.separator.len());
        let row = &mut self.work.row;
        for (place, &variable) in clique.frontals.iter().chain(&clique.separator).enumerate() {
            row[variable] = place;
        }
        zero(&mut clique.factor, (width + rest) * D * width * D);
        zero(&mut clique.rhs, width * D);
        zero(&mut clique.update, rest * D * rest * D);
        zero(&mut clique.update_rhs, rest * D);
        {
            let mut front = Front::<D>::new(&mut clique);
            for place in 0..width {
                let variable = front.frontals[place];
                for &term in &terms_of[variable] {
                    front.add_term(&terms[term], variable, row);
                }
            }
            for child in 0..front.children.len() {
                front.add_child(&self.cliques[front.children[child]], row);
            }
        }
        for variable in clique.frontals.iter().chain(&clique.separator) {
            row[*variable] = HELD;
        }
        clique.undetermined = eliminate_panel(
            width * D,
            rest * D,
            &mut clique.factor,
            &mut clique.rhs,
            &mut clique.update,
            &mut clique.update_rhs,
        );
        self.fill += clique.factor.len();
        self.cliques[at] = clique;
    }
}

fn zero(numbers: &mut Vec<f64>, len: usize) {
    numbers.clear();
    numbers.resize(len, 0.0);
}

/// A clique as a dense matrix, lower triangle of blocks, in two parts.
struct Front<'a, const D: usize> {
    frontals: &'a [usize],
    children: &'a [usize],
    width: usize,
    rest: usize,
    factor: &'a mut [f64],
    rhs: &'a mut [f64],
    update: &'a mut [f64],
    update_rhs: &'a mut [f64],
}

impl<'a, const D: usize> Front<'a, D> {
    fn new(clique: &'a mut Clique) -> Self {
        Self {
            width: clique.frontals.len(),
            rest: clique.separator.len(),
            frontals: &clique.frontals,
            children: &clique.children,
            factor: &mut clique.factor,
            rhs: &mut clique.rhs,
            update: &mut clique.update,
            update_rhs: &mut clique.update_rhs,
        }
    }

    /// Adds a term of a frontal, unless a clique beneath has had it or it was added from its start.
    fn add_term(&mut self, term: &Term<D>, variable: usize, row: &[usize]) {
        let place = |variable: usize| if variable == HELD { HELD } else { row[variable] };
        let (from, to) = (place(term.from), place(term.to));
        let (mine, other) = if term.from == variable { (from, to) } else { (to, from) };
        let other_vertex = if term.from == variable { term.to } else { term.from };
        if other == HELD && other_vertex != HELD {
            return;
        }
        if other < self.width && mine == to {
            return;
        }
        let blocks = &term.blocks;
        if from != HELD {
            self.add_block(from, from, &blocks.from_from);
            self.subtract_rhs(from, &blocks.gradient_from);
        }
        if to != HELD {
            self.add_block(to, to, &blocks.to_to);
            self.subtract_rhs(to, &blocks.gradient_to);
        }
        if from != HELD && to != HELD {
            if to > from {
                self.add_block(to, from, &blocks.to_from);
            } else {
                self.add_block(from, to, &blocks.to_from.transpose());
            }
        }
    }

    /// Adds a block at `row >= column`.
    #[inline]
    fn add_block(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        let (numbers, start, stride) = if column < self.width {
            let stride = (self.width + self.rest) * D;
            (&mut *self.factor, column * D * stride + row * D, stride)
        } else {
            let (row, column) = (row - self.width, column - self.width);
            let stride = self.rest * D;
            (&mut *self.update, column * D * stride + row * D, stride)
        };
        for k in 0..D {
            let target = &mut numbers[start + k * stride..start + k * stride + D];
            for (l, number) in target.iter_mut().enumerate() {
                *number += block[(l, k)];
            }
        }
    }

    #[inline]
    fn subtract_rhs(&mut self, row: usize, gradient: &SVector<f64, D>) {
        for k in 0..D {
            *self.rhs_at(row * D + k) -= gradient[k];
        }
    }

    #[inline]
    fn rhs_at(&mut self, at: usize) -> &mut f64 {
        let split = self.width * D;
        if at < split { &mut self.rhs[at] } else { &mut self.update_rhs[at - split] }
    }

    /// Adds the update of a child.
    fn add_child(&mut self, child: &Clique, row: &[usize]) {
        let rest = child.separator.len();
        let stride = rest * D;
        for (column, &variable) in child.separator.iter().enumerate() {
            let to_column = row[variable];
            for k in 0..D {
                *self.rhs_at(to_column * D + k) += child.update_rhs[column * D + k];
            }
            for (below, &variable) in child.separator.iter().enumerate().skip(column) {
                let to_row = row[variable];
                let start = column * D * stride + below * D;
                let block =
                    SMatrix::<f64, D, D>::from_fn(|l, k| child.update[start + k * stride + l]);
                if to_row >= to_column {
                    self.add_block(to_row, to_column, &block);
                } else {
                    self.add_block(to_column, to_row, &block.transpose());
                }
            }
        }
    }
}
