//! Where an optimisation starts, and the optimisation itself.

use std::time::Instant;

use posegraph::initial::{Origin, chordal, given, odometry, spanning_tree};
use posegraph::synchronize::Rigid;
use posegraph::{
    FactorGraph, OptimizerEvent, Options, Solution, Solver, default_start_with, optimize_with,
};
use probe::Probe;
use serde_json::{Value, json};

use super::args::Init;

/// A solution, and how it came about.
pub(super) struct Solved<P> {
    pub solution: Solution<P>,
    /// Where the start came from, as the command names it.
    pub init: &'static str,
    /// Every start that was tried, where the start was not chosen by the user.
    pub trials: Value,
    pub secs_init: f64,
    pub secs_optimize: f64,
}

/// Optimises from the start that was asked for, else from the best that can be computed.
///
/// The latter is tried out with Gauss-Newton; where that is the solver, nothing is left to do after
/// it, and the time is that of the start.
pub(super) fn solve<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    let began = Instant::now();
    let Some(init) = init else {
        if options.solver == Solver::GaussNewton {
            let start = default_start_with(graph, options, probe);
            let secs_init = began.elapsed().as_secs_f64();
            let (init, trials) = (name(start.origin), trials(&start.trials));
            return Solved {
                solution: start.solution,
                init,
                trials,
                secs_init,
                secs_optimize: 0.0,
            };
        }
        let start = default_start_with(graph, options, &mut probe::Off);
        let secs_init = began.elapsed().as_secs_f64();
        let began = Instant::now();
        let solution = optimize_with(graph, &start.poses, options, probe);
        let secs_optimize = began.elapsed().as_secs_f64();
        let (init, trials) = (name(start.origin), trials(&start.trials));
        return Solved { solution, init, trials, secs_init, secs_optimize };
    };
    let (poses, init) = match init {
        Init::File => (given(graph), "file"),
        Init::Odometry => (odometry(graph), "odometry"),
        Init::SpanningTree => (spanning_tree(graph), "spanning-tree"),
        Init::Chordal => (chordal(graph), "chordal"),
    };
    let secs_init = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let solution = optimize_with(graph, &poses, options, probe);
    let secs_optimize = began.elapsed().as_secs_f64();
    Solved { solution, init, trials: Value::Null, secs_init, secs_optimize }
}

fn name(origin: Origin) -> &'static str {
    match origin {
        Origin::SpanningTree => "spanning-tree",
        other => other.name(),
    }
}

fn trials(trials: &[posegraph::initial::Trial]) -> Value {
    let told = trials.iter().map(|trial| {
        json!({ "init": name(trial.origin), "chi2": trial.chi2, "converged": trial.converged })
    });
    told.collect()
}
