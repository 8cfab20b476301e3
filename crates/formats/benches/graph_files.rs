//! How many bytes per second the pose-graph reader and writer get through.

use criterion::{Criterion, Throughput};
use formats::pose_graph::{AnyGraph, GraphFormat, read, write};
use pose::{Se2, Se3};
use posegraph::{Factor, FactorGraph, Manifold};

/// A chain with a closure at every other vertex; no two numbers alike.
fn graph<P: Manifold<D>, const D: usize>(count: usize, pose: fn(f64) -> P) -> FactorGraph<P, D> {
    let ends = (1..count).flat_map(|to| {
        let back = (to % 2 == 0).then_some((to / 3, to));
        std::iter::once((to - 1, to)).chain(back)
    });
    let factors = ends.map(|(from, to)| {
        let from_from_to = pose((from * 31 + to * 17) as f64);
        let information = nalgebra::SMatrix::from_fn(|row, column| {
            if row == column { 40.0 } else { ((row + column + to) as f64).sin() }
        });
        Factor { from, to, from_from_to, information }
    });
    FactorGraph {
        ids: (0..count as u64).collect(),
        initial: (0..count).map(|index| Some(pose(index as f64))).collect(),
        fixed: vec![0],
        factors: factors.collect(),
    }
}

fn speed(criterion: &mut Criterion) {
    let plane = graph::<Se2, 3>(20_000, |a| Se2::new(a.sin() * 9.0, a.cos(), a.sin()));
    let space = graph::<Se3, 6>(20_000, |a| {
        let rotation = nalgebra::UnitQuaternion::from_euler_angles(a.sin(), a.cos(), a);
        Se3::new([a.sin() * 9.0, a.cos(), a.sin() * 0.1].into(), rotation)
    });
    for (name, graph) in [("plane", AnyGraph::Plane(plane)), ("space", AnyGraph::Space(space))] {
        let bytes = write(&graph, GraphFormat::G2o);
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Bytes(bytes.len() as u64)).sample_size(20);
        group.bench_function("read", |b| b.iter(|| read(&bytes)));
        group.bench_function("write", |b| b.iter(|| write(&graph, GraphFormat::G2o)));
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    speed(&mut criterion);
    criterion.final_summary();
}
