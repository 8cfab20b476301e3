//! In which order loose variables are eliminated.

use super::symbolic::Workspace;
use super::tree::{Clique, HELD, Term};
use crate::linear::minimum_degree;

/// Which loose variables meet, and in which order they go.
///
/// Local indices are places in `work.local_vars`. Variables meet where a term joins them, or where
/// they are in the separator of one orphan. Those of `recent` go last, in order: whoever is touched
/// next should be near a root.
pub(super) fn order<const D: usize>(
    work: &mut Workspace,
    loose: &[usize],
    orphans: &[usize],
    recent: &[usize],
    cliques: &[Clique],
    terms: &[Term<D>],
    terms_of: &[Vec<usize>],
) {
    work.vars.clear();
    work.vars.extend(loose.iter().copied().filter(|variable| !recent.contains(variable)));
    let early = work.vars.len();
    work.vars.extend(loose.iter().copied().filter(|variable| recent.contains(variable)));
    for (local, &variable) in work.vars.iter().enumerate() {
        work.local[variable] = local;
    }
    gather_orphans(work, orphans, cliques);
    // Neighbours of each, once; a mark tells who was seen.
    let count = work.vars.len();
    work.starts.clear();
    work.starts.push(0);
    work.neighbours.clear();
    work.seen.clear();
    work.seen.resize(count, HELD);
    for me in 0..count {
        work.seen[me] = me;
        let variable = work.vars[me];
        for &term in &terms_of[variable] {
            let term = &terms[term];
            let other = if term.from == variable { term.to } else { term.from };
            if other == HELD || work.local[other] == HELD {
                continue;
            }
            let other = work.local[other];
            if work.seen[other] != me {
                work.seen[other] = me;
                work.neighbours.push(other);
            }
        }
        for at in work.orphan_starts[me]..work.orphan_starts[me + 1] {
            for &other in &cliques[work.orphans_of[at]].separator {
                let other = work.local[other];
                if work.seen[other] != me {
                    work.seen[other] = me;
                    work.neighbours.push(other);
                }
            }
        }
        work.starts.push(work.neighbours.len());
    }
    // The upper triangle, without those who go last anyway.
    let mut starts = Vec::with_capacity(early + 1);
    let mut rows = Vec::with_capacity(work.neighbours.len() / 2);
    starts.push(0);
    for me in 0..early {
        let mine = &work.neighbours[work.starts[me]..work.starts[me + 1]];
        rows.extend(mine.iter().copied().filter(|&other| other < me));
        starts.push(rows.len());
    }
    work.order = if early > 0 { minimum_degree(&starts, &rows) } else { Vec::new() };
    work.order.extend(early..count);
}

/// Which orphans hold each loose variable in their separators.
fn gather_orphans(work: &mut Workspace, orphans: &[usize], cliques: &[Clique]) {
    let count = work.vars.len();
    work.orphan_starts.clear();
    work.orphan_starts.resize(count + 1, 0);
    for &orphan in orphans {
        for &variable in &cliques[orphan].separator {
            work.orphan_starts[work.local[variable] + 1] += 1;
        }
    }
    for at in 0..count {
        work.orphan_starts[at + 1] += work.orphan_starts[at];
    }
    work.orphans_of.clear();
    work.orphans_of.resize(work.orphan_starts[count], 0);
    let mut next = work.orphan_starts.clone();
    for &orphan in orphans {
        for &variable in &cliques[orphan].separator {
            let local = work.local[variable];
            work.orphans_of[next[local]] = orphan;
            next[local] += 1;
        }
    }
}
