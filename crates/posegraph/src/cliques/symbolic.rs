//! Which cliques come of an elimination order.

use super::order::order;
use super::tree::{CliqueTree, HELD, Term};

/// A column joins the clique beneath it where that stores at most this many zeros, in blocks ...
const ZEROS: usize = 8;

/// ... or at most this share of the clique, in percent.
const ZEROS_PERCENT: usize = 10;

/// Memory that changes reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    /// Cliques that come off.
    pub gone: Vec<usize>,
    /// Loose variables by local index, and back; [`HELD`] for all others.
    pub vars: Vec<usize>,
    pub local: Vec<usize>,
    /// Neighbours of each loose variable, by local index.
    pub starts: Vec<usize>,
    pub neighbours: Vec<usize>,
    pub seen: Vec<usize>,
    /// Orphans of each loose variable.
    pub orphan_starts: Vec<usize>,
    pub orphans_of: Vec<usize>,
    /// Local indices in elimination order, and the place of each in it.
    pub order: Vec<usize>,
    pub position: Vec<usize>,
    /// Row of each variable in the clique that is being eliminated, or [`HELD`].
    pub row: Vec<usize>,
    /// Whether the step of a variable changed in the last solve.
    pub moved: Vec<bool>,
    pub stack: Vec<usize>,
    pub numbers: Vec<f64>,
}

impl Workspace {
    pub fn grow(&mut self, count: usize) {
        self.local.resize(count, HELD);
        self.row.resize(count, HELD);
        self.moved.resize(count, false);
    }
}

impl<const D: usize> CliqueTree<D> {
    /// Makes empty cliques for the loose variables, and gives the orphans their parents.
    pub(super) fn arrange(&mut self, recent: &[usize], terms: &[Term<D>], terms_of: &[Vec<usize>]) {
        let mut work = std::mem::take(&mut self.work);
        order(&mut work, &self.loose, &self.orphans, recent, &self.cliques, terms, terms_of);
        let count = work.order.len();
        work.position.clear();
        work.position.resize(count, 0);
        for (at, &local) in work.order.iter().enumerate() {
            work.position[local] = at;
        }
        work.seen.fill(HELD);
        // The rows below the diagonal of each column, as positions; columns are only kept as the
        // separator of the clique that they end.
        let mut separators: Vec<Vec<usize>> = Vec::new();
        let mut ends: Vec<usize> = Vec::new();
        let mut members: Vec<Vec<usize>> = Vec::new();
        // Cliques whose parent is the column: a linked list.
        let mut first = vec![HELD; count];
        let mut next: Vec<usize> = Vec::new();
        let mut children: Vec<Vec<usize>> = Vec::new();
        for column in 0..count {
            let mut rows = Vec::new();
            work.seen[column] = column;
            let local = work.order[column];
            for &other in &work.neighbours[work.starts[local]..work.starts[local + 1]] {
                let row = work.position[other];
                if row > column && work.seen[row] != column {
                    work.seen[row] = column;
                    rows.push(row);
                }
            }
            let mut beneath = first[column];
            let mut longest = HELD;
            while beneath != HELD {
                for &row in &separators[beneath] {
                    if work.seen[row] != column {
                        work.seen[row] = column;
                        rows.push(row);
                    }
                }
                if longest == HELD || separators[beneath].len() > separators[longest].len() {
                    longest = beneath;
                }
                beneath = next[beneath];
            }
            rows.sort_unstable();
            let joined = longest != HELD && {
                let width = members[longest].len();
                let zeros = width * (rows.len() + 1 - separators[longest].len());
                zeros <= ZEROS || zeros * 100 <= ZEROS_PERCENT * width * (width + rows.len())
            };
            let clique = if joined {
                longest
            } else {
                separators.push(Vec::new());
                ends.push(HELD);
                members.push(Vec::new());
                next.push(HELD);
                children.push(Vec::new());
                separators.len() - 1
            };
            let mut beneath = first[column];
            while beneath != HELD {
                if beneath != clique {
                    children[clique].push(beneath);
                }
                beneath = next[beneath];
            }
            members[clique].push(column);
            ends[clique] = column;
            if let Some(&parent) = rows.first() {
                next[clique] = first[parent];
                first[parent] = clique;
            }
            separators[clique] = rows;
        }
        // Children end before their parents do.
        let mut by_end = vec![HELD; count];
        for (clique, &end) in ends.iter().enumerate() {
            by_end[end] = clique;
        }
        self.made.clear();
        let mut slots = vec![HELD; ends.len()];
        for &clique in by_end.iter().filter(|clique| **clique != HELD) {
            let slot = self.fresh();
            slots[clique] = slot;
            self.made.push(slot);
            let variable = |&column: &usize| work.vars[work.order[column]];
            let made = &mut self.cliques[slot];
            made.frontals.extend(members[clique].iter().map(variable));
            made.separator.extend(separators[clique].iter().map(variable));
            made.children.extend(children[clique].iter().map(|&child| slots[child]));
            for &frontal in &made.frontals {
                self.clique_of[frontal] = slot;
            }
            if separators[clique].is_empty() {
                self.roots.push(slot);
            }
            for at in 0..self.cliques[slot].children.len() {
                let child = self.cliques[slot].children[at];
                self.cliques[child].parent = slot;
            }
        }
        for &orphan in &self.orphans {
            let place = |variable: &usize| work.position[work.local[*variable]];
            let first = self.cliques[orphan].separator.iter().copied().min_by_key(place);
            match first.map(|variable| self.clique_of[variable]) {
                Some(parent) => {
                    self.cliques[orphan].parent = parent;
                    self.cliques[parent].children.push(orphan);
                }
                None => self.roots.push(orphan),
            }
        }
        for &variable in &work.vars {
            work.local[variable] = HELD;
        }
        self.work = work;
    }
}
