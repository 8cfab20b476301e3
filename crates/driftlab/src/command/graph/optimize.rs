//! `driftlab graph optimize`: the poses that fit the edges best.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::anyhow;
use formats::pose_graph::AnyGraph;
use instrument::{DrawnPose, InstrumentError, OptimisationOptions, OptimisationRecording};
use pose::nalgebra::Vector3;
use pose::{Se2, Se3};
use posegraph::factors::chi2;
use posegraph::synchronize::{Rigid, SynchronizeOptions};
use posegraph::{
    ErrorKind, FactorGraph, FactorGraph2, FactorGraph3, Options, Solution, Solver, Termination,
    Verdict, certify, sesync_cost,
};
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::out::Out;
use super::args::{OptimizeArgs, SolverName};
use super::input;
use super::numbers::{listed, shown};
use super::output::{self, Target};
use super::start::{self, SAME_SHARE, Solved};
use crate::stopwatch::Spent;

pub(super) fn optimize(args: &OptimizeArgs, out: &Out) -> Result<(), Failure> {
    let target = args.output.as_deref().map(|path| Target::new(path, args.to, args.force));
    let target = target.transpose()?;
    if let Some(record) = &args.record {
        output::free(record, args.force)?;
        output::apart(record, [args.file.as_path()].into_iter().chain(args.output.as_deref()))?;
    }
    let input::Timed { read: file, secs: secs_read } = input::graph(&args.file, out)?;
    let (unknown_tags, warnings) = input::report_json(&file.report);
    let (solved, done) = match file.graph {
        AnyGraph::Plane(graph) => solve(graph, args, out)?,
        AnyGraph::Space(graph) => solve(graph, args, out)?,
    };
    // Poses that are no numbers are no result: nobody could read the file.
    let target = target.filter(|_| done.finite);
    let secs_write = target.as_ref().map(|target| {
        let start = Instant::now();
        target.write(&solved).map(|()| start.elapsed().as_secs_f64())
    });
    let secs_write = secs_write.transpose()?;
    let mut json = done.json;
    json["secs_read"] = secs_read.into();
    json["secs_write"] = secs_write.into();
    json["unknown_tags"] = unknown_tags;
    json["warnings"] = warnings;
    let mut rows = done.rows;
    rows.push((
        "seconds",
        format!(
            "read {secs_read:.4}, start {:.4}, optimise {:.4}",
            done.init_time.secs, done.optimize_time.secs
        ),
    ));
    out.result(&json, &listed(&rows))?;
    match done.failure {
        Some(failure) => Err(failure),
        None => Ok(()),
    }
}

/// What a dimension adds to the optimiser.
trait Dimension<const D: usize>: Rigid<D> + DrawnPose {
    fn any(graph: FactorGraph<Self, D>) -> AnyGraph;
}

impl Dimension<3> for Se2 {
    fn any(graph: FactorGraph2) -> AnyGraph {
        AnyGraph::Plane(graph)
    }
}

impl Dimension<6> for Se3 {
    fn any(graph: FactorGraph3) -> AnyGraph {
        AnyGraph::Space(graph)
    }
}

/// What is told in the end.
struct Done {
    json: Value,
    rows: Vec<(&'static str, String)>,
    init_time: Spent,
    optimize_time: Spent,
    /// Whether the poses are numbers.
    finite: bool,
    failure: Option<Failure>,
}

/// Optimises a graph; the poses it returns stand as start values in the graph.
fn solve<P: Dimension<D>, const D: usize>(
    mut graph: FactorGraph<P, D>,
    args: &OptimizeArgs,
    out: &Out,
) -> Result<(AnyGraph, Done), Failure> {
    let options = Options {
        solver: match args.solver {
            SolverName::Gn => Solver::GaussNewton,
            SolverName::Lm => Solver::LevenbergMarquardt,
            SolverName::Dogleg => Solver::Dogleg,
        },
        max_iterations: args.max_iterations,
        threads: args.threads,
        ..Options::default()
    };
    let mut recording = match &args.record {
        Some(path) => Some(record(&graph, path.clone(), args)?),
        None => None,
    };
    let solved = match &mut recording {
        Some(recording) => start::solve(&graph, args.init, args.robust.0, &options, recording),
        None => start::solve(&graph, args.init, args.robust.0, &options, &mut probe::Off),
    };
    out.detail(&format!("started from {}", solved.init));
    let solution = &solved.solution;
    for iteration in &solution.report.iterations {
        out.detail(&format!(
            "iteration {}: cost {:.9e}, step {:.3e}, damping {:.2e}, {}",
            iteration.index,
            iteration.cost,
            iteration.step_norm,
            iteration.damping,
            if iteration.accepted { "taken" } else { "taken back" }
        ));
    }

    let believed = believed(&graph, &solved);
    let believed = believed.as_ref().unwrap_or(&graph);
    let certificate = args.certify.then(|| certified(believed, solution, &options));
    let mut done = tell(&graph, believed, &solved, certificate.as_ref(), args);
    if let Some(recording) = recording {
        recording.finish(&done.json).map_err(unrecorded)?;
    }
    if let Some(path) = &args.record {
        done.json["recording"] = path.display().to_string().into();
    }
    graph.initial = solved.solution.poses.into_iter().map(Some).collect();
    Ok((P::any(graph), done))
}

/// The graph without the edges that were rejected; `None` where none was.
fn believed<P: Dimension<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    solved: &Solved<P>,
) -> Option<FactorGraph<P, D>> {
    let rejected = &solved.doubts.as_ref().filter(|doubts| !doubts.rejected.is_empty())?.rejected;
    let mut is_kept = vec![true; graph.factors.len()];
    rejected.iter().for_each(|&index| is_kept[index] = false);
    let mut believed = graph.clone();
    let mut is_kept = is_kept.into_iter();
    believed.factors.retain(|_| is_kept.next().unwrap_or(true));
    Some(believed)
}

