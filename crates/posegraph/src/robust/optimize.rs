//! The way into robust optimisation.

use probe::Probe;

use super::Robust;
use super::believed::Believed;
use super::gate::{SLACK, gate};
use super::gnc::{Target, enough, graduate};
use super::growth::grown;
use super::noise::witnessed;
use super::pcm::consistent;
use super::settle::settle;
use super::soft::{loss, switched, with_loss};
use crate::factors::{FactorGraph, Manifold};
use crate::solvers::{Loss, OptimizerEvent, Options, Solution};

/// Poses, and which loop closures they do without.
#[derive(Clone, Debug, PartialEq)]
pub struct RobustSolution<P> {
    /// Poses, weights of all factors, and the report of the last optimisation; its `χ²` counts what
    /// took part.
    pub solution: Solution<P>,
    /// Indices of the loop closures that are not believed, ascending.
    pub rejected: Vec<usize>,
    /// Variance of the errors in units of what the information matrices say: `χ²` per degree of
    /// freedom of what is believed; 1 where nothing can be said.
    pub noise_scale: f64,
    /// The same before anything was optimised, by loops of neighbouring closures; `None` where no two
    /// can be compared.
    pub loop_scale: Option<f64>,
    /// The `χ²` that noise exceeds once in a million times: closures are believed at least up to here (with
    /// losses and switches up to four times as much, which is what stands here); infinite where all are.
    pub gate: f64,
    /// For [`Robust::Pcm`]: whether its set was proven to be the largest.
    pub largest_set: Option<bool>,
    /// Iterations of all optimisations.
    pub iterations: usize,
    /// Rounds with other weights.
    pub rounds: usize,
}

/// Optimises a graph, some of whose loop closures may be wrong.
///
/// `start` holds `map_from_body` of every vertex; [`odometry`](fn@crate::initial::odometry) is the start
/// that no wrong closure has touched. The loss in `options` is not used. The probe sees the last
/// optimisation, with all factors.
pub fn optimize_robust<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    robust: Robust,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> RobustSolution<P> {
    let believed = Believed::new(graph, options);
    if start.len() != graph.ids.len() {
        // The optimiser says what is missing.
        let solution = with_loss(&believed, start, Loss::None, probe);
        return told(&believed, solution, Vec::new(), None, f64::INFINITY);
    }
    let witnessed = witnessed(&believed.graph, &believed.closes, options.error);
    let scale = witnessed.scale.unwrap_or(1.0);
    let of_loops = witnessed.scale;
    if let Some(loss) = loss(robust, scale, D) {
        let solution = with_loss(&believed, start, loss, probe);
        let limit = if robust == Robust::None { f64::INFINITY } else { SLACK * gate(scale, D) };
        let rejected = beyond(&believed, &solution.poses, limit);
        return told(&believed, solution, rejected, of_loops, limit);
    }
    if robust == Robust::Switchable {
        let (poses, weights, rounds, iterations) = switched(&believed, start, scale);
        let solution = believed.finish(&poses, &weights, probe);
        let limit = SLACK * gate(scale, D);
        let rejected = beyond(&believed, &solution.poses, limit);
        let mut found = told(&believed, solution, rejected, of_loops, limit);
        found.iterations += iterations;
        found.rounds = rounds;
        return found;
    }
    let mut witnessed = witnessed;
    let mut largest_set = None;
    if robust == Robust::Pcm {
        let set = consistent(&believed, scale);
        witnessed.supported = set.members;
        largest_set = Some(set.proven);
    }
    if !enough(&believed, &witnessed.supported) {
        witnessed.supported = grown(&believed, start, scale);
    }
    let target = if robust == Robust::GncGm { Target::GemanMcClure } else { Target::Tls };
    let found = graduate(&believed, start, &witnessed, target);
    let settled = settle(&believed, found.poses, &found.weights, scale, probe);
    let rejected = believed.closures().filter(|&k| settled.solution.weights[k] < 0.5).collect();
    let mut result = told(&believed, settled.solution, rejected, of_loops, settled.gate);
    result.iterations = found.iterations + settled.iterations;
    result.rounds = found.rounds;
    result.largest_set = largest_set;
    result
}

/// Closures whose `χ²` is beyond a limit.
fn beyond<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    poses: &[P],
    limit: f64,
) -> Vec<usize> {
    let chi2 = believed.chi2(poses);
    believed.closures().filter(|&k| chi2[k] > limit).collect()
}

fn told<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    solution: Solution<P>,
    rejected: Vec<usize>,
    loop_scale: Option<f64>,
    gate: f64,
) -> RobustSolution<P> {
    let mut weights = believed.trusting.clone();
    for &index in &rejected {
        weights[index] = 0.0;
    }
    let scale = (solution.poses.len() == believed.graph.ids.len())
        .then(|| believed.chi2_per_degree(&believed.chi2(&solution.poses), &weights))
        .flatten();
    let iterations = solution.report.iterations.len();
    RobustSolution {
        solution,
        rejected,
        noise_scale: scale.unwrap_or(1.0),
        loop_scale,
        gate,
        largest_set: None,
        iterations,
        rounds: 1,
    }
}
