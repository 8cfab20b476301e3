//! Wrong loop closures are found, and where there are none nothing changes.

use pose::{Se2, Se3};
use posegraph::initial::odometry;
use posegraph::robust::closures;
use posegraph::synthetic::{
    Lattice, Noise, Ring, Sphere, WithOutliers, Wrong, lattice, manhattan, ring, sphere,
    with_outliers, with_wrong_closures,
};
use posegraph::{FactorGraph, Options, Rigid, Robust, RobustSolution, optimize, optimize_robust};
use probe::Off;

/// Methods that settle who is believed.
const SETTLING: [Robust; 3] = [Robust::GncTls, Robust::GncGm, Robust::Pcm];

fn solve<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    robust: Robust,
) -> RobustSolution<P> {
    optimize_robust(graph, &odometry(graph), robust, &Options::default(), &mut Off)
}

/// The largest distance of positions.
fn apart<P: Rigid<D>, const D: usize>(a: &[P], b: &[P]) -> f64 {
    let at = |pose: &P| pose.columns()[P::DIM];
    let far = a.iter().zip(b).map(|(a, b)| {
        let (a, b) = (at(a), at(b));
        (0..P::DIM).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    });
    far.fold(0.0, f64::max)
}

fn town(seed: u64) -> FactorGraph<Se2, 3> {
    manhattan(400, seed).graph
}

fn ball() -> FactorGraph<Se3, 6> {
    let noise = Noise { translation_m: 0.05, rotation_rad: 0.01 };
    sphere(&Sphere { rounds: 12, poses_per_round: 20, noise, ..Sphere::default() }).graph
}

fn wrong_among<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    share: f64,
    seed: u64,
) -> WithOutliers<P, D> {
    let clean = optimize(graph, &odometry(graph), &Options::default());
    with_outliers(graph, &clean.poses, share, seed)
}

#[test]
fn wrong_closures_are_as_many_as_asked_and_nothing_else_changes() {
    let graph = town(1);
    let genuine = closures(&graph).into_iter().filter(|closes| *closes).count();
    for share in [0.1, 0.3, 0.5] {
        let made = wrong_among(&graph, share, 7);
        let wanted = genuine as f64 * share / (1.0 - share);
        assert!((made.wrong.len() as f64 - wanted).abs() <= 0.5);
        assert_eq!(made.graph.factors[..graph.factors.len()], graph.factors[..]);
        assert_eq!(made.wrong[0], graph.factors.len());
        let closes = closures(&made.graph);
        assert!(made.wrong.iter().all(|&index| closes[index]));
    }
    assert_eq!(wrong_among(&graph, 0.3, 7), wrong_among(&graph, 0.3, 7));
    assert_ne!(wrong_among(&graph, 0.3, 7), wrong_among(&graph, 0.3, 8));
}

#[test]
fn without_wrong_closures_the_result_is_the_plain_one() {
    let graph = town(2);
    let plain = optimize(&graph, &odometry(&graph), &Options::default());
    for robust in SETTLING.into_iter().chain([Robust::None]) {
        let found = solve(&graph, robust);
        assert_eq!(found.rejected, [], "{}", robust.name());
        assert!(apart(&found.solution.poses, &plain.poses) < 1e-4, "{}", robust.name());
        assert!((found.noise_scale - 1.0).abs() < 0.2, "{}", found.noise_scale);
    }
}

#[test]
fn weights_are_shares() {
    let made = wrong_among(&town(3), 0.3, 1);
    for robust in Robust::ALL {
        let found = solve(&made.graph, robust);
        let count = made.graph.factors.len();
        assert_eq!(found.solution.weights.len(), count);
        assert!(found.solution.weights.iter().all(|weight| (0.0..=1.0).contains(weight)));
        assert!(found.rejected.is_sorted() && found.rejected.iter().all(|&index| index < count));
        let closes = closures(&made.graph);
        assert!(found.rejected.iter().all(|&index| closes[index]), "only closures are rejected");
    }
}

fn all_found<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>, methods: &[Robust]) {
    let clean = optimize(graph, &odometry(graph), &Options::default());
    for share in [0.1, 0.3, 0.5] {
        let made = with_outliers(graph, &clean.poses, share, 11);
        for &robust in methods {
            let found = solve(&made.graph, robust);
            let hits = found.rejected.iter().filter(|index| made.wrong.contains(index)).count();
            let name = robust.name();
            assert!(hits as f64 >= 0.95 * made.wrong.len() as f64, "{name} {share}: recall");
            assert!(hits as f64 >= 0.95 * found.rejected.len() as f64, "{name} {share}: precision");
            assert!(apart(&found.solution.poses, &clean.poses) < 0.5, "{name} {share}");
        }
    }
}

