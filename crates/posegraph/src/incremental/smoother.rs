//! The smoother: adding vertices and factors.

use super::islands::Islands;
use super::{IncrementalOptions, Update};
use crate::PoseGraphError;
use crate::cliques::{CliqueTree, HELD, Term};
use crate::factors::{Factor, FactorGraph, Manifold, NormalBlocks, admissible_information};
use crate::solvers::{Options, Report, optimize};

/// A pose graph that grows, its poses optimised after every step.
#[derive(Clone, Debug)]
pub struct Incremental<P, const D: usize> {
    pub(super) options: IncrementalOptions,
    pub(super) tree: CliqueTree<D>,
    /// Where each vertex was linearised last, `map_from_body`.
    pub(super) linearised: Vec<P>,
    pub(super) islands: Islands,
    /// Factors with admissible information, in the order in which they came.
    pub(super) factors: Vec<Factor<P, D>>,
    pub(super) withdrawn: Vec<bool>,
    pub(super) terms: Vec<Term<D>>,
    /// Indices of the factors in use of each vertex.
    pub(super) terms_of: Vec<Vec<usize>>,
    /// Vertices of terms that changed since the last elimination.
    pub(super) touched: Vec<usize>,
    /// Vertices whose steps changed in the last solve.
    pub(super) moved: Vec<usize>,
    bent: Vec<usize>,
    /// `χ²` of each factor where it was linearised last, and the sum.
    pub(super) factor_chi2: Vec<f64>,
    pub(super) linearised_chi2: f64,
    /// Marks of factors, all off between uses.
    pub(super) looked_at: Vec<bool>,
}

impl<P: Manifold<D>, const D: usize> Incremental<P, D> {
    /// A graph without vertices.
    pub fn new(options: IncrementalOptions) -> Self {
        Self {
            options,
            tree: CliqueTree::default(),
            linearised: Vec::new(),
            islands: Islands::default(),
            factors: Vec::new(),
            withdrawn: Vec::new(),
            terms: Vec::new(),
            terms_of: Vec::new(),
            touched: Vec::new(),
            moved: Vec::new(),
            bent: Vec::new(),
            factor_chi2: Vec::new(),
            linearised_chi2: 0.0,
            looked_at: Vec::new(),
        }
    }

    /// Adds the next vertex with factors that join it, or any two before it, and optimises.
    ///
    /// `initial` is `map_from_body`; where it is `None` the vertex is placed by the first factor that
    /// joins it to another, or at the identity. Indices count up from 0 for vertices and factors.
    /// Parts of the graph that hang together with nothing hold their first vertex; when a factor joins
    /// two, the one with the younger first vertex is moved as a whole to where the factor sees it.
    /// Nothing changes on an error: a factor that leads nowhere or is not finite.
    pub fn add(
        &mut self,
        initial: Option<P>,
        factors: &[Factor<P, D>],
    ) -> Result<Update, PoseGraphError> {
        let vertex = self.linearised.len();
        for factor in factors {
            check(factor, vertex + 1)?;
        }
        if initial.is_some_and(|pose| !pose.is_finite()) {
            return Err(PoseGraphError::FactorNotFinite { from: vertex, to: vertex });
        }
        let chained = || {
            factors.iter().find_map(|factor| {
                if factor.to == vertex {
                    Some(self.pose(factor.from).compose(&factor.from_from_to))
                } else if factor.from == vertex {
                    Some(self.pose(factor.to).compose(&factor.from_from_to.inverse()))
                } else {
                    None
                }
            })
        };
        let pose = initial.or_else(chained).unwrap_or_else(P::identity);
        self.linearised.push(pose);
        self.terms_of.push(Vec::new());
        self.islands.push();
        self.tree.grow(vertex + 1);
        for factor in factors {
            self.take(factor);
        }
        Ok(self.descend(&[vertex]))
    }

