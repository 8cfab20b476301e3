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
/// `weights` holds a number of at least 0 for each factor; factors beyond its end weigh 1.
pub fn optimize_weighted<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    start: &[P],
    weights: &[f64],
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solution<P> {
    let mut problem = Problem::new(graph, weights, options);
    let count = graph.ids.len();
    let mut state = State {
        poses: start.to_vec(),
        cost: f64::NAN,
        step: Vec::new(),
        trial: Vec::new(),
        iterations: Vec::new(),
    };
    let mut chi2_initial = f64::NAN;
    let termination = if start.len() == count {
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
        if problem.unknowns() == 0 {
            Termination::NothingToDo
        } else if state.cost.is_finite() {
            match options.solver {
                Solver::GaussNewton => gauss_newton::run(&mut problem, &mut state, options, probe),
                Solver::LevenbergMarquardt => {
                    levenberg_marquardt::run(&mut problem, &mut state, options, probe)
                }
                Solver::Dogleg => dogleg::run(&mut problem, &mut state, options, probe),
            }
        } else {
            Termination::NotFinite { chi2: state.cost }
        }
    } else {
        problem.factor_chi2.fill(f64::NAN);
        Termination::StartMissing { poses: start.len(), vertices: count }
    };
    let chi2 = problem.known_chi2();
    let report = Report {
        termination,
        chi2_initial,
        chi2,
        cost: state.cost,
        iterations: state.iterations,
        fill: problem.fill(),
        held: problem.held,
        components: problem.components,
        information: problem.information,
    };
    probe.emit(OptimizerEvent::Finished { report: &report });
    Solution { poses: state.poses, weights: problem.weights, report }
}
