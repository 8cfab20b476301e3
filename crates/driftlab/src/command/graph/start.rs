//! Where an optimisation starts, and the optimisation itself.

use posegraph::initial::{Origin, asked_start_by, chordal, given, odometry, spanning_tree};
use posegraph::synchronize::Rigid;
use posegraph::{
    FactorGraph, OptimizerEvent, Options, Robust, Solution, Solver, default_start,
    default_start_by, optimize, optimize_robust, optimize_with,
};
use probe::Probe;
use serde_json::{Value, json};

use super::args::Init;
use crate::stopwatch::{Spent, Stopwatch};

/// Costs that differ by less, as a share, are the same.
pub(super) const SAME_SHARE: f64 = 1e-6;

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
/// With Gauss-Newton starts are tried out, and the solution of the one that is chosen is taken; the time
/// of that trial is that of the optimisation. One that is computed from few of the edges is a wish: where
/// its solution cannot be believed, others are tried too. A robust method starts from odometry where no
/// start is asked for.
pub(super) fn solve<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
    robust: Robust,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    // Every other start believes all closures alike.
    let doubting = robust != Robust::None;
    let tried_out = !doubting && options.solver == Solver::GaussNewton;
    let clock = Stopwatch::start();
    // What choosing a start led to, where it led anywhere.
    let mut reached = None;
    let (poses, init, trials) = match init.or(doubting.then_some(Init::Odometry)) {
        None | Some(Init::Odometry | Init::SpanningTree) if tried_out => {
            return try_out(graph, init, options, probe);
        }
        None => {
            let start = default_start(graph, options);
            reached = Some((start.solution.report.chi2, start.solution.poses));
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
        let mut found = optimize_with(graph, &poses, options, probe);
        // Another solver may end in another valley: not in a higher one than is known.
        if let Some((chi2, poses)) = reached
            && found.report.chi2 > chi2 * (1.0 + SAME_SHARE)
        {
            found = optimize_with(graph, &poses, options, probe);
        }
        (found, None)
    };
    Solved { solution, init, trials, init_time, optimize_time: clock.spent(), doubts }
}

/// The start that is found by trying, and what Gauss-Newton made of it.
fn try_out<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    init: Option<Init>,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Solved<P> {
    let clock = Stopwatch::start();
    let mut times = Vec::new();
    let run = |poses: &[P], options: &Options| {
        let clock = Stopwatch::start();
        let solution = if times.is_empty() {
            optimize_with(graph, poses, options, probe)
        } else {
            optimize(graph, poses, options)
        };
        times.push(clock.spent());
        solution
    };
    let mut start = match init {
        Some(Init::SpanningTree) => {
            asked_start_by(graph, Origin::SpanningTree, spanning_tree(graph), options, run)
        }
        Some(_) => asked_start_by(graph, Origin::Odometry, odometry(graph), options, run),
        None => default_start_by(graph, options, run),
    };
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
        Origin::LoosenedTree => "loosened-tree",
        Origin::LoosenedOdometry => "loosened-odometry",
        other => other.name(),
    }
}

fn trials(trials: &[posegraph::initial::Trial]) -> Value {
    let told = trials.iter().map(|trial| {
        json!({ "init": name(trial.origin), "chi2": trial.chi2, "converged": trial.converged })
    });
    told.collect()
}