    /// Adds factors between vertices that are there, and optimises.
    ///
    /// Nothing changes on an error: a factor that leads nowhere or is not finite.
    pub fn add_factors(&mut self, factors: &[Factor<P, D>]) -> Result<Update, PoseGraphError> {
        for factor in factors {
            check(factor, self.linearised.len())?;
        }
        for factor in factors {
            self.take(factor);
        }
        let last = self.linearised.len().saturating_sub(1);
        Ok(self.descend(&[last]))
    }

    /// Takes a factor into the graph, without solving.
    fn take(&mut self, factor: &Factor<P, D>) {
        let mut factor = *factor;
        factor.information = admissible_information(&factor.information);
        let (from, to) = (factor.from, factor.to);
        if !self.islands.together(from, to) {
            self.join(&factor);
        }
        let index = self.factors.len();
        self.factors.push(factor);
        self.withdrawn.push(false);
        self.factor_chi2.push(0.0);
        self.looked_at.push(false);
        let (blocks, chi2) = self.linearisation(&factor);
        self.learn_chi2(index, chi2);
        self.terms.push(Term { from: self.variable(from), to: self.variable(to), blocks });
        self.terms_of[from].push(index);
        self.terms_of[to].push(index);
        self.touched.extend([from, to]);
    }

    /// Joins the islands at both ends of a factor that sees one from the other.
    fn join(&mut self, factor: &Factor<P, D>) {
        let forward = self.islands.is_older(factor.from, factor.to);
        let (older, younger) =
            if forward { (factor.from, factor.to) } else { (factor.to, factor.from) };
        let step = if forward { factor.from_from_to } else { factor.from_from_to.inverse() };
        let joined = self.islands.join(older, younger);
        if joined.newcomers.len() > 1 {
            // Errors and their derivatives by steps on the right stay what they are.
            let seen = self.pose(older).compose(&step);
            let new_from_old = seen.compose(&self.pose(younger).inverse());
            for &vertex in &joined.newcomers {
                self.linearised[vertex] = new_from_old.compose(&self.linearised[vertex]);
            }
        }
        self.rename(joined.freed);
    }

    /// Tells the terms of a vertex that it has become free or held.
    pub(super) fn rename(&mut self, vertex: usize) {
        let name = self.variable(vertex);
        self.touched.push(vertex);
        for &index in &self.terms_of[vertex] {
            let factor = &self.factors[index];
            let other = if factor.from == vertex {
                self.terms[index].from = name;
                factor.to
            } else {
                self.terms[index].to = name;
                factor.from
            };
            self.touched.push(other);
        }
    }

    /// A vertex as a variable, [`HELD`] where it is none.
    fn variable(&self, vertex: usize) -> usize {
        if self.islands.is_held(vertex) { HELD } else { vertex }
    }

    /// What a factor adds, and its `χ²`, where its poses were linearised last.
    fn linearisation(&self, factor: &Factor<P, D>) -> (NormalBlocks<D>, f64) {
        let (from, to) = (&self.linearised[factor.from], &self.linearised[factor.to]);
        let linear = P::linearize(self.options.error, &factor.from_from_to, from, to);
        let chi2 = linear.error.dot(&(factor.information * linear.error));
        (P::normal_blocks(&linear, &factor.information), chi2)
    }

    /// Gauss-Newton iterations from what changed until linear models hold.
    pub(super) fn descend(&mut self, recent: &[usize]) -> Update {
        let mut update = Update::default();
        let mut bent = std::mem::take(&mut self.bent);
        loop {
            self.gather_bent(&mut bent);
            if update.iterations > 0 && bent.is_empty() {
                break;
            }
            self.relinearise(&bent);
            update.relinearised += bent.len();
            update.refactored += self.eliminate(recent);
            let least = self.options.propagate * self.mean_chi2();
            self.tree.solve(least, &mut self.moved);
            update.solved += self.moved.len();
            update.iterations += 1;
            if update.iterations >= self.options.iterations {
                break;
            }
        }
        self.bent = bent;
        update
    }

    /// Moves these vertices by their steps and works out their factors anew.
    fn relinearise(&mut self, vertices: &[usize]) {
        for &vertex in vertices {
            self.linearised[vertex] = self.pose(vertex);
            self.tree.reset_step(vertex);
        }
        for &vertex in vertices {
            for at in 0..self.terms_of[vertex].len() {
                self.refresh(self.terms_of[vertex][at]);
            }
        }
    }

