//! Where an optimisation starts, and the optimisation itself.

use std::time::Instant;

use posegraph::initial::{Origin, chordal, given, odometry, spanning_tree};
use posegraph::synchronize::Rigid;
use posegraph::{
    FactorGraph, OptimizerEvent, Options, Robust, Solution, Solver, default_start_with,
    optimize_robust, optimize_with,
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
    /// What a robust method says of the closures.
    pub doubts: Option<Doubts>,
}

/// What a robust method says of the closures.
pub(super) struct Doubts {
    /// Indices of the factors that are not believed.
    pub rejected: Vec<usize>,
    pub noise_scale: f64,
    pub gate: f64,
    /// Iterations of all its optimisations.
    pub iterations: usize,
}

/// Optimises from the start that was asked for, else from the best that can be computed.
///
/// The latter is tried out with Gauss-Newton; where that is the solver, nothing is left to do after
/// it, and the time is that of the start. A robust method starts from odometry where no start is
/// asked for.
pub(super) fn solve<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
    robust: Robust,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    let began = Instant::now();
    // Every other start believes all closures alike.
    let doubting = robust != Robust::None;
    let init = init.or(doubting.then_some(Init::Odometry));
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
                doubts: None,
            };
        }
        let start = default_start_with(graph, options, &mut probe::Off);
        let secs_init = began.elapsed().as_secs_f64();
        let began = Instant::now();
        let solution = optimize_with(graph, &start.poses, options, probe);
        let secs_optimize = began.elapsed().as_secs_f64();
        let (init, trials) = (name(start.origin), trials(&start.trials));
        return Solved { solution, init, trials, secs_init, secs_optimize, doubts: None };
    };
    let (poses, init) = match init {
        Init::File => (given(graph), "file"),
        Init::Odometry => (odometry(graph), "odometry"),
        Init::SpanningTree => (spanning_tree(graph), "spanning-tree"),
        Init::Chordal => (chordal(graph), "chordal"),
    };
    let secs_init = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let trials = Value::Null;
    if doubting {
        let found = optimize_robust(graph, &poses, robust, options, probe);
        let secs_optimize = began.elapsed().as_secs_f64();
        let doubts = Doubts {
            rejected: found.rejected,
            noise_scale: found.noise_scale,
            gate: found.gate,
            iterations: found.iterations,
        };
        let (solution, doubts) = (found.solution, Some(doubts));
        return Solved { solution, init, trials, secs_init, secs_optimize, doubts };
    }
    let solution = optimize_with(graph, &poses, options, probe);
    let secs_optimize = began.elapsed().as_secs_f64();
    Solved { solution, init, trials, secs_init, secs_optimize, doubts: None }
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
