//! The certificate against dense algebra, and its laws.

use pose::Se2;
use posegraph::initial::chordal;
use posegraph::{
    FactorGraph, Rigid, SynchronizeEvent, SynchronizeOptions, Verdict, certify, certify_with,
    sesync_cost,
};

use super::graphs::{noisy2, noisy3};
use super::oracle::{data_matrix, smallest_eigenvalue, stacked};

fn holds<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>) {
    let found = certify(graph, &chordal(graph), &SynchronizeOptions::default());
    assert_eq!(found.verdict, Verdict::GloballyOptimal, "{}", found.reason);
    assert_eq!(found.poses.len(), graph.ids.len());
    let dense = smallest_eigenvalue(graph, &found.poses);
    let scale = data_matrix(graph).amax();
    assert!(dense >= -found.precision - 1e-12 * scale, "{dense} against {}", found.precision);
    assert!(found.smallest_eigenvalue <= 0.0);
    let cost = sesync_cost(graph, &found.poses);
    assert!((cost - found.sesync_cost).abs() <= 1e-9 * cost);
    assert!(found.gap >= 0.0 && found.gap <= 2e-6 * cost + 1e-9, "gap {} of {cost}", found.gap);
    // The gradient vanishes: S X = 0 up to the multipliers' symmetric part, seen in the dense form.
    let x = stacked(&found.poses);
    let dense_cost = (x.transpose() * data_matrix(graph) * &x).trace();
    assert!((dense_cost - cost).abs() <= 1e-8 * (cost + 1e-6 * scale));
}

#[test]
fn certified_solutions_are_so_by_dense_algebra() {
    for seed in 0..4 {
        holds(&noisy2(14, 12, 0.1, seed).0);
        holds(&noisy3(9, 9, 0.1, seed).0);
    }
}

/// Entries of the matrix are `1e12` times the cost: what rounding leaves of `S + η I` alone is a gap as
/// wide as a fifth of the cost.
#[test]
fn stiff_graphs_are_certified_to_a_narrow_gap() {
    for seed in 0..4 {
        let (graph, _) = noisy3(12, 12, 1e-6, seed);
        let found = certify(&graph, &chordal(&graph), &SynchronizeOptions::default());
        assert_eq!(found.verdict, Verdict::GloballyOptimal, "{}", found.reason);
        let cost = sesync_cost(&graph, &found.poses);
        let scale = data_matrix(&graph).amax();
        assert!(cost < 1e-9 && scale > 10.0, "not stiff: {cost} of {scale}");
        assert!(found.gap <= 1e-6 * cost, "gap {} of {cost}", found.gap);
        assert!(smallest_eigenvalue(&graph, &found.poses) >= -1e-12 * scale);
    }
}

#[test]
fn parallel_measurements_and_components_are_certified_together() {
    let (mut graph, _) = noisy2(10, 8, 0.1, 5);
    let (other, _) = noisy2(8, 6, 0.1, 6);
    let shift = graph.ids.len();
    graph.factors.push(graph.factors[3]);
    graph.ids.extend(other.ids.iter().map(|id| id + 1000));
    graph.initial.extend(&other.initial);
    for mut factor in other.factors.clone() {
        factor.from += shift;
        factor.to += shift;
        graph.factors.push(factor);
    }
    let found = certify(&graph, &chordal(&graph), &SynchronizeOptions::default());
    assert_eq!(found.verdict, Verdict::GloballyOptimal, "{}", found.reason);
    let alone = certify(&other, &chordal(&other), &SynchronizeOptions::default());
    let mut first = graph.clone();
    first.ids.truncate(shift);
    first.initial.truncate(shift);
    first.factors.retain(|factor| factor.from < shift);
    let rest = certify(&first, &chordal(&first), &SynchronizeOptions::default());
    let sum = alone.sesync_cost + rest.sesync_cost;
    assert!((found.sesync_cost - sum).abs() <= 1e-8 * sum);
}

