//! The same minimum as the batch optimiser, the same bits every time.

use pose::{Se2, Se3};
use posegraph::factors::chi2;
use posegraph::initial::odometry;
use posegraph::{
    ErrorKind, Factor, FactorGraph, Incremental, IncrementalOptions, Options, optimize,
};
use proptest::prelude::*;

use crate::oracle::{Draw, Drawn, distance, exact, graph};

/// Factors by the vertex with which they become known, those to the vertex before first.
pub fn by_step<P: Copy, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<Vec<Factor<P, D>>> {
    let mut steps = vec![Vec::new(); graph.ids.len()];
    for factor in &graph.factors {
        steps[factor.from.max(factor.to)].push(*factor);
    }
    for (vertex, step) in steps.iter_mut().enumerate() {
        step.sort_by_key(|factor| factor.from.min(factor.to) + 1 != vertex);
    }
    steps
}

/// Options with which every step is solved to the end.
pub fn thorough(error: ErrorKind) -> IncrementalOptions {
    IncrementalOptions { error, relinearise: 1e-10, bend: 0.0, propagate: 0.0, iterations: 30 }
}

fn feed<P: Drawn<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    options: IncrementalOptions,
) -> Incremental<P, D> {
    let mut growing = Incremental::new(options);
    for step in by_step(graph) {
        growing.add(None, &step).unwrap();
    }
    growing
}

fn hold_to_batch<P: Drawn<D>, const D: usize>(seed: u64, vertices: usize, closures: usize) {
    let graph = graph::<P, D>(seed, vertices, closures, 0.05);
    for kind in [ErrorKind::G2o, ErrorKind::Log] {
        let expected = optimize(&graph, &odometry(&graph), &exact(kind));
        let growing = feed(&graph, thorough(kind));
        let far = distance(&growing.poses(), &expected.poses);
        assert!(far < 1e-6, "{kind:?} {far:e}");
        assert!((growing.chi2() - expected.report.chi2).abs() <= 1e-9 * (1.0 + growing.chi2()));

        // One iteration a step leaves it near; finishing ends at the same minimum.
        let mut quick =
            feed(&graph, IncrementalOptions { error: kind, ..IncrementalOptions::default() });
        let report = quick.finish(&exact(kind));
        let far = distance(&quick.poses(), &expected.poses);
        assert!(far < 1e-6, "{kind:?} {far:e} {report:?}");
    }
}

/// Withdraws factors at random and puts some in again; what is left must be at its minimum.
fn hold_withdrawals<P: Drawn<D>, const D: usize>(seed: u64, vertices: usize) {
    let graph = graph::<P, D>(seed, vertices, vertices, 0.05);
    let mut growing = feed(&graph, thorough(ErrorKind::G2o));
    let mut order: Vec<Factor<P, D>> = by_step(&graph).concat();
    let mut used = vec![true; order.len()];
    let draw = &mut Draw(seed ^ 77);
    for _ in 0..6 {
        let index = draw.below(order.len());
        // The chain stays, so that the minimum is the one of the batch.
        let chain = order[index].to == order[index].from + 1;
        if chain {
            continue;
        }
        assert_eq!(growing.withdraw(index).is_ok(), used[index]);
        used[index] = false;
        if draw.unit() > 0.0 {
            let again = Factor { from_from_to: P::drawn(draw, 0.01, 0.01), ..order[index] };
            let (from, to) = (growing.pose(again.from), growing.pose(again.to));
            let measured = from.between(&to).compose(&again.from_from_to);
            let again = Factor { from_from_to: measured, ..again };
            growing.add_factors(&[again]).unwrap();
            order.push(again);
            used.push(true);
        }
    }
    let left: Vec<Factor<P, D>> =
        order.iter().zip(&used).filter(|(_, used)| **used).map(|(factor, _)| *factor).collect();
    let left = FactorGraph { factors: left, ..graph };
    assert_eq!(growing.graph().factors.len(), left.factors.len());
    let expected = optimize(&left, &growing.poses(), &exact(ErrorKind::G2o));
    let far = distance(&growing.poses(), &expected.poses);
    assert!(far < 1e-6, "{far:e}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn graphs_of_the_plane_end_where_the_batch_does(
        seed: u64, vertices in 2usize..40, closures in 0usize..40,
    ) {
        hold_to_batch::<Se2, 3>(seed, vertices, closures);
    }

    #[test]
    fn graphs_of_space_end_where_the_batch_does(
        seed: u64, vertices in 2usize..20, closures in 0usize..20,
    ) {
        hold_to_batch::<Se3, 6>(seed, vertices, closures);
    }

    #[test]
    fn withdrawn_factors_leave_no_trace(seed: u64, vertices in 4usize..25) {
        hold_withdrawals::<Se2, 3>(seed, vertices);
        hold_withdrawals::<Se3, 6>(seed, vertices.min(12));
    }

    #[test]
    fn the_same_steps_give_the_same_bits(seed: u64, vertices in 2usize..40) {
        let graph = graph::<Se2, 3>(seed, vertices, vertices, 0.1);
        let (a, b) = (feed(&graph, IncrementalOptions::default()),
                      feed(&graph, IncrementalOptions::default()));
        prop_assert_eq!(a.poses(), b.poses());
        prop_assert_eq!(a.chi2().to_bits(), b.chi2().to_bits());
    }
}

#[test]
fn a_town_is_followed_closely_and_finished_exactly() {
    let graph = posegraph::synthetic::manhattan(400, 3).graph;
    let steps = by_step(&graph);
    let mut growing = Incremental::new(IncrementalOptions::default());
    let mut refactored = 0;
    for step in &steps {
        refactored += growing.add(None, step).unwrap().refactored;
    }
    let batch = optimize(&graph, &growing.poses(), &Options::default()).report.chi2;
    assert!((growing.chi2() - batch) / batch < 1e-3, "{} {batch}", growing.chi2());
    // From scratch every step would eliminate all poses.
    assert!(refactored < 400 * 400 / 4, "{refactored}");
    let report = growing.finish(&Options::default());
    assert!(report.termination.is_converged());
    assert!(((chi2(&graph, &growing.poses(), ErrorKind::G2o) - batch) / batch).abs() < 1e-7);
}

/// Real graphs hold matches along walls: next to nothing is known along them, all but everything across.
#[test]
fn stiff_factors_are_followed_as_closely() {
    let mut graph = posegraph::synthetic::manhattan(300, 5).graph;
    for factor in graph.factors.iter_mut().step_by(40) {
        factor.information[(0, 0)] *= 1e9;
    }
    let mut growing = Incremental::new(IncrementalOptions::default());
    for step in by_step(&graph) {
        growing.add(None, &step).unwrap();
    }
    let batch = optimize(&graph, &growing.poses(), &exact(ErrorKind::G2o)).report.chi2;
    let gap = (growing.chi2() - batch) / batch;
    assert!(gap < 1e-4, "{gap:e}");
}
