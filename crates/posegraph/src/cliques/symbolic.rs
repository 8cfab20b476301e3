//! Which cliques come of an elimination order.

use std::ops::Range;

use super::order::order;
use super::tree::{CliqueTree, HELD, Term};

/// A column joins the clique beneath it where that then stores at most this many zeros, in blocks ...
const ZEROS: usize = 8;

/// ... or at most this share of the clique, in percent. All zeros count that joining has brought: of
/// the last column alone a chain would become one clique, and dense.
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
    /// Rows of separators, and the group of each column.
    pub rows: Vec<usize>,
    pub owner: Vec<usize>,
    /// Row of each variable in the clique that is being eliminated, or [`HELD`].
    pub row: Vec<usize>,
    /// Whether the step of a variable changed in the last solve.
    pub moved: Vec<bool>,
    pub stack: Vec<usize>,
    pub numbers: Vec<f64>,
    pub change: Vec<f64>,
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
        let groups = group_columns(&mut work);
        // Children end before their parents do.
        let mut slots = vec![HELD; groups.len()];
        let mut by_end = vec![HELD; count];
        for (group, found) in groups.iter().enumerate() {
            by_end[found.end] = group;
        }
        self.made.clear();
        for &group in by_end.iter().filter(|group| **group != HELD) {
            let slot = self.fresh();
            slots[group] = slot;
            self.made.push(slot);
            let rows = &work.rows[groups[group].separator.clone()];
            let separator = rows.iter().map(|&row| work.vars[work.order[row]]);
            self.cliques[slot].separator.extend(separator);
        }
        for (column, &group) in work.owner.iter().enumerate() {
            let variable = work.vars[work.order[column]];
            self.cliques[slots[group]].frontals.push(variable);
            self.clique_of[variable] = slots[group];
        }
        for at in 0..self.made.len() {
            // The separator stands in elimination order.
            let first = self.cliques[self.made[at]].separator.first().copied();
            self.hang(self.made[at], first);
        }
        for at in 0..self.orphans.len() {
            let place = |variable: &usize| work.position[work.local[*variable]];
            let separator = &self.cliques[self.orphans[at]].separator;
            let first = separator.iter().copied().min_by_key(place);
            self.hang(self.orphans[at], first);
        }
        for &variable in &work.vars {
            work.local[variable] = HELD;
        }
        self.work = work;
    }

    /// Hangs a clique beneath that of the first variable of its separator.
    fn hang(&mut self, clique: usize, first: Option<usize>) {
        match first.map(|variable| self.clique_of[variable]) {
            Some(parent) => {
                self.cliques[clique].parent = parent;
                self.cliques[parent].children.push(clique);
            }
            None => self.roots.push(clique),
        }
    }
}

/// Columns that will be a clique.
struct Group {
    width: usize,
    /// Blocks that it stores only for its columns to be together.
    zeros: usize,
    /// The last of its columns.
    end: usize,
    /// Rows of the separator, ascending, as a range of `work.rows`.
    separator: Range<usize>,
    /// The next group whose parent is the same column, or [`HELD`].
    next: usize,
}

/// Gathers columns of the factor into groups; `work.owner` tells the group of each column.
fn group_columns(work: &mut Workspace) -> Vec<Group> {
    let count = work.order.len();
    let mut groups: Vec<Group> = Vec::new();
    // The first group whose parent is the column.
    let mut beneath = vec![HELD; count];
    work.seen.fill(HELD);
    work.rows.clear();
    work.owner.clear();
    for column in 0..count {
        let start = work.rows.len();
        work.seen[column] = column;
        let local = work.order[column];
        for &other in &work.neighbours[work.starts[local]..work.starts[local + 1]] {
            let row = work.position[other];
            if row > column && work.seen[row] != column {
                work.seen[row] = column;
                work.rows.push(row);
            }
        }
        let mut child = beneath[column];
        let mut longest = HELD;
        while child != HELD {
            for at in groups[child].separator.clone() {
                let row = work.rows[at];
                if work.seen[row] != column {
                    work.seen[row] = column;
                    work.rows.push(row);
                }
            }
            if longest == HELD || groups[child].separator.len() > groups[longest].separator.len() {
                longest = child;
            }
            child = groups[child].next;
        }
        work.rows[start..].sort_unstable();
        let separator = start..work.rows.len();
        let zeros = if longest == HELD {
            0
        } else {
            let Group { width, zeros, separator: before, .. } = &groups[longest];
            zeros + width * (separator.len() + 1 - before.len())
        };
        let joined = longest != HELD && {
            let width = groups[longest].width + 1;
            let stored = width * (width + 1) / 2 + width * separator.len();
            zeros <= ZEROS || zeros * 100 <= ZEROS_PERCENT * stored
        };
        let group = if joined { longest } else { groups.len() };
        let next = match work.rows.get(start) {
            Some(&parent) => std::mem::replace(&mut beneath[parent], group),
            None => HELD,
        };
        if joined {
            let width = groups[group].width + 1;
            groups[group] = Group { width, zeros, end: column, separator, next };
        } else {
            groups.push(Group { width: 1, zeros: 0, end: column, separator, next });
        }
        work.owner.push(group);
    }
    groups
}
