//! Optimising with the factors that weigh something.

use probe::Probe;

use super::chain::closures;
use crate::factors::{FactorGraph, Manifold, admissible};
use crate::solvers::{Optimizer, OptimizerEvent, Options, Report, Solution};

/// A graph with usable information matrices, and what every method wants to know of it.
pub(super) struct Believed<P, const D: usize> {
    /// The graph; factors that are of no use are still there.
    pub graph: FactorGraph<P, D>,
    /// Whether each factor is a closure.
    pub closes: Vec<bool>,
    /// The weight of each factor while nothing is doubted: 0 where it is of no use.
    pub trusting: Vec<f64>,
    /// Without a loss.
    pub options: Options,
}

impl<P: Manifold<D>, const D: usize> Believed<P, D> {
    pub fn new(graph: &FactorGraph<P, D>, options: &Options) -> Self {
        let (factors, policy) = admissible(graph);
        let mut closes = closures(graph);
        let mut trusting = vec![1.0; factors.len()];
        for &index in &policy.left_out {
            closes[index] = false;
            trusting[index] = 0.0;
        }
        let factors = factors.into_owned();
        let (ids, initial) = (graph.ids.clone(), graph.initial.clone());
        let graph = FactorGraph { ids, initial, fixed: graph.fixed.clone(), factors };
        let options = Options { loss: crate::solvers::Loss::None, ..*options };
        Self { graph, closes, trusting, options }
    }

    /// Indices of the closures.
    pub fn closures(&self) -> impl Iterator<Item = usize> {
        (0..self.closes.len()).filter(|&index| self.closes[index])
    }

    /// `eᵀ Ω e` of each factor; 0 where it is of no use.
    pub fn chi2(&self, poses: &[P]) -> Vec<f64> {
        let kind = self.options.error;
        let each = self.graph.factors.iter().zip(&self.trusting).map(|(factor, &used)| {
            if used == 0.0 {
                return 0.0;
            }
            let (from, to) = (&poses[factor.from], &poses[factor.to]);
            let error = P::error(kind, &factor.from_from_to, from, to);
            error.dot(&(factor.information * error))
        });
        each.collect()
    }

    /// `χ²` of the factors of weight over ½, per degree of freedom.
    pub fn chi2_per_degree(&self, chi2: &[f64], weights: &[f64]) -> Option<f64> {
        let taken = || weights.iter().zip(chi2).filter(|(weight, _)| **weight > 0.5);
        let count = taken().count() + 1;
        let degrees = D * count.saturating_sub(self.graph.ids.len());
        (degrees > 0).then(|| taken().map(|(_, chi2)| chi2).sum::<f64>() / degrees as f64)
    }

    /// The graph of the factors that weigh something, their indices and weights.
    ///
    /// Factors without weight would still fill the factor of the matrix: random closures join
    /// everything with everything.
    pub fn part(&self, weights: &[f64]) -> (FactorGraph<P, D>, Vec<usize>, Vec<f64>) {
        let active: Vec<usize> = (0..weights.len()).filter(|&k| weights[k] > 0.0).collect();
        let graph = FactorGraph {
            ids: self.graph.ids.clone(),
            initial: self.graph.initial.clone(),
            fixed: self.graph.fixed.clone(),
            factors: active.iter().map(|&index| self.graph.factors[index]).collect(),
        };
        let own = active.iter().map(|&index| weights[index]).collect();
        (graph, active, own)
    }

    /// Some iterations from `poses` with these weights; the poses and the iterations done.
    pub fn descend(&self, poses: &[P], weights: &[f64], options: &Options) -> (Vec<P>, usize) {
        let (graph, _, own) = self.part(weights);
        let found = Optimizer::new(&graph, options).run(poses, &own, &mut probe::Off);
        let iterations = found.report.iterations.len();
        (found.poses, iterations)
    }

    /// Optimises to the end with these weights, watched by a probe that sees all factors.
    pub fn finish(
        &self,
        poses: &[P],
        weights: &[f64],
        probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
    ) -> Solution<P> {
        let (graph, active, own) = self.part(weights);
        let mut probe = AllFactors { whole: self, weights, probe };
        let mut found = Optimizer::new(&graph, &self.options).run(poses, &own, &mut probe);
        let mut all = vec![0.0; weights.len()];
        for (&index, weight) in active.iter().zip(&found.weights) {
            all[index] = *weight;
        }
        found.weights = all;
        self.complete(&mut found.report);
        found
    }

    /// What a report of some of the factors says of all.
    pub fn complete(&self, report: &mut Report) {
        report.information = admissible(&self.graph).1;
    }
}

/// A probe that is told of all factors where only some are optimised.
struct AllFactors<'a, P, const D: usize, W> {
    whole: &'a Believed<P, D>,
    weights: &'a [f64],
    probe: &'a mut W,
}

impl<'e, P: Manifold<D>, const D: usize, W> Probe<OptimizerEvent<'e, P>> for AllFactors<'_, P, D, W>
where
    W: for<'w> Probe<OptimizerEvent<'w, P>>,
{
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: OptimizerEvent<'e, P>) {
        match event {
            OptimizerEvent::Started { poses, fill, .. } => {
                let factor_chi2 = &self.whole.chi2(poses);
                let weights = self.weights;
                self.probe.emit(OptimizerEvent::Started { poses, factor_chi2, weights, fill });
            }
            OptimizerEvent::Iterated { iteration, poses, .. } => {
                let factor_chi2 = &self.whole.chi2(poses);
                let weights = self.weights;
                self.probe.emit(OptimizerEvent::Iterated {
                    iteration,
                    poses,
                    factor_chi2,
                    weights,
                });
            }
            OptimizerEvent::Finished { report } => {
                let mut report = report.clone();
                self.whole.complete(&mut report);
                self.probe.emit(OptimizerEvent::Finished { report: &report });
            }
        }
    }
}
