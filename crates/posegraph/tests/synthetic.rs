//! Made-up graphs: as large and as noisy as asked, and the same every time.

use pose::Se2;
use posegraph::synthetic::{
    Lattice, Noise, Ring, Sphere, Synthetic, Torus, Walk, city, lattice, manhattan, ring, sphere,
    torus, walk,
};
use posegraph::{ErrorKind, Manifold, factors::chi2};

/// What holds for every graph; returns the number of closures.
fn check<P: Manifold<D>, const D: usize>(made: &Synthetic<P, D>, poses: usize) -> usize {
    let graph = &made.graph;
    assert_eq!((graph.ids.len(), graph.initial.len(), made.truth.len()), (poses, poses, poses));
    assert_eq!(graph.initial.first().copied().flatten(), made.truth.first().copied());
    let mut newest = 0;
    for factor in &graph.factors {
        assert!(factor.from != factor.to && factor.from < poses && factor.to < poses);
        newest = newest.max(factor.to);
    }
    let chained = graph.factors.iter().filter(|f| f.from + 1 == f.to).count();
    assert!(chained >= poses.saturating_sub(1) && newest + 1 == poses.max(1));
    // The cost of the truth is a chi-squared variable: mean d, variance 2 d.
    let degrees = (graph.factors.len() * D) as f64;
    let cost = chi2(graph, &made.truth, ErrorKind::Log);
    // In space g2o's information weighs the angle itself four times.
    let expected = if D == 6 { degrees * 2.5 } else { degrees };
    let spread = 6.0 * (2.0 * degrees).sqrt() * if D == 6 { 4.0 } else { 1.0 };
    assert!((cost - expected).abs() < spread, "{cost} for {degrees}");
    graph.factors.len() - (poses - 1)
}

#[test]
fn sizes_connections_and_noise_are_as_asked() {
    assert_eq!(check(&sphere(&Sphere::default()), 2500), 2450);
    assert_eq!(check(&torus(&Torus::default()), 5000), 5000);
    assert_eq!(check(&ring(&Ring::default()), 400), 1);
    let closures = check(&lattice(&Lattice { side: 10, ..Lattice::default() }), 1000);
    assert!((500..1000).contains(&closures), "{closures}");
    let closures = check(&manhattan(3500, 1), 3500);
    assert!((1000..3500).contains(&closures), "{closures}");
    let closures = check(&city(4000, 1), 4000);
    assert!((1500..8000).contains(&closures), "{closures}");
}

#[test]
fn the_cost_of_the_truth_is_calibrated_in_the_error_that_is_minimised() {
    let made = sphere(&Sphere::default());
    let degrees = (made.graph.factors.len() * 6) as f64;
    let cost = chi2(&made.graph, &made.truth, ErrorKind::G2o);
    assert!((cost / degrees - 1.0).abs() < 0.05, "{cost} for {degrees}");
}

#[test]
fn neighbours_are_near() {
    let made = lattice(&Lattice { side: 6, closure_probability: 1.0, ..Lattice::default() });
    // All 3 s² (s - 1) pairs of neighbours of a cubic lattice, once each.
    assert_eq!(made.graph.factors.len(), 3 * 36 * 5);
    for factor in &made.graph.factors {
        let step = made.truth[factor.from].between(&made.truth[factor.to]).distance();
        assert!((step - 2.0).abs() < 1e-9);
    }
    let made = manhattan(1000, 4);
    for factor in &made.graph.factors {
        let step: Se2 = made.truth[factor.from].between(&made.truth[factor.to]);
        assert!(step.distance() < 1.5);
    }
}

#[test]
fn one_seed_one_graph() {
    assert_eq!(city(500, 3), city(500, 3));
    assert_ne!(city(500, 3), city(500, 4));
}

#[test]
fn nothing_is_too_small() {
    let noise = Noise { translation_m: 0.0, rotation_rad: 0.0 };
    for poses in 0..4 {
        let made = walk(&Walk { poses, blocks: 1, steps_per_block: 0, noise, ..Walk::city() });
        assert_eq!(made.truth.len(), poses);
        assert_eq!(ring(&Ring { poses, noise, ..Ring::default() }).truth.len(), poses);
        let side = poses;
        assert_eq!(
            lattice(&Lattice { side, noise, ..Lattice::default() }).truth.len(),
            side.pow(3)
        );
        let made = sphere(&Sphere { rounds: poses, poses_per_round: 2, ..Sphere::default() });
        assert!(made.truth.iter().all(Manifold::is_finite));
        let made = torus(&Torus { rounds: 3, poses_per_round: poses, ..Torus::default() });
        assert!(made.truth.iter().all(Manifold::is_finite));
    }
}
