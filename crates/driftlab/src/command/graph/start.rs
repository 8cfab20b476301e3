//! Where an optimisation starts, and the optimisation itself.

use posegraph::initial::{Origin, chordal, given, odometry, spanning_tree};
use posegraph::synchronize::Rigid;
use posegraph::{
    FactorGraph, OptimizerEvent, Options, Robust, Solution, Solver, default_start,
    default_start_by, optimize, optimize_robust, optimize_with,
};
use probe::Probe;
use serde_json::{Value, json};

use super::args::Init;
use crate::stopwatch::{Spent, Stopwatch};

/// A solution, and how it came about.
pub(super) struct Solved<P> {
    pub solution: Solution<P>,
    /// Where the start came from, as the command names it.
    pub init: &'static str,
    /// Every start that was tried, where the start was not chosen by the user.
    pub trials: Value,
    /// Choosing a start, trials of others included.
    pub init_time: Spent,
    /// The optimisation from that start.
    pub optimize_time: Spent,
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
/// The latter is tried out with Gauss-Newton; where that is the solver, its solution is taken, and
/// the time of that trial is that of the optimisation. A robust method starts from odometry where
/// no start is asked for.
pub(super) fn solve<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
    robust: Robust,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    // Every other start believes all closures alike.
    let doubting = robust != Robust::None;
    let clock = Stopwatch::start();
    let (poses, init, trials) = match init.or(doubting.then_some(Init::Odometry)) {
        None if options.solver == Solver::GaussNewton => return try_out(graph, options, probe),
        None => {
            let start = default_start(graph, options);
            (start.poses, name(start.origin), trials(&start.trials))
        }
        Some(Init::File) => (given(graph), "file", Value::Null),
        Some(Init::Odometry) => (odometry(graph), "odometry", Value::Null),
        Some(Init::SpanningTree) => (spanning_tree(graph), "spanning-tree", Value::Null),
        Some(Init::Chordal) => (chordal(graph), "chordal", Value::Null),
    };
    let init_time = clock.spent();
    let clock = Stopwatch::start();
    let (solution, doubts) = if doubting {
        let found = optimize_robust(graph, &poses, robust, options, probe);
        let doubts = Doubts {
            rejected: found.rejected,
            noise_scale: found.noise_scale,
            gate: found.gate,
            iterations: found.iterations,
        };
        (found.solution, Some(doubts))
    } else {
        (optimize_with(graph, &poses, options, probe), None)
    };
    Solved { solution, init, trials, init_time, optimize_time: clock.spent(), doubts }
}

/// The default start, and what Gauss-Newton made of it.
fn try_out<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    let clock = Stopwatch::start();
    let mut times = Vec::new();
    let mut start = default_start_by(graph, options, |poses, options| {
        let clock = Stopwatch::start();
        let solution = if times.is_empty() {
            optimize_with(graph, poses, options, probe)
        } else {
            optimize(graph, poses, options)
        };
        times.push(clock.spent());
        solution
    });
    let whole = clock.spent();
    let chosen = start.trials.iter().position(|trial| trial.origin == start.origin);
    let chosen = chosen.unwrap_or(0);
    if chosen > 0 && probe.on() {
        // Once more, so that the recording shows the way to what is returned, and that last.
        start.solution = optimize_with(graph, &start.poses, options, probe);
    }
    let optimize_time = times.get(chosen).copied().unwrap_or_default();
    Solved {
        solution: start.solution,
        init: name(start.origin),
        trials: trials(&start.trials),
        init_time: whole.less(optimize_time),
        optimize_time,
        doubts: None,
    }
}

fn name(origin: Origin) -> &'static str {
    match origin {
        Origin::SpanningTree => "spanning-tree",
        Origin::SurestTree => "surest-tree",
        other => other.name(),
    }
}

fn trials(trials: &[posegraph::initial::Trial]) -> Value {
    let told = trials.iter().map(|trial| {
        json!({ "init": name(trial.origin), "chi2": trial.chi2, "converged": trial.converged })
    });
    told.collect()
}
