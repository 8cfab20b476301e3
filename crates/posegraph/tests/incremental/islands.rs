//! Parts that hang together with nothing, parts that join, factors that are no good.

use pose::nalgebra::Matrix3;
use pose::{Se2, Se3};
use posegraph::initial::odometry;
use posegraph::{
    ErrorKind, Factor, FactorGraph, Incremental, IncrementalOptions, PoseGraphError, optimize,
};
use proptest::prelude::*;

use crate::against_batch::thorough;
use crate::oracle::{Drawn, distance, exact, graph};

/// Two chains that know nothing of each other until a factor joins them.
fn hold_joining<P: Drawn<D>, const D: usize>(seed: u64, length: usize, forward: bool) {
    let (a, b) = (graph::<P, D>(seed, length, 3, 0.03), graph::<P, D>(seed + 1, length, 3, 0.03));
    let mut factors = a.factors.clone();
    factors.extend(b.factors.iter().map(|factor| Factor {
        from: factor.from + length,
        to: factor.to + length,
        ..*factor
    }));
    let (near, far) = (length / 2, 2 * length - 1);
    let template = a.factors[0];
    let joining = if forward {
        Factor { from: near, to: far, ..template }
    } else {
        Factor { from: far, to: near, ..template }
    };
    let mut growing = Incremental::new(thorough(ErrorKind::G2o));
    for vertex in 0..2 * length {
        let step: Vec<Factor<P, D>> =
            factors.iter().filter(|f| f.from.max(f.to) == vertex).copied().collect();
        growing.add(None, &step).unwrap();
    }
    assert_eq!(growing.graph().fixed, [0, length]);
    let apart = growing.chi2();
    growing.add_factors(&[joining]).unwrap();
    assert_eq!(growing.graph().fixed, [0]);
    // Nothing contradicts the new factor.
    assert!((growing.chi2() - apart).abs() < 1e-9 * (1.0 + apart), "{} {apart}", growing.chi2());
    let seen = growing.pose(joining.from).between(&growing.pose(joining.to));
    assert!(joining.from_from_to.local(&seen).amax() < 1e-6);

    factors.push(joining);
    let count = 2 * length;
    let whole = FactorGraph {
        ids: (0..count as u64).collect(),
        initial: vec![None; count],
        fixed: Vec::new(),
        factors,
    };
    let expected = optimize(&whole, &growing.poses(), &exact(ErrorKind::G2o));
    assert!(distance(&growing.poses(), &expected.poses) < 1e-6);

    // Withdrawn, both parts stay where they are, each held again.
    let before = growing.poses();
    growing.withdraw(whole.factors.len() - 1).unwrap();
    assert_eq!(growing.graph().fixed, [0, length]);
    assert!(distance(&growing.poses(), &before) < 1e-6);
    assert!((growing.chi2() - apart).abs() < 1e-9 * (1.0 + apart));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn islands_join_rigidly_and_part_again(
        seed in 0..u64::MAX - 1, length in 2usize..8, forward: bool,
    ) {
        hold_joining::<Se2, 3>(seed, length, forward);
        hold_joining::<Se3, 6>(seed, length, forward);
    }
}

fn step(from: usize, to: usize) -> Factor<Se2, 3> {
    Factor { from, to, from_from_to: Se2::new(1.0, 0.0, 0.1), information: Matrix3::identity() }
}

#[test]
fn what_cannot_be_added_changes_nothing() {
    let mut growing = Incremental::new(IncrementalOptions::default());
    growing.add(None, &[]).unwrap();
    growing.add(None, &[step(0, 1)]).unwrap();
    let ends = |from, to, len| PoseGraphError::FactorEnds { from, to, len };
    assert_eq!(growing.add(None, &[step(1, 2), step(2, 3)]), Err(ends(2, 3, 3)));
    assert_eq!(growing.add_factors(&[step(1, 1)]), Err(ends(1, 1, 2)));
    let mut broken = step(0, 1);
    broken.information[(0, 0)] = f64::NAN;
    let error = PoseGraphError::FactorNotFinite { from: 0, to: 1 };
    assert_eq!(growing.add_factors(&[broken]), Err(error));
    assert!(growing.add(Some(Se2::new(f64::INFINITY, 0.0, 0.0)), &[]).is_err());
    assert_eq!((growing.len(), growing.graph().factors.len()), (2, 1));
    assert_eq!(growing.withdraw(1), Err(PoseGraphError::UnknownFactor { factor: 1, len: 1 }));
    growing.withdraw(0).unwrap();
    assert_eq!(growing.withdraw(0), Err(PoseGraphError::UnknownFactor { factor: 0, len: 1 }));
}

#[test]
fn directions_without_information_stay_where_they_are() {
    let mut growing = Incremental::new(IncrementalOptions::default());
    growing.add(None, &[]).unwrap();
    let mut blind = step(0, 1);
    blind.information[(2, 2)] = 0.0;
    growing.add(Some(Se2::new(0.5, 0.0, 0.7)), &[blind]).unwrap();
    let pose = growing.pose(1);
    assert!((pose.translation - Se2::new(1.0, 0.0, 0.0).translation).norm() < 1e-9, "{pose:?}");
    assert!((pose.angle() - 0.7).abs() < 1e-9);
}

#[test]
fn a_chain_is_where_its_odometry_says() {
    let chain = graph::<Se3, 6>(5, 30, 0, 0.1);
    let mut growing = Incremental::new(IncrementalOptions::default());
    growing.add(None, &[]).unwrap();
    for factor in &chain.factors {
        let update = growing.add(None, &[*factor]).unwrap();
        assert!(update.refactored < 8, "{update:?}");
    }
    assert!(distance(&growing.poses(), &odometry(&chain)) < 1e-9);
    assert!(growing.chi2() < 1e-18);
}