#[test]
fn the_wrong_closures_of_a_town_are_named() {
    all_found(&town(4), &[Robust::GncTls, Robust::Pcm]);
}

#[test]
fn the_wrong_closures_of_a_sphere_are_named() {
    all_found(&ball(), &[Robust::GncTls, Robust::Pcm]);
}

/// Every wrong closure, and nothing else, at these shares.
fn exactly_found<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>, wrong: Wrong) {
    let clean = optimize(graph, &odometry(graph), &Options::default());
    for share in [0.1, 0.3] {
        let made = with_wrong_closures(graph, &clean.poses, share, 12, wrong);
        let found = solve(&made.graph, Robust::GncTls);
        assert_eq!(found.rejected, made.wrong, "{share}");
        let judgement = made.judge(&found, &clean.poses);
        assert!(judgement.success() && judgement.precision == 1.0 && judgement.recall == 1.0);
    }
}

#[test]
fn few_genuine_closures_are_all_kept() {
    let mut graph = town(7);
    let closes = closures(&graph);
    let mut index = 0;
    graph.factors.retain(|_| {
        index += 1;
        !closes[index - 1] || index % 8 == 0
    });
    exactly_found(&graph, Wrong::Anywhere);
}

#[test]
fn the_only_closure_of_a_ring_is_believed() {
    for seed in 1..=6 {
        let graph = ring(&Ring { seed, ..Ring::default() }).graph;
        for robust in SETTLING {
            assert!(solve(&graph, robust).rejected.is_empty(), "{} {seed}", robust.name());
        }
    }
}

#[test]
fn places_that_look_alike_are_told_apart() {
    exactly_found(&town(8), Wrong::Alike);
}

#[test]
fn coarse_noise_leaves_no_witnesses_and_still_the_wrong_ones_are_named() {
    let noise = Noise { translation_m: 0.1, rotation_rad: 0.15 };
    let coarse = Lattice { side: 5, spacing_m: 1.0, closure_probability: 0.7, noise, seed: 2 };
    exactly_found(&lattice(&coarse).graph, Wrong::Anywhere);
}

#[test]
fn the_scale_of_the_noise_is_found_whatever_the_information_matrices_claim() {
    let honest = wrong_among(&town(5), 0.3, 2);
    let found = solve(&honest.graph, Robust::GncTls);
    for factor in [1e-4, 0.02, 50.0] {
        let mut graph = honest.graph.clone();
        for edge in &mut graph.factors {
            edge.information *= factor;
        }
        let scaled = solve(&graph, Robust::GncTls);
        assert_eq!(scaled.rejected, found.rejected);
        let expected = factor * found.noise_scale;
        assert!((scaled.noise_scale / expected - 1.0).abs() < 1e-3, "{factor}");
        assert!(
            (scaled.loop_scale.unwrap() / (factor * found.loop_scale.unwrap()) - 1.0).abs() < 1e-3
        );
    }
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let made = wrong_among(&town(6), 0.3, 3);
    for robust in SETTLING {
        assert_eq!(solve(&made.graph, robust), solve(&made.graph, robust));
    }
}

#[test]
fn nothing_is_too_small_or_too_broken() {
    let mut broken = ring(&Ring { poses: 12, ..Ring::default() }).graph;
    broken.factors[3].from_from_to = Se2::new(f64::NAN, 0.0, 0.0);
    broken.factors.push(posegraph::Factor { from: 2, to: 99, ..broken.factors[0] });
    let mut blind = ring(&Ring { poses: 12, ..Ring::default() }).graph;
    for factor in &mut blind.factors {
        factor.information *= 0.0;
    }
    for robust in Robust::ALL {
        for poses in 0..4 {
            let graph = ring(&Ring { poses, ..Ring::default() }).graph;
            assert_eq!(solve(&graph, robust).solution.poses.len(), poses);
            let missing = optimize_robust(&graph, &[], robust, &Options::default(), &mut Off);
            assert_eq!(missing.rejected, []);
        }
        assert_eq!(solve(&broken, robust).solution.weights.len(), broken.factors.len());
        assert_eq!(solve(&blind, robust).rejected, []);
    }
}
