//! Wrong optima are never called optimal, and the staircase leads out of them.

use pose::nalgebra::{UnitQuaternion, Vector3};
use pose::{Se2, Se3};
use posegraph::synthetic::{Noise, Sphere, sphere};
use posegraph::{FactorGraph, Rigid, SynchronizeOptions, Verdict, certify};
use proptest::prelude::*;

use super::graphs::{Numbers, anywhere, noisy2, noisy3, ring2, ring3};
use super::oracle::smallest_eigenvalue;

/// Descent at rank `d` only.
fn stay<P: Rigid<D>, const D: usize>() -> SynchronizeOptions {
    SynchronizeOptions { max_rank: P::DIM, ..Default::default() }
}

#[test]
fn a_ring_wound_once_too_often_is_not_certified() {
    let count = 30;
    let graph = ring2(count);
    for turns in [-1.0, 2.0, 3.0] {
        let step = turns * std::f64::consts::TAU / count as f64;
        let mut start = vec![Se2::identity()];
        for k in 1..count {
            let last = start[k - 1];
            start.push(last * Se2::new(1.0, 0.0, step));
        }
        let stuck = certify(&graph, &start, &stay::<Se2, 3>());
        assert_eq!(stuck.verdict, Verdict::NotCertified, "{turns} turns");
        assert!(stuck.sesync_cost > 1.0, "the start left its valley");
        let dense = smallest_eigenvalue(&graph, &stuck.poses);
        assert!(dense < 0.0);
        assert!(
            (stuck.smallest_eigenvalue - dense).abs() <= stuck.precision + 1e-6 * dense.abs(),
            "{} against {dense}",
            stuck.smallest_eigenvalue
        );
        let free = certify(&graph, &start, &SynchronizeOptions::default());
        assert_eq!(free.verdict, Verdict::GloballyOptimal, "{}", free.reason);
        assert!(free.rank > 2 && free.sesync_cost < 1e-9, "{}", free.sesync_cost);
    }
}

#[test]
fn a_ring_of_space_turned_once_too_often_is_not_certified() {
    let count = 24;
    let graph = ring3(count);
    let step = 2.0 * std::f64::consts::TAU / count as f64;
    let start: Vec<Se3> = (0..count)
        .map(|k| {
            let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, step * k as f64);
            Se3::new(Vector3::new(k as f64, 0.0, 0.0), turn)
        })
        .collect();
    let stuck = certify(&graph, &start, &stay::<Se3, 6>());
    assert_eq!(stuck.verdict, Verdict::NotCertified);
    assert!(stuck.sesync_cost > 1.0, "the start left its valley");
    let free = certify(&graph, &start, &SynchronizeOptions::default());
    assert_eq!(free.verdict, Verdict::GloballyOptimal, "{}", free.reason);
    assert!(free.sesync_cost < 1e-9);
}

#[test]
fn a_sphere_with_flipped_rounds_is_not_certified_unless_it_unflips() {
    let params = Sphere {
        rounds: 6,
        poses_per_round: 10,
        noise: Noise { translation_m: 0.1, rotation_rad: 0.05 },
        ..Default::default()
    };
    let made = sphere(&params);
    let best = certify(&made.graph, &made.truth, &SynchronizeOptions::default());
    assert_eq!(best.verdict, Verdict::GloballyOptimal, "{}", best.reason);
    let mut wrong = 0;
    for axis in [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()] {
        for from in [20, 30, 40] {
            // Everything beyond a round is turned by half a turn.
            let half = UnitQuaternion::from_axis_angle(&axis, std::f64::consts::PI);
            let flipped: Vec<Se3> = (made.truth.iter().enumerate())
                .map(|(k, pose)| {
                    let turn = if k < from { UnitQuaternion::identity() } else { half };
                    Se3::new(turn * pose.translation, pose.rotation * turn)
                })
                .collect();
            let found = certify(&made.graph, &flipped, &stay::<Se3, 6>());
            let worse = found.sesync_cost > best.sesync_cost * (1.0 + 1e-5);
            assert_eq!(found.verdict == Verdict::NotCertified, worse, "{}", found.reason);
            wrong += usize::from(worse);
            let free = certify(&made.graph, &flipped, &SynchronizeOptions::default());
            assert_eq!(free.verdict, Verdict::GloballyOptimal, "{}", free.reason);
        }
    }
    assert!(wrong > 0, "no flipped start ended in a wrong optimum");
}

/// From any start: what is certified costs no more than anything else that was found.
fn sound<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    truth: &[P],
    starts: &[Vec<P>],
) -> Result<(), TestCaseError> {
    let options = SynchronizeOptions { max_rank: P::DIM + 2, ..Default::default() };
    let mut found = vec![certify(graph, truth, &options)];
    found.extend(starts.iter().map(|start| certify(graph, start, &stay::<P, D>())));
    let lowest = found.iter().map(|found| found.sesync_cost).fold(f64::INFINITY, f64::min);
    for found in &found {
        if found.verdict == Verdict::GloballyOptimal {
            prop_assert!(found.sesync_cost <= lowest * (1.0 + 2e-6) + 1e-9);
            prop_assert!(found.sesync_cost - found.gap <= lowest * (1.0 + 1e-9) + 1e-9);
        } else if found.gap.is_finite() {
            prop_assert!(found.sesync_cost - found.gap <= lowest * (1.0 + 1e-6) + 1e-9);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn nothing_costs_less_than_what_is_certified_in_the_plane(
        seed in 0u64..1_000_000, noise in 0.0..0.6f64
    ) {
        let (graph, truth) = noisy2(9, 5, noise, seed);
        let mut numbers = Numbers(seed ^ 77);
        let starts: Vec<Vec<Se2>> = (0..4)
            .map(|_| (0..9).map(|_| {
                Se2::new(4.0 * numbers.next(), 4.0 * numbers.next(), 3.1 * numbers.next())
            }).collect())
            .collect();
        sound(&graph, &truth, &starts)?;
    }

    #[test]
    fn nothing_costs_less_than_what_is_certified_in_space(
        seed in 0u64..1_000_000, noise in 0.0..0.6f64
    ) {
        let (graph, truth) = noisy3(7, 4, noise, seed);
        let mut numbers = Numbers(seed ^ 78);
        let starts: Vec<Vec<Se3>> =
            (0..3).map(|_| (0..7).map(|_| anywhere(&mut numbers)).collect()).collect();
        sound(&graph, &truth, &starts)?;
    }
}
