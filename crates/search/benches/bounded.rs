//! A bounded search that looks at about 100 nodes, in graphs of growing size: the time must not grow.

use std::hint::black_box;

use criterion::Criterion;
use probe::VertexId;
use search::{Graph, Scratch, dijkstra_within};

/// A chain of poses in which every tenth pose recognises the place 37 poses ago.
struct Chain {
    poses: u32,
}

impl Graph for Chain {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        self.poses as usize
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        if from.0 > 0 {
            visit(VertexId(from.0 - 1), 1.0);
        }
        if from.0 + 1 < self.poses {
            visit(VertexId(from.0 + 1), 1.0);
        }
        if from.0.is_multiple_of(10) && from.0 >= 37 {
            visit(VertexId(from.0 - 37), 0.5);
        }
        if (from.0 + 37).is_multiple_of(10) && from.0 + 37 < self.poses {
            visit(VertexId(from.0 + 37), 0.5);
        }
    }
}

fn bounded(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("dijkstra_within");
    for poses in [1_000, 100_000, 1_000_000] {
        let chain = Chain { poses };
        let mut scratch = Scratch::new();
        let mut limit = 1.0;
        let start = VertexId(poses - 1);
        while dijkstra_within(&chain, start, limit, &mut scratch).expect("costs are valid").len()
            < 100
        {
            limit += 1.0;
        }
        let looked_at = scratch.tree().len();
        group.bench_function(format!("{looked_at} of {poses} nodes"), |bencher| {
            bencher.iter(|| {
                let tree = dijkstra_within(&chain, black_box(start), limit, &mut scratch);
                tree.expect("costs are valid").len()
            });
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    bounded(&mut criterion);
    criterion.final_summary();
}
