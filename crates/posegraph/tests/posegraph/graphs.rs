//! Random graphs, and what is true of them by brute force.

use pose::Se2;
use posegraph::{EdgeKind, PoseGraph, ScopeScratch, Skeleton};
use probe::{EdgeId, VertexId};
use proptest::prelude::*;
use proptest::sample::Index;

/// A graph to be drawn: how many vertices, and edges between picked ones.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// A place for each vertex; edges agree with them unless `wrong_m` moves them.
    pub places: Vec<(f64, f64, f64)>,
    pub edges: Vec<(Index, Index)>,
    /// How far the edges are from agreeing with each other, metres.
    pub wrong_m: f64,
    /// Whether each vertex hangs on the one before; else some may be cut off.
    pub chained: bool,
}

pub fn graphs(sizes: std::ops::Range<usize>) -> impl Strategy<Value = Drawn> {
    let place = (-10.0..10.0_f64, -10.0..10.0_f64, -3.1..3.1_f64);
    let edge = (any::<Index>(), any::<Index>());
    (
        prop::collection::vec(place, sizes),
        prop::collection::vec(edge, 0..20),
        prop_oneof![Just(0.0), Just(1.0)],
        prop::bool::weighted(0.8),
    )
        .prop_map(|(places, edges, wrong_m, chained)| Drawn {
            places,
            edges,
            wrong_m,
            chained,
        })
}

impl Drawn {
    pub fn world_from(&self, vertex: usize) -> Se2 {
        let (x, y, theta) = self.places[vertex];
        Se2::new(x, y, theta)
    }

    fn measured(&self, a: usize, b: usize, salt: usize) -> Se2 {
        let exact = self.world_from(a).inverse_mul(&self.world_from(b));
        // Any numbers do, as long as they differ from edge to edge.
        let turn = 1.7 * salt as f64 + a as f64;
        let wrong = Se2::new(self.wrong_m * turn.sin(), self.wrong_m * (2.3 * turn).cos(), 0.0);
        exact * wrong * Se2::from_angle(0.3 * self.wrong_m * (0.9 * turn).sin())
    }

    pub fn graph(&self) -> PoseGraph {
        let mut graph = PoseGraph::new();
        for vertex in 0..self.places.len() {
            let id = graph.add_vertex();
            if self.chained && vertex > 0 {
                let step = self.measured(vertex - 1, vertex, 0);
                graph.add_edge(VertexId(id.0 - 1), id, step, EdgeKind::Odometry).unwrap();
            }
        }
        for (a, b) in &self.edges {
            self.add_picked(&mut graph, a, b);
        }
        graph
    }

    /// Adds a place edge between two picked vertices, if they differ.
    pub fn add_picked(&self, graph: &mut PoseGraph, a: &Index, b: &Index) -> Option<EdgeId> {
        let (a, b) = (a.index(self.places.len()), b.index(self.places.len()));
        let pose = self.measured(a, b, graph.edge_count() + 1);
        graph.add_edge(VertexId(a as u32), VertexId(b as u32), pose, EdgeKind::Place).ok()
    }
}

/// The skeleton of all edges that are not withdrawn.
pub fn skeleton_of(graph: &PoseGraph, horizon_m: f64) -> Skeleton {
    filled(Skeleton::new(horizon_m), graph)
}

/// An empty skeleton with all edges that are not withdrawn.
pub fn filled(mut skeleton: Skeleton, graph: &PoseGraph) -> Skeleton {
    let mut scratch = ScopeScratch::default();
    if graph.vertex_count() > 0 {
        skeleton.cover(VertexId(graph.vertex_count() as u32 - 1));
    }
    for (id, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
        skeleton.add_edge(id, edge, &mut scratch);
    }
    skeleton
}

/// One shortest way, as brute force finds it.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    pub length_m: f64,
    pub odometry_m: f64,
    pub from_to: Se2,
}

/// Shortest ways between all vertices, by Floyd and Warshall, composing the poses on the way.
pub fn all_ways(graph: &PoseGraph) -> Vec<Vec<Option<Way>>> {
    all_ways_weighing(graph, 1.0)
}

/// The same where a metre of a place edge counts as so many.
pub fn all_ways_weighing(graph: &PoseGraph, place_weight: f64) -> Vec<Vec<Option<Way>>> {
    let n = graph.vertex_count();
    let mut ways: Vec<Vec<Option<Way>>> = vec![vec![None; n]; n];
    for (i, row) in ways.iter_mut().enumerate() {
        row[i] = Some(Way { length_m: 0.0, odometry_m: 0.0, from_to: Se2::identity() });
    }
    let shorter = |way: &Way, known: &Option<Way>| {
        known.is_none_or(|known: Way| way.length_m < known.length_m)
    };
    for (_, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
        let (a, b) = (edge.a.0 as usize, edge.b.0 as usize);
        let metres = edge.a_from_b.translation.norm();
        let (length_m, odometry_m) = match edge.kind {
            EdgeKind::Odometry => (metres, metres),
            EdgeKind::Place => (metres * place_weight, 0.0),
        };
        for (from, to, pose) in [(a, b, edge.a_from_b), (b, a, edge.a_from_b.inverse())] {
            let way = Way { length_m, odometry_m, from_to: pose };
            if shorter(&way, &ways[from][to]) {
                ways[from][to] = Some(way);
            }
        }
    }
    for k in 0..n {
        for i in 0..n {
            for j in 0..n {
                let (Some(x), Some(y)) = (ways[i][k], ways[k][j]) else { continue };
                let way = Way {
                    length_m: x.length_m + y.length_m,
                    odometry_m: x.odometry_m + y.odometry_m,
                    from_to: x.from_to * y.from_to,
                };
                if shorter(&way, &ways[i][j]) {
                    ways[i][j] = Some(way);
                }
            }
        }
    }
    ways
}

/// Where a walk over measured edges ends, and what it adds up to; none if it is no walk.
pub fn walk(graph: &PoseGraph, start: VertexId, edges: &[EdgeId]) -> Option<(VertexId, Way)> {
    let mut at = start;
    let mut way = Way { length_m: 0.0, odometry_m: 0.0, from_to: Se2::identity() };
    for &id in edges {
        let edge = graph.edge(id);
        if edge.withdrawn || (at != edge.a && at != edge.b) {
            return None;
        }
        let (next, step) =
            if at == edge.a { (edge.b, edge.a_from_b) } else { (edge.a, edge.a_from_b.inverse()) };
        let length_m = edge.a_from_b.translation.norm();
        way.length_m += length_m;
        way.odometry_m += if edge.kind == EdgeKind::Odometry { length_m } else { 0.0 };
        way.from_to = way.from_to * step;
        at = next;
    }
    Some((at, way))
}

pub fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

pub fn same_pose(a: &Se2, b: &Se2) -> bool {
    let apart = a.inverse_mul(b);
    apart.translation.norm() < 1e-8 && apart.angle().abs() < 1e-9
}