/// Poses that are turned apart by less are of one solution, radians: chi2 and SE-Sync's cost weigh
/// rotations differently.
const SAME_VALLEY_RAD: f64 = 0.05;

/// The certificate as JSON, and for people.
struct Certified {
    json: Value,
    text: String,
}

fn certified<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    solution: &Solution<P>,
    options: &Options,
) -> Certified {
    let began = Instant::now();
    let found = certify(graph, &solution.poses, &SynchronizeOptions::default());
    let secs = began.elapsed().as_secs_f64();
    // Of a cost that is nothing but rounding there are no shares.
    let gap_relative = Some(found.gap / found.sesync_cost).filter(|share| *share <= 1.0);
    let (apart_m, apart_rad) = apart(&found.poses, &solution.poses);
    // What is certified may be another solution than the one that is written.
    let lower = (apart_rad > SAME_VALLEY_RAD)
        .then(|| posegraph::optimize(graph, &found.poses, options).report.chi2)
        .filter(|chi2| *chi2 < solution.report.chi2 * (1.0 - SAME_SHARE));
    let (verdict, reason) = match lower {
        None => (found.verdict, found.reason),
        Some(chi2) => (
            Verdict::NotCertified,
            format!(
                "another solution passes, of chi2 {}: what is written is a local one",
                shown(chi2)
            ),
        ),
    };
    let verdict = verdict.name();
    let json = json!({
        "verdict": verdict,
        "of": "SE-Sync's cost at its own solution, not chi2",
        "eigenvalue": found.smallest_eigenvalue,
        "precision": found.precision,
        "gap": found.gap,
        "gap_relative": gap_relative,
        "sesync_cost": found.sesync_cost,
        "rank": found.rank,
        "poses_apart_m": apart_m,
        "poses_apart_rad": apart_rad,
        "lower_chi2": lower,
        "reason": reason,
        "secs": secs,
    });
    let text = format!(
        "{verdict}: SE-Sync's cost {:.9} (another cost than chi2), of poses up to {} m and {} rad from \
         those that are written; gap {}{}, smallest eigenvalue {} to \
         within {}; {}",
        found.sesync_cost,
        shown(apart_m),
        shown(apart_rad),
        shown(found.gap),
        gap_relative.map_or(String::new(), |share| format!(" ({} of the cost)", shown(share))),
        shown(found.smallest_eigenvalue),
        shown(found.precision),
        reason
    );
    Certified { json, text }
}

/// The farthest that two poses of a vertex lie and are turned apart, metres and radians.
fn apart<P: Rigid<D>, const D: usize>(a: &[P], b: &[P]) -> (f64, f64) {
    a.iter().zip(b).fold((0.0, 0.0), |(farthest, most): (f64, f64), (a, b)| {
        let at = [a, b].map(|pose| Vector3::from(pose.columns()[P::DIM]));
        (farthest.max((at[0] - at[1]).norm()), most.max(P::turn_between(a, b).norm()))
    })
}

fn record<'a, P: Dimension<D>, const D: usize>(
    graph: &'a FactorGraph<P, D>,
    path: PathBuf,
    args: &OptimizeArgs,
) -> Result<OptimisationRecording<'a, P, D>, Failure> {
    let name = args.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let about = format!(
        "The pose graph `{}`: {} poses, {} edges. Every edge says where one pose was seen from \
         another; the optimiser moves the poses until the edges fit as well as they can.",
        args.file.file_name().unwrap_or_default().to_string_lossy(),
        graph.ids.len(),
        graph.factors.len()
    );
    let options = OptimisationOptions { path, name, about };
    OptimisationRecording::create(graph, options).map_err(unrecorded)
}

fn unrecorded(error: InstrumentError) -> Failure {
    Failure::work(error)
}

/// The measured value that ended the optimisation, and its threshold.
fn measured(termination: &Termination) -> (Value, Value) {
    match *termination {
        Termination::CostConverged { relative_decrease, threshold } => {
            (relative_decrease.into(), threshold.into())
        }
        Termination::StepConverged { step, threshold } => (step.into(), threshold.into()),
        Termination::IterationLimit { iterations, limit } => (iterations.into(), limit.into()),
        Termination::Stalled { damping, threshold }
        | Termination::Singular { damping, threshold } => (damping.into(), threshold.into()),
        Termination::NotFinite { chi2 } => (chi2.into(), Value::Null),
        Termination::StartMissing { poses, vertices } => (poses.into(), vertices.into()),
        _ => (Value::Null, Value::Null),
    }
}

