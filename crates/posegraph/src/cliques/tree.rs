//! The tree, and how its top comes off.

use pose::nalgebra::SVector;

use super::symbolic::Workspace;
use crate::factors::NormalBlocks;

/// Stands for a vertex that is held and for a clique that is not there.
pub(crate) const HELD: usize = usize::MAX;

/// What a factor adds to the normal equations, and to which variables.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term<const D: usize> {
    /// The variable it starts from, or [`HELD`].
    pub from: usize,
    /// The variable it leads to, or [`HELD`].
    pub to: usize,
    /// Its blocks at the last linearisation.
    pub blocks: NormalBlocks<D>,
}

/// Variables that are eliminated together, and their share of the factor.
#[derive(Clone, Debug, Default)]
pub(super) struct Clique {
    /// Its variables in elimination order.
    pub frontals: Vec<usize>,
    /// Variables eliminated later that they meet.
    pub separator: Vec<usize>,
    /// The clique above, or [`HELD`].
    pub parent: usize,
    pub children: Vec<usize>,
    /// Columns of the factor, one after the other: rows of frontals, then of the separator. What is
    /// above the diagonal means nothing.
    pub factor: Vec<f64>,
    /// Forward-solved right-hand side of the frontals.
    pub rhs: Vec<f64>,
    /// Lower triangle, by columns, of what it adds to the matrix of its separator.
    pub update: Vec<f64>,
    /// What it adds to the right-hand side of its separator.
    pub update_rhs: Vec<f64>,
    /// Directions that nothing determines: their step is 0.
    pub undetermined: usize,
    /// Whether it is coming off.
    pub marked: bool,
}

impl Clique {
    /// Empties it for another use; memory stays.
    fn clear(&mut self) {
        self.frontals.clear();
        self.separator.clear();
        self.children.clear();
        self.parent = HELD;
        self.undetermined = 0;
        self.marked = false;
    }
}

/// A Cholesky factor as a tree of cliques.
#[derive(Clone, Debug, Default)]
pub(crate) struct CliqueTree<const D: usize> {
    pub(super) cliques: Vec<Clique>,
    free: Vec<usize>,
    pub(super) roots: Vec<usize>,
    /// The clique in which each variable is a frontal, or [`HELD`].
    pub(super) clique_of: Vec<usize>,
    /// The solution of the normal equations, by variable.
    pub(super) steps: Vec<SVector<f64, D>>,
    /// Variables that came loose in this change, and the subtrees beneath them.
    pub(super) loose: Vec<usize>,
    pub(super) orphans: Vec<usize>,
    pub(super) work: Workspace,
    /// Columns of cliques that were made in the last change, parents after children.
    pub(super) made: Vec<usize>,
    /// Stored numbers of the factor.
    pub(super) fill: usize,
}

impl<const D: usize> CliqueTree<D> {
    /// Makes room for vertices `0..count`; new ones are held until a change names them.
    pub(crate) fn grow(&mut self, count: usize) {
        self.clique_of.resize(count, HELD);
        self.steps.resize(count, SVector::zeros());
        self.work.grow(count);
    }

    /// The step of a variable; 0 where it is held.
    pub(crate) fn step(&self, variable: usize) -> &SVector<f64, D> {
        &self.steps[variable]
    }

    /// Forgets the step of a variable whose pose has taken it; a change must name the variable.
    pub(crate) fn reset_step(&mut self, variable: usize) {
        self.steps[variable] = SVector::zeros();
    }

    /// Whether a vertex has columns in the factor.
    pub(crate) fn has(&self, variable: usize) -> bool {
        self.clique_of[variable] != HELD
    }

    /// Stored numbers of the factor.
    pub(crate) fn fill(&self) -> usize {
        self.fill
    }

    /// Directions that nothing determines.
    pub(crate) fn undetermined(&self) -> usize {
        self.cliques.iter().map(|clique| clique.undetermined).sum()
    }

    /// By how much the steps lower `χ²` of the linear models: the square of the forward-solved
    /// right-hand side.
    pub(crate) fn explained(&self) -> f64 {
        let used = self.cliques.iter().filter(|clique| !clique.frontals.is_empty());
        used.flat_map(|clique| &clique.rhs).map(|number| number * number).sum()
    }

    /// Takes a change in: `touched` are the variables of every term that is new, gone or has other
    /// numbers, and those that were or become free or held; `recent` are to be eliminated last.
    ///
    /// `terms_of` lists the terms of each vertex; `is_free` says which vertices are variables now.
    /// Returns how many variables were eliminated anew.
    pub(crate) fn change(
        &mut self,
        touched: &[usize],
        recent: &[usize],
        terms: &[Term<D>],
        terms_of: &[Vec<usize>],
        is_free: impl Fn(usize) -> bool,
    ) -> usize {
        self.detach(touched, is_free);
        self.arrange(recent, terms, terms_of);
        for at in 0..self.made.len() {
            self.eliminate(self.made[at], terms, terms_of);
        }
        self.loose.len()
    }

    /// Takes off the cliques of these variables and all above them.
    fn detach(&mut self, touched: &[usize], is_free: impl Fn(usize) -> bool) {
        self.loose.clear();
        self.orphans.clear();
        let mut gone = std::mem::take(&mut self.work.gone);
        for &variable in touched {
            let mut at = self.clique_of[variable];
            if at == HELD {
                self.loose.push(variable);
            }
            while at != HELD && !self.cliques[at].marked {
                self.cliques[at].marked = true;
                gone.push(at);
                at = self.cliques[at].parent;
            }
        }
        for &clique in &gone {
            for &variable in &self.cliques[clique].frontals {
                self.clique_of[variable] = HELD;
                self.loose.push(variable);
            }
            for &child in &self.cliques[clique].children {
                if !self.cliques[child].marked {
                    self.orphans.push(child);
                }
            }
        }
        if !gone.is_empty() {
            self.roots.retain(|&root| !self.cliques[root].marked);
        }
        for clique in gone.drain(..) {
            self.fill -= self.cliques[clique].factor.len();
            self.cliques[clique].clear();
            self.free.push(clique);
        }
        self.work.gone = gone;
        for &orphan in &self.orphans {
            self.cliques[orphan].parent = HELD;
        }
        let steps = &mut self.steps;
        self.loose.retain(|&variable| {
            let free = is_free(variable);
            if !free {
                steps[variable] = SVector::zeros();
            }
            free
        });
        self.loose.sort_unstable();
        self.loose.dedup();
    }

    /// An empty clique.
    pub(super) fn fresh(&mut self) -> usize {
        if let Some(at) = self.free.pop() {
            return at;
        }
        self.cliques.push(Clique { parent: HELD, ..Clique::default() });
        self.cliques.len() - 1
    }
}
