//! Marginals against the inverse of dense normal equations with numeric Jacobians.

use pose::nalgebra::{DMatrix, SMatrix};
use pose::{Se2, Se3};
use posegraph::initial::odometry;
use posegraph::{ErrorKind, FactorGraph, Incremental, Marginals, PoseGraphError, optimize};
use proptest::prelude::*;

use crate::against_batch::{by_step, thorough};
use crate::oracle::{Drawn, central, exact, graph};

/// The covariance of all vertices with vertex `held` held; its rows and columns are 0.
fn dense_covariance<P: Drawn<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    poses: &[P],
    kind: ErrorKind,
    held: usize,
) -> DMatrix<f64> {
    let size = poses.len() * D;
    let mut matrix = DMatrix::<f64>::zeros(size, size);
    for factor in &graph.factors {
        let mut jacobian = DMatrix::<f64>::zeros(D, size);
        for vertex in [factor.from, factor.to] {
            let by = central(|delta| {
                let mut moved = [poses[factor.from], poses[factor.to]];
                let end = usize::from(vertex == factor.to);
                moved[end] = moved[end].retract(&delta);
                P::error(kind, &factor.from_from_to, &moved[0], &moved[1])
            });
            jacobian.view_mut((0, vertex * D), (D, D)).copy_from(&by);
        }
        matrix += jacobian.transpose() * factor.information * jacobian;
    }
    let free = matrix.remove_rows(held * D, D).remove_columns(held * D, D);
    let inverse = free.try_inverse().unwrap();
    inverse.insert_rows(held * D, D, 0.0).insert_columns(held * D, D, 0.0)
}

fn block<const D: usize>(matrix: &DMatrix<f64>, row: usize, column: usize) -> SMatrix<f64, D, D> {
    matrix.fixed_view::<D, D>(row * D, column * D).into_owned()
}

/// How far apart two blocks are, as a share of the larger of 1e-3 and the expected one.
fn gap<const D: usize>(found: &SMatrix<f64, D, D>, expected: &SMatrix<f64, D, D>) -> f64 {
    (found - expected).amax() / expected.amax().max(1e-3)
}

/// The oracle's Jacobians by central differences are good to about 1e-10.
const NEAR: f64 = 1e-9;

fn hold_to_dense<P: Drawn<D>, const D: usize>(seed: u64, vertices: usize, closures: usize) {
    let mut graph = graph::<P, D>(seed, vertices, closures, 0.05);
    let held = seed as usize % vertices;
    graph.fixed = vec![held];
    for kind in [ErrorKind::G2o, ErrorKind::Log] {
        let poses = optimize(&graph, &odometry(&graph), &exact(kind)).poses;
        let expected = dense_covariance(&graph, &poses, kind, held);
        let marginals = Marginals::new(&graph, &poses, kind).unwrap();
        let all = marginals.all();
        assert_eq!(marginals.covariance(held).unwrap(), SMatrix::<f64, D, D>::zeros());
        for (a, of_a) in all.iter().enumerate() {
            let expected_a = block(&expected, a, a);
            assert!(gap(&marginals.covariance(a).unwrap(), &expected_a) < NEAR);
            assert!(gap(of_a, &expected_a) < NEAR);
            let b = (a * 7 + 3) % vertices;
            let joint = marginals.joint(a, b).unwrap();
            assert!(gap(&joint.b_a, &block(&expected, b, a)) < NEAR, "{a} {b}");
            assert!(gap(&joint.a_a, &expected_a) < NEAR);
            assert!(gap(&joint.b_b, &block(&expected, b, b)) < NEAR);
            // Held at `a`, the covariance of `b` is that of the relative pose.
            let relative = block(&dense_covariance(&graph, &poses, kind, a), b, b);
            assert!(gap(&marginals.relative(a, b).unwrap(), &relative) < NEAR, "{a} {b}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn marginals_of_the_plane_are_blocks_of_the_inverse(
        seed: u64, vertices in 2usize..20, closures in 0usize..20,
    ) {
        hold_to_dense::<Se2, 3>(seed, vertices, closures);
    }

    #[test]
    fn marginals_of_space_are_blocks_of_the_inverse(
        seed: u64, vertices in 2usize..10, closures in 0usize..10,
    ) {
        hold_to_dense::<Se3, 6>(seed, vertices, closures);
    }

    #[test]
    fn a_growing_graph_knows_its_marginals(seed: u64, vertices in 2usize..25) {
        let graph = graph::<Se2, 3>(seed, vertices, vertices, 0.05);
        let mut growing = Incremental::new(thorough(ErrorKind::G2o));
        for step in by_step(&graph) {
            growing.add(None, &step).unwrap();
        }
        let marginals = Marginals::new(&graph, &growing.poses(), ErrorKind::G2o).unwrap();
        for a in 0..vertices {
            let b = (a * 5 + 2) % vertices;
            let (found, expected) =
                (growing.covariance(a).unwrap(), marginals.covariance(a).unwrap());
            prop_assert!(gap(&found, &expected) < 1e-7);
            let (found, expected) =
                (growing.relative_covariance(a, b).unwrap(), marginals.relative(a, b).unwrap());
            prop_assert!(gap(&found, &expected) < 1e-7);
            let joint = growing.joint_covariance(a, b).unwrap();
            prop_assert!(gap(&joint.b_a, &marginals.joint(a, b).unwrap().b_a) < 1e-7);
        }
        prop_assert!(growing.covariance(vertices).is_none());
    }
}

#[test]
fn what_is_not_determined_has_no_covariance() {
    let mut graph = graph::<Se2, 3>(1, 4, 0, 0.05);
    let poses = odometry(&graph);
    let short = PoseGraphError::PosesMissing { poses: 3, vertices: 4 };
    assert_eq!(Marginals::new(&graph, &poses[..3], ErrorKind::G2o).unwrap_err(), short);
    graph.factors[2].information.fill_column(1, 0.0);
    graph.factors[2].information.fill_row(1, 0.0);
    let error = Marginals::new(&graph, &poses, ErrorKind::G2o).unwrap_err();
    assert_eq!(error, PoseGraphError::Undetermined { directions: 1 });
}