fn tell<P: Dimension<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    believed: &FactorGraph<P, D>,
    solved: &Solved<P>,
    certificate: Option<&Certified>,
    args: &OptimizeArgs,
) -> Done {
    let Solved { solution, init, init_time, optimize_time, .. } = solved;
    let (init_time, optimize_time) = (*init_time, *optimize_time);
    // Of several threads only one would be counted.
    let alone = args.threads <= 1;
    let report = &solution.report;
    let log_cost = chi2(believed, &solution.poses, ErrorKind::Log);
    let sesync_cost = sesync_cost(believed, &solution.poses);
    let doubts = solved.doubts.as_ref();
    let rejected = doubts.map_or(&[][..], |doubts| &doubts.rejected);
    let rejected: Vec<Value> = (rejected.iter())
        .map(|&index| {
            let factor = &graph.factors[index];
            let (from, to) = (graph.ids[factor.from], graph.ids[factor.to]);
            let weight = solution.weights[index];
            json!({ "edge": index, "from": from, "to": to, "weight": weight })
        })
        .collect();
    let iterations = doubts.map_or(report.iterations.len(), |doubts| doubts.iterations);
    let (value, threshold) = measured(&report.termination);
    let converged = report.termination.is_converged();
    let policy = &report.information;
    let json = json!({
        "file": args.file.display().to_string(),
        "dimensions": if D == 3 { 2 } else { 3 },
        "poses": graph.ids.len(),
        "edges": graph.factors.len(),
        "components": report.components,
        "init": init,
        "init_trials": solved.trials,
        "chi2_initial": report.chi2_initial,
        "chi2": report.chi2,
        "cost": report.cost,
        "log_cost": log_cost,
        "sesync_cost": sesync_cost,
        "iterations": iterations,
        "termination": report.termination.name(),
        "termination_value": value,
        "termination_threshold": threshold,
        "converged": converged,
        "secs_init": init_time.secs,
        "secs_optimize": optimize_time.secs,
        "cpu_secs_init": alone.then_some(init_time.cpu_secs),
        "cpu_secs_optimize": alone.then_some(optimize_time.cpu_secs),
        "rejected_edges": rejected,
        "noise_scale": doubts.map(|doubts| doubts.noise_scale),
        "gate": doubts.map(|doubts| doubts.gate),
        "certificate": certificate.map(|certificate| certificate.json.clone()),
        "information": {
            "projected": policy.projected,
            "smallest_eigenvalue": policy.smallest_eigenvalue,
            "left_out": policy.left_out,
        },
        "fill": {
            "unknowns": report.fill.unknowns,
            "matrix": report.fill.matrix,
            "factor": report.fill.factor,
        },
    });
    let degrees = D as i64
        * (believed.factors.len() as i64 - graph.ids.len() as i64 + report.components as i64);
    let mut rows = vec![
        ("graph", format!("{} poses, {} edges", graph.ids.len(), graph.factors.len())),
        ("start", format!("{init}, chi2 {}", shown(report.chi2_initial))),
        ("chi2", format!("{:.9} ({degrees} degrees of freedom)", report.chi2)),
        ("log cost", format!("{log_cost:.9}")),
        ("SE-Sync cost", format!("{sesync_cost:.9} (not minimised here)")),
        ("iterations", iterations.to_string()),
        ("ended", format!("{} ({value} against {threshold})", report.termination.name())),
    ];
    if report.components > 1 {
        rows.push(("components", format!("{}, each optimised by itself", report.components)));
    }
    if policy.projected > 0 {
        rows.push((
            "information",
            format!(
                "{} matrices with negative eigenvalues (down to {}), which count as 0",
                policy.projected,
                shown(policy.smallest_eigenvalue)
            ),
        ));
    }
    if !policy.left_out.is_empty() {
        rows.push(("left out", format!("{} edges", policy.left_out.len())));
    }
    if let Some(certificate) = certificate {
        rows.push(("certificate", certificate.text.clone()));
    }
    if let Some(doubts) = doubts {
        rows.push((
            "rejected",
            format!("{} edges of chi2 over {}", rejected.len(), shown(doubts.gate)),
        ));
        let scale = shown(doubts.noise_scale);
        rows.push(("noise scale", format!("{scale} times the variance that the file says")));
    }
    let file = args.file.display();
    let failure = match report.termination {
        Termination::NotFinite { .. } => Some(Failure::Work(anyhow!(
            "{file}: ended with not_finite: measurements times information are too large for floating \
             point numbers; no poses were written"
        ))),
        Termination::Singular { .. } => Some(Failure::Work(anyhow!(
            "{file}: ended with singular: the edges leave poses undetermined, which stay where they started"
        ))),
        _ => None,
    };
    let finite = !matches!(report.termination, Termination::NotFinite { .. });
    Done { json, rows, init_time, optimize_time, finite, failure }
}
