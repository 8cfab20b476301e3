//! The default start reaches what a start at the truth reaches.

use pose::Se2;
use pose::nalgebra::Matrix3;
use posegraph::initial::default::Origin;
use posegraph::initial::{asked_start_by, odometry, spanning_tree, surest_tree};
use posegraph::synthetic::{Noise, Sphere, Synthetic, Torus, Walk, sphere, torus, walk};
use posegraph::{
    Factor, FactorGraph, Loss, Options, Rigid, SynchronizeOptions, certify, default_start, optimize,
};

use super::graphs::{noisy2, ring2};

fn reaches<P: Rigid<D>, const D: usize>(made: &Synthetic<P, D>) -> Origin {
    let options = Options::default();
    let found = default_start(&made.graph, &options);
    let known = optimize(&made.graph, &made.truth, &options).report.chi2;
    let chi2 = found.solution.report.chi2;
    assert!(chi2 <= known * (1.0 + 1e-6), "{chi2} against {known}: {:?}", found.trials);
    let again = optimize(&made.graph, &found.poses, &options).report.chi2;
    assert!((again - chi2).abs() <= 1e-6 * chi2);
    found.origin
}

#[test]
fn towns_spheres_and_tori_are_solved() {
    for rotation_rad in [0.01, 0.1] {
        let noise = Noise { translation_m: 0.05, rotation_rad };
        reaches(&walk(&Walk { poses: 300, noise, ..Walk::manhattan() }));
        let params = Sphere { rounds: 8, poses_per_round: 10, noise, ..Default::default() };
        reaches(&sphere(&params));
        let params = Torus { rounds: 8, poses_per_round: 8, noise, ..Default::default() };
        reaches(&torus(&params));
    }
}

/// Where rotations are off by a third of a radian: chordal initialisation ends in another minimum, the
/// relaxation does not, and starts that lead astray are not tried after it.
#[test]
fn tori_of_great_noise_are_solved_without_starts_that_lead_astray() {
    for seed in [1, 3] {
        let noise = Noise { translation_m: 0.1, rotation_rad: 0.4 };
        let made =
            torus(&Torus { rounds: 20, poses_per_round: 20, noise, seed, ..Torus::default() });
        assert_eq!(reaches(&made), Origin::Synchronized);
        let trials = default_start(&made.graph, &Options::default()).trials;
        assert!(trials.iter().all(|trial| trial.origin != Origin::Odometry), "{trials:?}");
        assert!(trials[1].chi2 < trials[0].chi2, "{trials:?}");
    }
}

/// A start that is asked for is the first, not the last: where it leads into another minimum others follow.
#[test]
fn an_asked_start_that_leads_astray_is_followed_by_others() {
    let options = Options::default();
    let mut astray = 0;
    for seed in 0..3 {
        let noise = Noise { translation_m: 0.1, rotation_rad: 0.1 };
        let made =
            torus(&Torus { rounds: 20, poses_per_round: 20, noise, seed, ..Torus::default() });
        let graph = &made.graph;
        let known = default_start(graph, &options).solution.report.chi2;
        let run = |poses: &[_], options: &_| optimize(graph, poses, options);
        let found = asked_start_by(graph, Origin::Odometry, odometry(graph), &options, run);
        let chi2 = found.solution.report.chi2;
        assert!(chi2 <= known * (1.0 + 1e-6), "{chi2} against {known}: {:?}", found.trials);
        assert_eq!(found.trials[0].origin, Origin::Odometry);
        let alone = optimize(graph, &odometry(graph), &options).report.chi2;
        assert_eq!(found.trials[0].chi2, alone);
        let led_astray = alone > known * (1.0 + 1e-6);
        assert_eq!(led_astray, found.origin != Origin::Odometry, "{:?}", found.trials);
        astray += usize::from(led_astray);
    }
    assert!(astray > 0, "odometry leads nowhere else: the test shows nothing");
}

/// Information that claims far too much makes every `χ²` too high; where no loop is bent, that is no reason
/// to look for another minimum.
#[test]
fn boastful_information_alone_raises_no_doubt() {
    let noise = Noise { translation_m: 0.01, rotation_rad: 0.003 };
    let params = Sphere { rounds: 8, poses_per_round: 10, noise, ..Default::default() };
    let mut graph = sphere(&params).graph;
    for factor in &mut graph.factors {
        factor.information *= 1e4;
    }
    let found = default_start(&graph, &Options::default());
    assert!(found.judgement.chi2_per_degree > 100.0);
    assert!(found.judgement.loop_rad > 0.0);
    assert_eq!(found.judgement.doubt, None);
    assert_eq!((found.trials.len(), found.verdict), (1, None));
}