#[test]
fn the_optimum_does_not_depend_on_the_order_of_vertices_or_on_the_gauge() {
    let (graph, _) = noisy2(15, 14, 0.15, 11);
    let count = graph.ids.len();
    let start = chordal(&graph);
    let found = certify(&graph, &start, &SynchronizeOptions::default());
    let mut turned = graph.clone();
    for factor in &mut turned.factors {
        factor.from = count - 1 - factor.from;
        factor.to = count - 1 - factor.to;
    }
    turned.factors.reverse();
    let motion = Se2::new(3.0, -2.0, 2.5);
    let moved: Vec<Se2> = start.iter().rev().map(|pose| motion * *pose).collect();
    let again = certify(&turned, &moved, &SynchronizeOptions::default());
    assert!((found.sesync_cost - again.sesync_cost).abs() <= 1e-9 * found.sesync_cost);
    assert_eq!(found.verdict, again.verdict);
    // The first vertex stays where the start had it.
    assert!((again.poses[0].translation - moved[0].translation).norm() < 1e-9);
}

#[test]
fn the_same_graph_gives_the_same_bits_and_a_probe_changes_nothing() {
    let (graph, _) = noisy3(10, 10, 0.2, 3);
    let start = chordal(&graph);
    let found = certify(&graph, &start, &SynchronizeOptions::default());
    let mut iterations = 0;
    let mut tested = 0;
    let mut probe = Count { iterations: &mut iterations, tested: &mut tested };
    let again = certify_with(&graph, &start, &SynchronizeOptions::default(), &mut probe);
    assert_eq!(found, again);
    assert!(iterations > 0 && tested > 0);
}

struct Count<'a> {
    iterations: &'a mut usize,
    tested: &'a mut usize,
}

impl<'e> probe::Probe<SynchronizeEvent<'e>> for Count<'_> {
    fn emit(&mut self, event: SynchronizeEvent<'e>) {
        match event {
            SynchronizeEvent::Iterated { .. } => *self.iterations += 1,
            SynchronizeEvent::Tested { .. } => *self.tested += 1,
            _ => {}
        }
    }
}

#[test]
fn what_cannot_be_certified_is_not_applicable() {
    let (mut graph, truth) = noisy2(6, 3, 0.1, 1);
    let options = SynchronizeOptions::default();
    assert_eq!(certify(&graph, &truth[..3], &options).verdict, Verdict::NotApplicable);
    graph.fixed = vec![1];
    let held = certify(&graph, &truth, &options);
    assert_eq!(held.verdict, Verdict::GloballyOptimal);
    assert!((held.poses[1].translation - truth[1].translation).norm() < 1e-9);
    graph.fixed = vec![1, 4];
    let several = certify(&graph, &truth, &options);
    assert_eq!(several.verdict, Verdict::NotApplicable);
    assert!(several.reason.contains("fixed"), "{}", several.reason);
    graph.factors.clear();
    graph.fixed.clear();
    assert_eq!(certify(&graph, &truth, &options).verdict, Verdict::NotApplicable);
    let empty = FactorGraph::<Se2, 3>::default();
    assert_eq!(certify(&empty, &[], &options).verdict, Verdict::NotApplicable);
}

#[test]
fn exact_measurements_are_certified_at_cost_zero() {
    let (graph, truth) = noisy3(12, 12, 0.0, 9);
    let found = certify(&graph, &chordal(&graph), &SynchronizeOptions::default());
    assert_eq!(found.verdict, Verdict::GloballyOptimal, "{}", found.reason);
    assert!(found.sesync_cost < 1e-20, "{}", found.sesync_cost);
    let reference = truth[0].inverse();
    for (pose, truth) in found.poses.iter().zip(&truth) {
        let expected = reference * *truth;
        let moved = found.poses[0].inverse() * *pose;
        assert!((moved.translation - expected.translation).norm() < 1e-8);
    }
}
