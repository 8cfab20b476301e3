//! From the cheapest start to the surest.

use probe::{Off, Probe};

use super::judge::{Judgement, judge};
use crate::certificate::{Verdict, certify};
use crate::factors::FactorGraph;
use crate::initial::{chordal, odometry, spanning_tree, surest_tree};
use crate::solvers::{
    Loss, LossOn, OptimizerEvent, Options, Solution, Solver, optimize, optimize_with,
};
use crate::synchronize::{Rigid, SynchronizeOptions};

/// Where start values came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Chordal initialisation.
    Chordal,
    /// The solution of SE-Sync's problem.
    Synchronized,
    /// The chain of odometry.
    Odometry,
    /// The shortest paths from the first vertex.
    SpanningTree,
    /// The paths from the first vertex on which rotations are measured best.
    SurestTree,
    /// The surest tree, after factors were allowed to disagree for a while.
    LoosenedTree,
    /// The chain of odometry, after closures were allowed to disagree for a while.
    LoosenedOdometry,
    /// The lowest of the others, after damped steps.
    Damped,
}

impl Origin {
    /// A name for reports: `chordal`, `synchronized`, `spanning_tree` and so on.
    pub fn name(self) -> &'static str {
        match self {
            Self::Chordal => "chordal",
            Self::Synchronized => "synchronized",
            Self::Odometry => "odometry",
            Self::SpanningTree => "spanning_tree",
            Self::SurestTree => "surest_tree",
            Self::LoosenedTree => "loosened_tree",
            Self::LoosenedOdometry => "loosened_odometry",
            Self::Damped => "damped",
        }
    }
}

/// A start that was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Where it came from.
    pub origin: Origin,
    /// `χ²` that Gauss-Newton reached from it.
    pub chi2: f64,
    /// Whether it converged.
    pub converged: bool,
}

/// Start values, and the solution that was found from them on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Start<P> {
    /// `map_from_body` of every vertex: the start.
    pub poses: Vec<P>,
    /// Where it came from.
    pub origin: Origin,
    /// What the optimiser made of it, with the options that were given.
    pub solution: Solution<P>,
    /// What speaks for and against the first solution.
    pub judgement: Judgement,
    /// The verdict on SE-Sync's problem, where it came to that.
    pub verdict: Option<Verdict>,
    /// Every start that was tried, in order.
    pub trials: Vec<Trial>,
}

/// Start values from which the optimiser reaches the lowest cost that is known how to reach: see the
/// [module](crate::initial::default).
///
/// Gauss-Newton is what starts are tried with, whatever solver the options name, and its solution is
/// returned too. With a loss that lets factors disagree the start is the chain of odometry: every
/// other start trusts all factors alike.
pub fn default_start<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    options: &Options,
) -> Start<P> {
    default_start_with(graph, options, &mut Off)
}

/// [`default_start`], the optimisation from the start that is returned watched by a probe.
pub fn default_start_with<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    options: &Options,
    probe: &mut impl for<'a> Probe<OptimizerEvent<'a, P>>,
) -> Start<P> {
    let mut first = true;
    let mut start = default_start_by(graph, options, |poses, options| {
        if std::mem::take(&mut first) {
            optimize_with(graph, poses, options, probe)
        } else {
            optimize(graph, poses, options)
        }
    });
    if start.trials[0].origin != start.origin && probe.on() {
        // Once more, so that the probe sees the way to what is returned, and that last.
        let options = Options { solver: Solver::GaussNewton, ..*options };
        start.solution = optimize_with(graph, &start.poses, &options, probe);
    }
    start
}

/// [`default_start`], every start tried by the caller, who may watch or time what is done.
///
/// `run` moves poses to a minimum with these options, as [`optimize`] does; it is called once for
/// each of [`Start::trials`], in their order.
pub fn default_start_by<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    options: &Options,
    run: impl FnMut(&[P], &Options) -> Solution<P>,
) -> Start<P> {
    let (origin, first) = if options.loss == Loss::None {
        (Origin::Chordal, chordal(graph))
    } else {
        (Origin::Odometry, odometry(graph))
    };
    climb(graph, origin, first, Judgement::is_believed, options, run)
}

/// The start that a caller asks for, and better ones where the solution from there is not believed.
///
/// As [`default_start_by`], but `first` is the first of the trials, of this origin, and stands as soon as it
/// converges to a cost that noise explains; only else the chordal start follows, and the rest.
pub fn asked_start_by<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    origin: Origin,
    first: Vec<P>,
    options: &Options,
    run: impl FnMut(&[P], &Options) -> Solution<P>,
) -> Start<P> {
    climb(graph, origin, first, Judgement::is_explained, options, run)
}

