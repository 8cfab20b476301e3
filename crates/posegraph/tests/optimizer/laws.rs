//! What must not matter: gauge, order of factors, names of vertices, number of threads.

use pose::{Se2, Se3};
use posegraph::initial::{given, odometry, spanning_tree};
use posegraph::{ErrorKind, Factor, FactorGraph, Manifold, Options, optimize};
use proptest::prelude::*;

use crate::oracle::{Draw, Drawn, distance, exact, graph};

fn hold_laws<P: Drawn<D>, const D: usize>(seed: u64) {
    let graph = graph::<P, D>(seed, 30, 25, 0.05);
    let options = exact(ErrorKind::G2o);
    let start = odometry(&graph);
    let base = optimize(&graph, &start, &options);
    assert!(base.report.termination.is_converged(), "{:?}", base.report.termination);
    let draw = &mut Draw(!seed);

    // Gauge: all poses moved alike from the left.
    let shift = P::drawn(draw, 50.0, 3.0);
    let moved: Vec<P> = start.iter().map(|pose| shift.compose(pose)).collect();
    let solution = optimize(&graph, &moved, &options);
    let back: Vec<P> = solution.poses.iter().map(|pose| shift.between(pose)).collect();
    assert!(distance(&back, &base.poses) < 1e-6, "gauge");
    assert!(close(solution.report.chi2, base.report.chi2), "gauge");

    // Order of factors.
    let mut shuffled = graph.clone();
    for last in (1..shuffled.factors.len()).rev() {
        shuffled.factors.swap(last, draw.below(last + 1));
    }
    let solution = optimize(&shuffled, &start, &options);
    assert!(distance(&solution.poses, &base.poses) < 1e-6, "order");

    // Names: another vertex is first, and held; compared relative to one vertex.
    let count = graph.ids.len();
    let name = |vertex: usize| (vertex * 7 + 11) % count;
    let mut renamed = FactorGraph { factors: Vec::new(), ..graph.clone() };
    for factor in &graph.factors {
        renamed.factors.push(Factor { from: name(factor.from), to: name(factor.to), ..*factor });
    }
    let mut renamed_start = start.clone();
    for (vertex, pose) in start.iter().enumerate() {
        renamed_start[name(vertex)] = *pose;
    }
    let solution = optimize(&renamed, &renamed_start, &options);
    let relative = |poses: &[P], at: &dyn Fn(usize) -> usize| -> Vec<P> {
        (0..count).map(|vertex| poses[at(0)].between(&poses[at(vertex)])).collect()
    };
    let (ours, theirs) = (relative(&solution.poses, &name), relative(&base.poses, &|v| v));
    assert!(distance(&ours, &theirs) < 1e-6, "names");

    // A measurement twice weighs as much as one with twice the information.
    let mut twice = graph.clone();
    twice.factors.push(twice.factors[3]);
    let mut doubled = graph.clone();
    doubled.factors[3].information *= 2.0;
    let (a, b) = (optimize(&twice, &start, &options), optimize(&doubled, &start, &options));
    assert!(distance(&a.poses, &b.poses) < 1e-6, "parallel");
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + b.abs())
}

fn hold_bits<P: Drawn<D>, const D: usize>(seed: u64) {
    // More factors than one thread takes at a time.
    let graph = graph::<P, D>(seed, 3000, 200, 0.02);
    let start = spanning_tree(&graph);
    let base = optimize(&graph, &start, &Options::default());
    for threads in [1, 2, 3] {
        let again = optimize(&graph, &start, &Options { threads, ..Options::default() });
        assert_eq!(format!("{again:?}"), format!("{base:?}"), "{threads} threads");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn nothing_hangs_on_gauge_order_or_names_in_the_plane(seed: u64) {
        hold_laws::<Se2, 3>(seed);
    }

    #[test]
    fn nothing_hangs_on_gauge_order_or_names_in_space(seed: u64) {
        hold_laws::<Se3, 6>(seed);
    }

    #[test]
    fn starts_agree_with_measurements_without_noise(seed: u64) {
        let mut graph = graph::<Se3, 6>(seed, 20, 10, 0.0);
        let chain = odometry(&graph);
        prop_assert!(distance(&chain, &spanning_tree(&graph)) < 1e-12);
        // Half of the values are given, the others follow from them.
        for vertex in (0..20).step_by(2) {
            graph.initial[vertex] = Some(chain[vertex]);
        }
        prop_assert!(distance(&chain, &given(&graph)) < 1e-12);
        let solution = optimize(&graph, &chain, &Options::default());
        prop_assert!(solution.report.chi2 < 1e-20);
    }
}

#[test]
fn bits_are_the_same_with_any_number_of_threads() {
    hold_bits::<Se2, 3>(5);
    hold_bits::<Se3, 6>(6);
}

#[test]
fn fixed_vertices_stay_and_every_component_is_held() {
    // Two chains of five, and a vertex without factors.
    let one = graph::<Se2, 3>(1, 5, 3, 0.05);
    let two = graph::<Se2, 3>(2, 5, 3, 0.05);
    let mut both = one.clone();
    both.ids = (0..11).collect();
    both.initial = vec![None; 11];
    for factor in &two.factors {
        both.factors.push(Factor { from: factor.from + 5, to: factor.to + 5, ..*factor });
    }
    both.fixed = vec![7, 8, 99];
    let start = odometry(&both);
    let solution = optimize(&both, &start, &exact(ErrorKind::G2o));
    assert_eq!(solution.report.components, 3);
    assert_eq!(solution.report.held, [0, 7, 8, 10]);
    for &vertex in &solution.report.held {
        assert_eq!(solution.poses[vertex], start[vertex]);
    }
    let alone = optimize(&one, &start[..5], &exact(ErrorKind::G2o));
    assert!(distance(&solution.poses[..5], &alone.poses) < 1e-8);
}

#[test]
fn vertices_without_a_chain_are_placed_all_the_same() {
    let mut graph = graph::<Se2, 3>(3, 6, 0, 0.0);
    let whole = odometry(&graph);
    // Vertex 3 is reached from vertex 1, backwards; vertex 5 from nowhere.
    graph.factors[2] =
        Factor { from: 3, to: 1, from_from_to: whole[3].between(&whole[1]), ..graph.factors[2] };
    graph.factors.remove(4);
    graph.initial[5] = Some(Se2::new(9.0, 8.0, 7.0));
    let poses = odometry(&graph);
    assert!(distance(&poses[..5], &whole[..5]) < 1e-12);
    assert_eq!(poses[5], Se2::new(9.0, 8.0, 7.0));
}
