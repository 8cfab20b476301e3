//! A graph made ready for solving: who is free, where numbers go, what they are.

mod linearize;

use std::borrow::Cow;

use pose::nalgebra::SVector;

use super::{Fill, Loss, LossOn, Options};
use crate::factors::{ErrorKind, Factor, FactorGraph, InformationPolicy, Manifold, admissible};
use crate::initial::Components;
use crate::linear::{BlockCholesky, BlockPattern, NotPositiveDefinite, Slot};

/// Stands for the position of a vertex that is held.
const HELD: usize = usize::MAX;

/// Where a factor writes to.
#[derive(Clone, Copy, Debug)]
struct Target {
    /// Position of the vertex it starts from in the elimination order, or [`HELD`].
    from: usize,
    /// Position of the vertex it leads to, or [`HELD`].
    to: usize,
    /// The block that the two share, below the diagonal.
    between: Slot,
}

/// A graph made ready for solving, with the numbers of the last linearisation.
pub(crate) struct Problem<'a, P: Manifold<D>, const D: usize> {
    factors: Cow<'a, [Factor<P, D>]>,
    /// What was done about information matrices.
    pub information: InformationPolicy,
    /// Indices of the vertices that are held.
    pub held: Vec<usize>,
    /// Number of connected components.
    pub components: usize,
    kind: ErrorKind,
    loss: Loss,
    loss_on: LossOn,
    threads: usize,
    parts: Vec<Option<linearize::Part<D>>>,
    /// The weight that the caller gives each factor; 0 where it is left out.
    given: Vec<f64>,
    targets: Vec<Target>,
    /// The vertex at each position of the elimination order.
    free: Vec<usize>,
    diagonals: Vec<Slot>,
    cholesky: Option<BlockCholesky<D>>,
    /// The matrix of the normal equations of half the cost, laid out by the pattern.
    matrix: Vec<f64>,
    /// Its diagonal as assembled, in elimination order.
    diagonal: Vec<f64>,
    /// The gradient of half the cost, in elimination order.
    pub gradient: Vec<f64>,
    /// `eᵀ Ω e` of each factor at the last linearisation.
    pub factor_chi2: Vec<f64>,
    /// Weight of each factor at the last linearisation.
    pub weights: Vec<f64>,
}

impl<'a, P: Manifold<D>, const D: usize> Problem<'a, P, D> {
    /// Analyses a graph: symbolic work that no iteration repeats.
    pub(crate) fn new(graph: &'a FactorGraph<P, D>, options: &Options) -> Self {
        let (factors, information) = admissible(graph);
        let count = graph.ids.len();
        let used = |index: usize| information.left_out.binary_search(&index).is_err();
        let joins = || {
            (factors.iter().enumerate())
                .filter(|(index, _)| used(*index))
                .map(|(_, factor)| (factor.from, factor.to))
        };
        let components = Components::new(count, joins());
        let held = components.anchors(&graph.fixed);
        // Blocks are the free vertices in order.
        let mut block = vec![0; count];
        for &vertex in &held {
            block[vertex] = HELD;
        }
        let mut free = Vec::with_capacity(count - held.len());
        for (vertex, block) in block.iter_mut().enumerate().filter(|(_, block)| **block != HELD) {
            *block = free.len();
            free.push(vertex);
        }
        let pairs = joins()
            .map(|(from, to)| (block[from], block[to]))
            .filter(|&(from, to)| from != HELD && to != HELD);
        let pattern = BlockPattern::<D>::new(free.len(), pairs);
        let position = |vertex: usize| match block[vertex] {
            HELD => HELD,
            block => pattern.position(block),
        };
        let nowhere = Slot { start: 0, stride: 0 };
        let targets: Vec<Target> = (factors.iter().enumerate())
            .map(|(index, factor)| {
                if !used(index) {
                    return Target { from: HELD, to: HELD, between: nowhere };
                }
                let (from, to) = (position(factor.from), position(factor.to));
                let between = if from == HELD || to == HELD {
                    nowhere
                } else {
                    pattern.slot(from.max(to), from.min(to)).unwrap_or(nowhere)
                };
                Target { from, to, between }
            })
            .collect();
        let mut ordered = vec![0; free.len()];
        for (block, &vertex) in free.iter().enumerate() {
            ordered[pattern.position(block)] = vertex;
        }
        let unknowns = free.len() * D;
        let cholesky = if free.is_empty() { None } else { BlockCholesky::new(&pattern) };
        Self {
            information,
            held,
            components: components.count(),
            kind: options.error,
            loss: options.loss,
            loss_on: options.loss_on,
            threads: options.threads.max(1),
            parts: Vec::new(),
            weights: vec![0.0; factors.len()],
            given: vec![0.0; factors.len()],
            targets,
            free: ordered,
            diagonals: (0..pattern.blocks()).map(|at| pattern.diagonal(at)).collect(),
            cholesky,
            matrix: vec![0.0; pattern.len()],
            diagonal: vec![0.0; unknowns],
            gradient: vec![0.0; unknowns],
            factor_chi2: vec![0.0; factors.len()],
            factors,
        }
    }