    /// Works out a factor anew.
    pub(super) fn refresh(&mut self, index: usize) {
        let factor = self.factors[index];
        let (blocks, chi2) = self.linearisation(&factor);
        self.terms[index].blocks = blocks;
        self.learn_chi2(index, chi2);
        self.touched.extend([factor.from, factor.to]);
    }

    fn eliminate(&mut self, recent: &[usize]) -> usize {
        let islands = &self.islands;
        let eliminated =
            self.tree.change(&self.touched, recent, &self.terms, &self.terms_of, |vertex| {
                !islands.is_held(vertex)
            });
        self.touched.clear();
        eliminated
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.linearised.len()
    }

    /// Whether there are no vertices.
    pub fn is_empty(&self) -> bool {
        self.linearised.is_empty()
    }

    /// `map_from_body` of a vertex; cost: one exponential.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn pose(&self, vertex: usize) -> P {
        self.linearised[vertex].retract(self.tree.step(vertex))
    }

    /// `map_from_body` of every vertex; cost: linear.
    pub fn poses(&self) -> Vec<P> {
        (0..self.len()).map(|vertex| self.pose(vertex)).collect()
    }

    /// `χ² = Σ eᵀ Ω e` of all factors in use at the current poses; cost: linear.
    pub fn chi2(&self) -> f64 {
        let used = self.factors.iter().zip(&self.withdrawn).filter(|(_, withdrawn)| !**withdrawn);
        used.map(|(factor, _)| {
            let (from, to) = (self.pose(factor.from), self.pose(factor.to));
            let error = P::error(self.options.error, &factor.from_from_to, &from, &to);
            error.dot(&(factor.information * error))
        })
        .sum()
    }

    /// Stored numbers of the factor.
    pub fn fill(&self) -> usize {
        self.tree.fill()
    }

    /// Optimises all poses to convergence, and goes on from there.
    ///
    /// Cost: a batch solution from the current poses, which are near it, and an elimination of all
    /// variables in a fresh order.
    pub fn finish(&mut self, options: &Options) -> Report {
        let graph = self.graph();
        let solution = optimize(&graph, &self.poses(), options);
        self.linearised = solution.poses;
        let free: Vec<usize> = (0..self.len()).filter(|&v| !self.islands.is_held(v)).collect();
        for &vertex in &free {
            self.tree.reset_step(vertex);
        }
        self.touched.extend_from_slice(&free);
        for index in 0..self.factors.len() {
            if !self.withdrawn[index] {
                self.refresh(index);
            }
        }
        let last = self.len().saturating_sub(1);
        self.eliminate(&[last]);
        self.tree.solve(self.options.propagate * self.mean_chi2(), &mut self.moved);
        solution.report
    }

    /// The graph as it stands: factors in use, vertices held, current poses as initial values.
    pub fn graph(&self) -> FactorGraph<P, D> {
        let used = self.factors.iter().zip(&self.withdrawn).filter(|(_, withdrawn)| !**withdrawn);
        FactorGraph {
            ids: (0..self.len() as u64).collect(),
            initial: self.poses().into_iter().map(Some).collect(),
            fixed: (0..self.len()).filter(|&vertex| self.islands.is_held(vertex)).collect(),
            factors: used.map(|(factor, _)| *factor).collect(),
        }
    }
}

/// Whether a factor joins two of `len` vertices and is finite.
fn check<P: Manifold<D>, const D: usize>(
    factor: &Factor<P, D>,
    len: usize,
) -> Result<(), PoseGraphError> {
    let (from, to) = (factor.from, factor.to);
    if from >= len || to >= len || from == to {
        return Err(PoseGraphError::FactorEnds { from, to, len });
    }
    let finite = factor.information.iter().all(|entry| entry.is_finite());
    if !finite || !factor.from_from_to.is_finite() {
        return Err(PoseGraphError::FactorNotFinite { from, to });
    }
    Ok(())
}
