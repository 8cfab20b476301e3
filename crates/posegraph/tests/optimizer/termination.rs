//! Every way in which an optimisation can end, and what a probe sees of it.

use pose::{Se2, Se3};
use posegraph::factors::chi2;
use posegraph::initial::odometry;
use posegraph::synthetic::{Lattice, city, lattice, manhattan};
use posegraph::{
    FactorGraph, FactorGraph2, Loss, LossOn, Manifold, OptimizerEvent, Options, Solver,
    Termination, optimize, optimize_with,
};
use probe::Probe;

use crate::oracle::{Draw, Drawn, graph};

#[test]
fn the_limit_of_iterations_is_kept() {
    let graph = graph::<Se2, 3>(31, 30, 20, 0.3);
    let start = odometry(&graph);
    for solver in [Solver::GaussNewton, Solver::LevenbergMarquardt, Solver::Dogleg] {
        let options = Options { solver, max_iterations: 1, ..Options::default() };
        let solution = optimize(&graph, &start, &options);
        let expected = Termination::IterationLimit { iterations: 1, limit: 1 };
        assert_eq!(solution.report.termination, expected);
        assert!(!expected.is_converged());
        assert_eq!(solution.report.iterations.len(), 1);
    }
    let options = Options { max_iterations: 0, ..Options::default() };
    assert_eq!(optimize(&graph, &start, &options).poses, start);
}

#[test]
fn a_graph_without_anything_to_move_is_done() {
    let empty = FactorGraph2::default();
    let solution = optimize(&empty, &[], &Options::default());
    assert_eq!(solution.report.termination, Termination::NothingToDo);
    let mut held = graph::<Se2, 3>(32, 4, 2, 0.1);
    held.fixed = vec![0, 1, 2, 3];
    let start = odometry(&held);
    let solution = optimize(&held, &start, &Options::default());
    assert_eq!(solution.report.termination, Termination::NothingToDo);
    assert_eq!(solution.poses, start);
    assert!(solution.report.chi2 > 0.0);
}

#[test]
fn a_start_that_is_none_is_told() {
    let graph = graph::<Se2, 3>(33, 4, 2, 0.1);
    let mut start = odometry(&graph);
    let solution = optimize(&graph, &start[1..], &Options::default());
    let expected = Termination::StartMissing { poses: 3, vertices: 4 };
    assert_eq!(solution.report.termination, expected);
    start[2].translation.x = f64::NAN;
    let solution = optimize(&graph, &start, &Options::default());
    assert!(matches!(solution.report.termination, Termination::NotFinite { .. }));
}

#[test]
fn damped_solvers_never_raise_the_cost() {
    let graph = graph::<Se2, 3>(34, 60, 40, 0.5);
    let start = odometry(&graph);
    for solver in [Solver::LevenbergMarquardt, Solver::Dogleg] {
        let options = Options {
            solver,
            loss: Loss::Cauchy { width: 2.0 },
            loss_on: LossOn::All,
            ..Options::default()
        };
        let report = optimize(&graph, &start, &options).report;
        for pair in report.iterations.windows(2) {
            let after = if pair[0].accepted { pair[0].cost } else { pair[0].cost_before };
            assert!(pair[1].cost_before == after && after <= pair[0].cost_before, "{solver:?}");
        }
        assert!(report.termination.is_converged(), "{solver:?} {:?}", report.termination);
    }
}

#[derive(Default)]
struct Seen {
    started: usize,
    costs: Vec<f64>,
    finished: Option<f64>,
}

impl Probe<OptimizerEvent<'_, Se2>> for Seen {
    fn emit(&mut self, event: OptimizerEvent<'_, Se2>) {
        match event {
            OptimizerEvent::Started { poses, factor_chi2, weights, fill } => {
                assert_eq!((poses.len(), factor_chi2.len()), (20, weights.len()));
                assert_eq!(fill.unknowns, 57);
                assert!(fill.factor >= fill.matrix);
                self.started += 1;
                self.costs.push(factor_chi2.iter().sum());
            }
            OptimizerEvent::Iterated { iteration, factor_chi2, .. } => {
                assert_eq!(iteration.index, self.costs.len());
                let before = self.costs[self.costs.len() - 1];
                assert!((iteration.cost_before - before).abs() <= 1e-12 * before);
                self.costs.push(factor_chi2.iter().sum());
            }
            OptimizerEvent::Finished { report } => self.finished = Some(report.chi2),
        }
    }
}

#[test]
fn a_probe_sees_every_iteration_and_changes_nothing() {
    let graph = graph::<Se2, 3>(35, 20, 15, 0.1);
    let start = odometry(&graph);
    let mut seen = Seen::default();
    let watched = optimize_with(&graph, &start, &Options::default(), &mut seen);
    assert_eq!(watched, optimize(&graph, &start, &Options::default()));
    assert_eq!((seen.started, seen.costs.len()), (1, watched.report.iterations.len() + 1));
    let (last, finished) = (seen.costs[seen.costs.len() - 1], seen.finished.unwrap());
    assert!((last - finished).abs() <= 1e-12 * finished);
}

#[test]
fn wild_starts_end_somewhere_and_never_above_where_they_began() {
    for seed in 0..12 {
        let graph = graph::<Se3, 6>(seed, 40, 60, 0.3);
        let draw = &mut Draw(seed);
        let start: Vec<Se3> = (0..40).map(|_| Se3::drawn(draw, 100.0, 3.1)).collect();
        for solver in [Solver::GaussNewton, Solver::LevenbergMarquardt, Solver::Dogleg] {
            let options = Options { solver, max_iterations: 60, ..Options::default() };
            let solution = optimize(&graph, &start, &options);
            let report = solution.report;
            assert!(report.chi2 <= report.chi2_initial, "{seed} {solver:?} {report:?}");
            assert!(solution.poses.iter().all(Manifold::is_finite), "{seed} {solver:?}");
            let cost = chi2(&graph, &solution.poses, options.error);
            assert!((cost - report.chi2).abs() <= 1e-9 * cost, "{seed} {solver:?}");
        }
    }
}

/// The default may end by a step that was not solved to the last digit; nothing of it is seen.
fn hold_to_the_strictest<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) {
    let start = odometry(graph);
    let found = optimize(graph, &start, &Options::default());
    let strict = Options { relative_decrease: 0.0, ..Options::default() };
    let best = optimize(graph, &start, &strict);
    assert!(found.report.termination.is_converged(), "{:?}", found.report.termination);
    let gap = found.report.chi2 / best.report.chi2 - 1.0;
    assert!(gap.abs() < 2e-9, "{gap:e} of {}", best.report.chi2);
    let apart = found.poses.iter().zip(&best.poses).map(|(a, b)| a.local(b).amax());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart < 0.01, "{apart} m or rad apart");
}

#[test]
fn the_default_ends_where_the_strictest_threshold_does() {
    for seed in 1..4 {
        hold_to_the_strictest(&manhattan(600, seed).graph);
        hold_to_the_strictest(&city(900, seed).graph);
        hold_to_the_strictest(&lattice(&Lattice { side: 5, seed, ..Lattice::default() }).graph);
    }
}
