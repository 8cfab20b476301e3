//! Small graphs against dense normal equations with numeric Jacobians.

use pose::{Se2, Se3};
use posegraph::factors::chi2;
use posegraph::initial::odometry;
use posegraph::{Options, Solver, optimize};
use proptest::prelude::*;

use crate::oracle::{Drawn, KINDS, dense_solution, distance, exact, graph};

fn hold_to_dense<P: Drawn<D>, const D: usize>(seed: u64, vertices: usize, closures: usize) {
    let graph = graph::<P, D>(seed, vertices, closures, 0.05);
    let start = odometry(&graph);
    for kind in KINDS {
        let expected = dense_solution(&graph, &start, kind);
        for solver in [Solver::GaussNewton, Solver::LevenbergMarquardt, Solver::Dogleg] {
            let solution = optimize(&graph, &start, &Options { solver, ..exact(kind) });
            let far = distance(&solution.poses, &expected);
            assert!(far < 1e-6, "{kind:?} {solver:?} {far:e} {:?}", solution.report);
            let cost = chi2(&graph, &solution.poses, kind);
            assert_eq!(cost.to_bits(), solution.report.chi2.to_bits(), "{kind:?} {solver:?}");
            let best = chi2(&graph, &expected, kind);
            assert!((cost - best).abs() <= 1e-9 * (1.0 + best), "{kind:?} {solver:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn graphs_of_the_plane_reach_the_dense_solution(
        seed: u64, vertices in 2usize..12, closures in 0usize..12,
    ) {
        hold_to_dense::<Se2, 3>(seed, vertices, closures);
    }

    #[test]
    fn graphs_of_space_reach_the_dense_solution(
        seed: u64, vertices in 2usize..9, closures in 0usize..8,
    ) {
        hold_to_dense::<Se3, 6>(seed, vertices, closures);
    }
}