    /// Takes the weights of the caller: 1 beyond their end, 0 for factors that are left out.
    pub(crate) fn weigh(&mut self, weights: &[f64]) {
        let weights = weights.iter().copied().chain(std::iter::repeat(1.0));
        for (given, weight) in self.given.iter_mut().zip(weights) {
            *given = if weight.is_finite() && weight > 0.0 { weight } else { 0.0 };
        }
        for &index in &self.information.left_out {
            self.given[index] = 0.0;
            self.weights[index] = 0.0;
            self.factor_chi2[index] = 0.0;
        }
    }

    /// The size of the linear systems.
    pub(crate) fn fill(&self) -> Fill {
        let blocks = self.matrix.len() / (D * D);
        Fill {
            unknowns: self.unknowns(),
            // Of diagonal blocks only the lower triangle counts.
            matrix: blocks * D * D - self.free.len() * D * (D - 1) / 2,
            factor: self.cholesky.as_ref().map_or(0, BlockCholesky::fill),
        }
    }

    /// Number of unknowns.
    pub(crate) fn unknowns(&self) -> usize {
        self.free.len() * D
    }

    /// The cost at these poses; updates what is known of each factor, but not the linearisation.
    pub(crate) fn evaluate(&mut self, poses: &[P]) -> f64 {
        let mut chi2 = std::mem::take(&mut self.factor_chi2);
        chi2.clear();
        chi2.extend(self.each_chi2(poses));
        let mut cost = 0.0;
        for (index, factor) in self.factors.iter().enumerate() {
            let (given, loss) = (self.given[index], self.loss_of(factor));
            if given == 0.0 && self.is_left_out(index) {
                chi2[index] = 0.0;
                continue;
            }
            cost += given * loss.cost(chi2[index]);
            self.weights[index] = given * loss.weight(chi2[index]);
        }
        self.factor_chi2 = chi2;
        cost
    }

    fn is_left_out(&self, index: usize) -> bool {
        self.information.left_out.binary_search(&index).is_ok()
    }

    /// The cost at these poses, with losses and weights; changes nothing.
    pub(crate) fn cost(&self, poses: &[P]) -> f64 {
        let mut cost = 0.0;
        for (factor, (&given, chi2)) in
            self.factors.iter().zip(self.given.iter().zip(self.each_chi2(poses)))
        {
            if given != 0.0 {
                cost += given * self.loss_of(factor).cost(chi2);
            }
        }
        cost
    }

    /// `χ²` without losses and weights at the last evaluation, of all factors that are used.
    pub(crate) fn known_chi2(&self) -> f64 {
        // From +0: an empty sum of floats is -0.
        self.factor_chi2.iter().fold(0.0, |sum, chi2| sum + chi2)
    }

