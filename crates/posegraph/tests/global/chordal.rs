//! Chordal starts.

use pose::nalgebra::{Matrix3, Matrix6};
use pose::{Se2, Se3};
use posegraph::initial::chordal;
use posegraph::{FactorGraph, Manifold};

use super::graphs::{noisy2, noisy3};

fn relative<P: Manifold<D>, const D: usize>(poses: &[P]) -> Vec<P> {
    poses.iter().map(|pose| poses[0].between(pose)).collect()
}

fn agree<P: Manifold<D>, const D: usize>(a: &[P], b: &[P], tolerance: f64) {
    for (a, b) in a.iter().zip(b) {
        assert!(a.local(b).norm() < tolerance, "{a:?} against {b:?}");
    }
}

#[test]
fn exact_measurements_give_exact_poses() {
    for seed in 0..5 {
        let (graph, truth) = noisy2(20, 10, 0.0, seed);
        agree(&relative(&chordal(&graph)), &relative(&truth), 1e-9);
        let (graph, truth) = noisy3(15, 10, 0.0, seed);
        agree(&relative(&chordal(&graph)), &relative(&truth), 1e-9);
    }
}

#[test]
fn fixed_vertices_stay_and_the_others_follow() {
    let (mut graph, truth) = noisy3(12, 8, 0.0, 3);
    graph.fixed = vec![4, 7];
    graph.initial = truth.iter().copied().map(Some).collect();
    agree(&chordal(&graph), &truth, 1e-9);
}

#[test]
fn noise_moves_the_start_by_as_much_as_noise() {
    let (graph, truth) = noisy2(30, 40, 0.05, 8);
    agree(&relative(&chordal(&graph)), &relative(&truth), 0.5);
}

#[test]
fn each_component_starts_where_its_first_vertex_does() {
    let (mut graph, _) = noisy2(6, 4, 0.0, 2);
    let first = Se2::new(5.0, 6.0, 1.0);
    graph.ids.extend([100, 101]);
    graph.initial.extend([Some(first), None]);
    let mut factor = graph.factors[0];
    (factor.from, factor.to) = (6, 7);
    graph.factors.push(factor);
    let poses = chordal(&graph);
    agree(&poses[6..7], &[first], 1e-12);
    agree(&poses[7..8], &[first * factor.from_from_to], 1e-9);
}

#[test]
fn information_that_is_none_is_survived() {
    let (mut graph, _) = noisy3(10, 8, 0.02, 4);
    graph.factors[0].information = Matrix6::zeros();
    graph.factors[3].information[(4, 4)] = -50.0;
    graph.factors[5].information = -Matrix6::identity();
    graph.factors[6].information[(0, 0)] = f64::NAN;
    let poses = chordal(&graph);
    assert!(poses.iter().all(Manifold::is_finite));
    let (mut graph, _) = noisy2(10, 0, 0.02, 4);
    for factor in &mut graph.factors {
        factor.information = Matrix3::zeros();
    }
    assert!(chordal(&graph).iter().all(Manifold::is_finite));
}

#[test]
fn nothing_gives_nothing() {
    assert!(chordal(&FactorGraph::<Se2, 3>::default()).is_empty());
    let lonely =
        FactorGraph::<Se3, 6> { ids: vec![3, 9], initial: vec![None, None], ..Default::default() };
    assert_eq!(chordal(&lonely), [Se3::identity(); 2]);
}
