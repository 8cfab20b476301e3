//! The way into the optimiser.

use probe::{Off, Probe};

use super::problem::Problem;
use super::state::State;
use super::{
    OptimizerEvent, Options, Report, Solution, Solver, Termination, dogleg, gauss_newton,
    levenberg_marquardt,
};
use crate::factors::{FactorGraph, Manifold};

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
/// `weights` as for [`Optimizer::run`], which saves the analysis where a graph is optimised again.
pub fn optimize_weighted<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    weights: &[f64],
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solution<P> {
    Optimizer::new(graph, options).run(start, weights, probe)
}

/// A graph that was analysed once, to be optimised many times: with other weights, from other
/// starts.
pub struct Optimizer<'a, P: Manifold<D>, const D: usize> {
    problem: Problem<'a, P, D>,
    options: Options,
    vertices: usize,
}

impl<'a, P: Manifold<D>, const D: usize> Optimizer<'a, P, D> {
    /// Analyses a graph: components, information matrices, ordering, pattern of the factor.
    pub fn new(graph: &'a FactorGraph<P, D>, options: &Options) -> Self {
        let problem = Problem::new(graph, options);
        Self { problem, options: *options, vertices: graph.ids.len() }
    }

    /// Moves the poses to a minimum from `start`, every factor's cost multiplied by its weight.
    ///
    /// `weights` holds a number of at least 0 for each factor; factors beyond its end weigh 1, those
    /// whose weight is negative or not finite 0. Earlier runs leave no trace in the result.
    pub fn run(
        &mut self,
        start: &[P],
        weights: &[f64],
        probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
    ) -> Solution<P> {
        let problem = &mut self.problem;
        problem.weigh(weights);
        let mut state = State {
            poses: start.to_vec(),
            cost: f64::NAN,
            step: Vec::new(),
            trial: Vec::new(),
            iterations: Vec::new(),
        };
        let mut chi2_initial = f64::NAN;
        let termination = if start.len() == self.vertices {
            state.cost = problem.linearize(start);
            chi2_initial = problem.known_chi2();
            if probe.on() {
                probe.emit(OptimizerEvent::Started {
                    poses: start,
                    factor_chi2: &problem.factor_chi2,
                    weights: &problem.weights,
                    fill: problem.fill(),
                });
            }
            descend(problem, &mut state, &self.options, probe)
        } else {
            problem.factor_chi2.fill(f64::NAN);
            Termination::StartMissing { poses: start.len(), vertices: self.vertices }
        };
        let report = Report {
            termination,
            chi2_initial,
            chi2: problem.known_chi2(),
            cost: state.cost,
            iterations: state.iterations,
            fill: problem.fill(),
            held: problem.held.clone(),
            components: problem.components,
            information: problem.information.clone(),
        };
        probe.emit(OptimizerEvent::Finished { report: &report });
        Solution { poses: state.poses, weights: problem.weights.clone(), report }
    }
}

/// Runs the solver that was asked for, from a linearised start.
fn descend<P: Manifold<D>, const D: usize>(
    problem: &mut Problem<'_, P, D>,
    state: &mut State<P>,
    options: &Options,
    probe: &mut impl for<'e> Probe<OptimizerEvent<'e, P>>,
) -> Termination {
    if problem.unknowns() == 0 {
        return Termination::NothingToDo;
    }
    if !state.cost.is_finite() {
        return Termination::NotFinite { chi2: state.cost };
    }
    match options.solver {
        Solver::GaussNewton => gauss_newton::run(problem, state, options, probe),
        Solver::LevenbergMarquardt => levenberg_marquardt::run(problem, state, options, probe),
        Solver::Dogleg => dogleg::run(problem, state, options, probe),
    }
}