    fn each_chi2<'b>(&'b self, poses: &'b [P]) -> impl Iterator<Item = f64> + use<'a, 'b, P, D> {
        self.factors.iter().map(|factor| {
            let (Some(from), Some(to)) = (poses.get(factor.from), poses.get(factor.to)) else {
                return 0.0;
            };
            let error = P::error(self.kind, &factor.from_from_to, from, to);
            error.dot(&(factor.information * error))
        })
    }

    fn loss_of(&self, factor: &Factor<P, D>) -> Loss {
        match self.loss_on {
            LossOn::Closures if factor.from.abs_diff(factor.to) == 1 => Loss::None,
            _ => self.loss,
        }
    }

    /// Factorises the matrix with this much of its diagonal added.
    pub(crate) fn factorize(&mut self, damping: f64) -> Result<(), NotPositiveDefinite> {
        let floor = self.diagonal.iter().fold(0.0f64, |most, entry| most.max(*entry)) * 1e-12;
        for (diagonal, slot) in self.diagonal.chunks_exact(D).zip(&self.diagonals) {
            for (k, entry) in diagonal.iter().enumerate() {
                self.matrix[slot.start + k * (slot.stride + 1)] =
                    if damping == 0.0 { *entry } else { entry + damping * entry.max(floor) };
            }
        }
        self.cholesky.as_mut().map_or(Ok(()), |cholesky| cholesky.factorize(&self.matrix))
    }

    /// Writes the step that the last factor gives for the last gradient, in elimination order.
    pub(crate) fn solve(&mut self, step: &mut Vec<f64>) {
        step.clear();
        step.extend(self.gradient.iter().map(|entry| -entry));
        if let Some(cholesky) = &mut self.cholesky {
            cholesky.solve_in_place(step);
        }
    }

    /// Writes the product of the undamped matrix of the last linearisation and a vector, in
    /// elimination order.
    pub(crate) fn multiply(&self, vector: &[f64], product: &mut Vec<f64>) {
        product.resize(vector.len(), 0.0);
        if let Some(cholesky) = &self.cholesky {
            cholesky.multiply(&self.matrix, vector, product);
        }
    }

    /// Applies the inverse that the last factor stands for, in elimination order.
    pub(crate) fn apply_factor(&mut self, vector: &mut [f64]) {
        if let Some(cholesky) = &mut self.cholesky {
            cholesky.solve_in_place(vector);
        }
    }

    /// Writes `poses` moved by a step in elimination order.
    pub(crate) fn moved(&self, poses: &[P], step: &[f64], moved: &mut Vec<P>) {
        moved.clear();
        moved.extend_from_slice(poses);
        for (&vertex, step) in self.free.iter().zip(step.chunks_exact(D)) {
            let step = std::array::from_fn::<f64, D, _>(|k| step[k]).into();
            moved[vertex] = poses[vertex].retract(&step);
        }
    }

    /// The diagonal of the undamped matrix, in elimination order.
    pub(crate) fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    /// `xᵀ H x` with the undamped matrix of the last linearisation.
    pub(crate) fn curvature(&self, x: &[f64], poses: &[P]) -> f64 {
        let mut sum = 0.0;
        for (index, (factor, target)) in self.factors.iter().zip(&self.targets).enumerate() {
            let weight = self.weights[index];
            if weight == 0.0 || (target.from == HELD && target.to == HELD) {
                continue;
            }
            let linear = P::linearize(
                self.kind,
                &factor.from_from_to,
                &poses[factor.from],
                &poses[factor.to],
            );
            let part = |at: usize| -> SVector<f64, D> {
                std::array::from_fn::<f64, D, _>(|k| if at == HELD { 0.0 } else { x[at * D + k] })
                    .into()
            };
            let change: SVector<f64, D> =
                linear.by_from * part(target.from) + linear.by_to * part(target.to);
            sum += weight * change.dot(&(factor.information * change));
        }
        sum
    }
}