/// Tries one start after the other until there is one whose solution is believed.
fn climb<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    origin: Origin,
    first: Vec<P>,
    suffices: impl Fn(&Judgement) -> bool,
    options: &Options,
    mut run: impl FnMut(&[P], &Options) -> Solution<P>,
) -> Start<P> {
    let trusting = options.loss == Loss::None;
    let options = &Options { solver: Solver::GaussNewton, ..*options };
    let solution = run(&first, options);
    let judgement = judge(graph, &solution);
    let mut start = Start {
        poses: first,
        origin,
        judgement,
        verdict: None,
        trials: vec![trial(origin, &solution)],
        solution,
    };
    let stands = suffices(&judgement) && start.solution.report.termination.is_converged();
    if stands || !trusting {
        return start;
    }
    let mut better: Option<Better<P>> = None;
    // Optimises from poses, and keeps the solution where it is the lowest so far.
    let mut try_from =
        |origin, poses: Vec<P>, start: &mut Start<P>, better: &mut Option<Better<P>>| {
            let solution = run(&poses, options);
            start.trials.push(trial(origin, &solution));
            let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
            if improves(&solution, lowest) {
                *better = Some(Better { origin, poses, solution });
            }
        };
    if origin != Origin::Chordal {
        try_from(Origin::Chordal, chordal(graph), &mut start, &mut better);
        let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
        if judge(graph, lowest).is_believed() {
            return start.with(better);
        }
    }
    // Which valley it is needs no more digits, and a graph without a tight relaxation no more ranks.
    let effort = SynchronizeOptions {
        max_rank: P::DIM + 1,
        iterations: 40,
        relative_decrease: 1e-10,
        relative_gap: 1e-5,
    };
    let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
    let certificate = certify(graph, &lowest.poses, &effort);
    start.verdict = Some(certificate.verdict);
    let certified = certificate.verdict == Verdict::GloballyOptimal;
    let near = turned_apart(&lowest.poses, &certificate.poses) < SAME_VALLEY_RAD;
    if certified && near && lowest.report.termination.is_converged() {
        return start.with(better);
    }
    if certificate.verdict != Verdict::NotApplicable {
        try_from(Origin::Synchronized, certificate.poses, &mut start, &mut better);
    }
    let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
    // In the plane the other starts cost next to nothing; in space they take long to lead astray.
    let judged = judge(graph, lowest);
    let go_on = match P::DIM {
        2 => !certified || judged.doubt.is_some(),
        _ => !certified && !judged.is_explained(),
    };
    if go_on {
        if origin != Origin::Odometry {
            try_from(Origin::Odometry, odometry(graph), &mut start, &mut better);
        }
        if origin != Origin::SpanningTree {
            try_from(Origin::SpanningTree, spanning_tree(graph), &mut start, &mut better);
        }
        let tree = surest_tree(graph);
        if P::DIM == 2 {
            let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
            // What noise leaves a factor, by the lowest solution so far.
            let degrees = start.judgement.degrees_of_freedom.max(1) as f64;
            let width = (lowest.report.chi2 / degrees).sqrt();
            let loosened = |poses: &[P], loss_on| loosened(graph, poses, width, loss_on, options);
            let from_tree = loosened(&tree, LossOn::All);
            let from_odometry = loosened(&odometry(graph), LossOn::Closures);
            try_from(Origin::LoosenedTree, from_tree, &mut start, &mut better);
            try_from(Origin::LoosenedOdometry, from_odometry, &mut start, &mut better);
        }
        try_from(Origin::SurestTree, tree, &mut start, &mut better);
    }
    let lowest = better.as_ref().map_or(&start.solution, |better| &better.solution);
    if !lowest.report.termination.is_converged() {
        // Full steps circle round it; damped ones go down.
        let damped = Options { solver: Solver::LevenbergMarquardt, ..*options };
        let poses = optimize(graph, &lowest.poses, &damped).poses;
        try_from(Origin::Damped, poses, &mut start, &mut better);
    }
    start.with(better)
}

/// Iterations in which factors may disagree: it decides about valleys, not about digits.
const LOOSE_ITERATIONS: usize = 40;

/// Poses after factors were allowed to disagree, by Cauchy's loss: closures that contradict a long way
/// do not tear at it before it has come near.
fn loosened<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    poses: &[P],
    width: f64,
    loss_on: LossOn,
    options: &Options,
) -> Vec<P> {
    if !(width.is_finite() && width > 0.0) {
        return poses.to_vec();
    }
    let max_iterations = options.max_iterations.min(LOOSE_ITERATIONS);
    let loose = Options { loss: Loss::Cauchy { width }, loss_on, max_iterations, ..*options };
    optimize(graph, poses, &loose).poses
}

/// Poses whose rotations are nowhere farther apart lie in the same valley: a path from one to the
/// other never passes half a turn, where valleys part, and noise has a margin of eight.
const SAME_VALLEY_RAD: f64 = std::f64::consts::FRAC_PI_8;

/// The largest angle between rotations of the same vertex.
fn turned_apart<P: Rigid<D>, const D: usize>(a: &[P], b: &[P]) -> f64 {
    a.iter().zip(b).map(|(a, b)| P::turn_between(a, b).norm()).fold(0.0, f64::max)
}

impl<P> Start<P> {
    /// The same with a better start in the place of the first, where there is one.
    fn with(self, better: Option<Better<P>>) -> Self {
        match better {
            Some(Better { origin, poses, solution }) => Self { poses, origin, solution, ..self },
            None => self,
        }
    }
}

/// A start that led lower than the first, and where it led.
struct Better<P> {
    origin: Origin,
    poses: Vec<P>,
    solution: Solution<P>,
}

fn trial<P>(origin: Origin, solution: &Solution<P>) -> Trial {
    let report = &solution.report;
    Trial { origin, chi2: report.chi2, converged: report.termination.is_converged() }
}

/// Whether a solution is lower than another by more than convergence leaves open.
fn improves<P>(solution: &Solution<P>, than: &Solution<P>) -> bool {
    let (new, old) = (solution.report.cost, than.report.cost);
    new.is_finite() && (!old.is_finite() || new < old * (1.0 - 1e-9))
}