/// Few closures of long loops, as at MIT's Killian Court: what is rarely reached from odometry.
#[test]
fn long_loops_with_few_closures_are_solved() {
    for seed in 0..6 {
        let made = walk(&Walk {
            poses: 500,
            blocks: 3,
            steps_per_block: 15,
            step_m: 2.0,
            closure_probability: 0.1,
            closures_per_pose: 1,
            noise: Noise { translation_m: 0.05, rotation_rad: 0.03 },
            seed,
            ..Walk::manhattan()
        });
        let closures = made.graph.factors.len() - (made.truth.len() - 1);
        assert!((3..120).contains(&closures), "{closures} closures");
        reaches(&made);
    }
}

#[test]
fn the_surest_tree_goes_round_by_what_is_measured_well() {
    let information = |rotation| Matrix3::from_diagonal(&[1.0, 1.0, rotation].into());
    let factor = |from, to, x, rotation| Factor {
        from,
        to,
        from_from_to: Se2::new(x, 0.0, 0.0),
        information: information(rotation),
    };
    let graph = FactorGraph {
        ids: vec![4, 5, 6, 9],
        initial: vec![None; 4],
        fixed: Vec::new(),
        factors: vec![
            factor(0, 2, 7.0, 1.0),
            factor(2, 1, -1.0, 100.0),
            factor(0, 1, 1.0, 100.0),
            // Of this rotation nothing is known, but no other way leads there.
            factor(2, 3, 1.0, 0.0),
        ],
    };
    let x = |poses: Vec<Se2>| poses.iter().map(|pose| pose.translation.x).collect::<Vec<_>>();
    assert_eq!(x(surest_tree(&graph)), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(x(spanning_tree(&graph)), [0.0, 1.0, 7.0, 8.0]);
}

#[test]
fn an_exact_ring_is_not_doubted() {
    let graph = ring2(60);
    let options = Options::default();
    let found = default_start(&graph, &options);
    assert!(found.solution.report.chi2 < 1e-12);
    assert_eq!(found.judgement.doubt, None);
    assert!(found.judgement.loop_rad < 1e-6);
}

#[test]
fn several_fixed_vertices_are_respected() {
    let (mut graph, truth) = noisy2(20, 15, 0.05, 4);
    graph.initial = truth.iter().copied().map(Some).collect();
    graph.fixed = vec![2, 9];
    let found = default_start(&graph, &Options::default());
    assert_eq!(found.solution.poses[2], truth[2]);
    assert_eq!(found.solution.poses[9], truth[9]);
}

#[test]
fn outliers_are_not_trusted() {
    let (graph, _) = noisy2(20, 15, 0.05, 4);
    let options = Options { loss: Loss::Cauchy { width: 2.0 }, ..Default::default() };
    assert_eq!(default_start(&graph, &options).origin, Origin::Odometry);
}

#[test]
fn empty_and_lonely_graphs_are_answered() {
    let mut graph = FactorGraph::<Se2, 3>::default();
    assert!(default_start(&graph, &Options::default()).poses.is_empty());
    graph.ids.push(7);
    graph.initial.push(None);
    assert_eq!(default_start(&graph, &Options::default()).poses.len(), 1);
    let nothing = certify(&graph, &[Se2::identity()], &SynchronizeOptions::default());
    assert_eq!(nothing.verdict.name(), "not_applicable");
}

/// Found by a reader of bad files: sums of such information are infinite, and the test of the
/// certificate widened its bound for ever.
#[test]
fn information_beyond_what_can_be_summed_comes_to_an_end() {
    let edge = |from: usize| Factor {
        from,
        to: from + 1,
        from_from_to: Se2::new(1.0, 0.0, 0.0),
        information: Matrix3::from_diagonal(&[1e308, 1e308, 100.0].into()),
    };
    let graph = FactorGraph {
        ids: vec![0, 1, 2],
        initial: vec![None; 3],
        fixed: Vec::new(),
        factors: vec![edge(0), edge(1)],
    };
    let found = default_start(&graph, &Options::default());
    assert_eq!(found.poses.len(), 3);
    certify(&graph, &found.poses, &SynchronizeOptions::default());
}
