//! Information matrices that are not what they should be.

use pose::nalgebra::{Matrix3, SymmetricEigen};
use pose::{Se2, Se3};
use posegraph::factors::chi2;
use posegraph::initial::odometry;
use posegraph::{ErrorKind, Options, optimize};
use proptest::prelude::*;

use crate::oracle::{Draw, exact, graph};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn an_asymmetric_matrix_counts_as_its_symmetric_part(seed: u64) {
        let even = graph::<Se3, 6>(seed, 8, 6, 0.05);
        let mut skew = even.clone();
        let by = Draw(seed).unit();
        skew.factors[2].information[(0, 4)] += by;
        skew.factors[2].information[(4, 0)] -= by;
        let start = odometry(&even);
        let (a, b) = (optimize(&even, &start, &Options::default()),
            optimize(&skew, &start, &Options::default()));
        prop_assert_eq!(b.report.information.symmetrised, 1);
        prop_assert_eq!(a.report.information.symmetrised, 0);
        prop_assert!((a.report.chi2 - b.report.chi2).abs() <= 1e-9 * (1.0 + a.report.chi2));
    }

    #[test]
    fn an_indefinite_matrix_is_projected(seed: u64, below in 1e-3f64..1e3) {
        let mut odd = graph::<Se3, 6>(seed, 8, 6, 0.05);
        let shift = odd.factors[1].information.symmetric_eigenvalues().min() + below;
        for k in 0..6 {
            odd.factors[1].information[(k, k)] -= shift;
        }
        let eigen = SymmetricEigen::new(odd.factors[1].information);
        let mut mended = odd.clone();
        let clamped = eigen.eigenvalues.map(|value| value.max(0.0));
        mended.factors[1].information = eigen.eigenvectors
            * pose::nalgebra::Matrix6::from_diagonal(&clamped) * eigen.eigenvectors.transpose();
        let start = odometry(&odd);
        let solution = optimize(&odd, &start, &exact(ErrorKind::G2o));
        let policy = &solution.report.information;
        prop_assert_eq!(policy.projected, 1);
        prop_assert!((policy.smallest_eigenvalue + below).abs() <= 1e-9 * (1.0 + below));
        let expected = chi2(&mended, &solution.poses, ErrorKind::G2o);
        prop_assert!((solution.report.chi2 - expected).abs() <= 1e-9 * (1.0 + expected));
    }
}

#[test]
fn semidefinite_matrices_are_left_alone() {
    let mut graph = graph::<Se2, 3>(4, 8, 8, 0.05);
    graph.factors[8].information = Matrix3::from_diagonal(&[3.0, 0.0, 0.0].into());
    let solution = optimize(&graph, &odometry(&graph), &Options::default());
    assert_eq!(solution.report.information.projected, 0);
    assert!(solution.report.termination.is_converged());
}

#[test]
fn factors_that_say_nothing_are_left_out() {
    let clean = graph::<Se2, 3>(9, 10, 8, 0.05);
    let mut dirty = clean.clone();
    let template = dirty.factors[0];
    let mut nan = template;
    nan.information[(1, 1)] = f64::NAN;
    let mut infinite = template;
    infinite.from_from_to.translation.x = f64::INFINITY;
    let nowhere = posegraph::Factor { to: 10, ..template };
    let itself = posegraph::Factor { from: 4, to: 4, ..template };
    dirty.factors.splice(3..3, [nan, infinite, nowhere, itself]);
    let start = odometry(&clean);
    let (a, b) = (
        optimize(&clean, &start, &Options::default()),
        optimize(&dirty, &start, &Options::default()),
    );
    assert_eq!(b.report.information.left_out, [3, 4, 5, 6]);
    assert_eq!(a.poses, b.poses);
    assert_eq!(&b.weights[3..7], [0.0; 4]);
    assert_eq!(a.report.chi2, b.report.chi2);
}

#[test]
fn a_vertex_that_nothing_determines_is_survived() {
    // The last vertex hangs on a factor that weighs its angle only.
    let mut graph = graph::<Se2, 3>(12, 10, 0, 0.05);
    graph.factors[8].information = Matrix3::from_diagonal(&[0.0, 0.0, 5.0].into());
    let start = odometry(&graph);
    let solution = optimize(&graph, &start, &Options::default());
    assert!(solution.report.termination.is_converged(), "{:?}", solution.report.termination);
    assert!(solution.report.chi2 < 1e-12);
}
