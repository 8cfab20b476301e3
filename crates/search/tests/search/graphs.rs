//! Random graphs, and oracles that share nothing with the searches.

use probe::VertexId;
use proptest::prelude::*;
use search::Graph;

/// A list of edges; nodes are `0..nodes`.
#[derive(Clone, Debug)]
pub struct Edges {
    pub nodes: usize,
    pub edges: Vec<(u32, u32, f64)>,
}

impl Graph for Edges {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        self.nodes
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        for &(a, b, cost) in &self.edges {
            if a == from.0 {
                visit(VertexId(b), cost);
            }
        }
    }
}

impl Edges {
    /// The same graph with its edges listed in another order.
    pub fn reordered(&self) -> Self {
        let mut edges = self.edges.clone();
        edges.reverse();
        let half = edges.len() / 2;
        edges.rotate_left(half);
        Self { nodes: self.nodes, edges }
    }

    /// Least cost between all pairs by Floyd and Warshall; infinity where there is no way.
    pub fn all_pairs(&self) -> Vec<Vec<f64>> {
        let n = self.nodes;
        let mut costs = vec![vec![f64::INFINITY; n]; n];
        for (node, row) in costs.iter_mut().enumerate() {
            row[node] = 0.0;
        }
        for &(a, b, cost) in &self.edges {
            let entry = &mut costs[a as usize][b as usize];
            *entry = entry.min(cost);
        }
        for via in 0..n {
            for a in 0..n {
                for b in 0..n {
                    costs[a][b] = costs[a][b].min(costs[a][via] + costs[via][b]);
                }
            }
        }
        costs
    }

    /// The cost of the cheapest edge from `a` to `b`.
    pub fn edge_cost(&self, a: VertexId, b: VertexId) -> Option<f64> {
        let parallel = self.edges.iter().filter(|edge| (edge.0, edge.1) == (a.0, b.0));
        parallel.map(|edge| edge.2).min_by(f64::total_cmp)
    }

    /// The sum of the costs along `path`, which must follow edges.
    pub fn path_cost(&self, path: &[VertexId]) -> f64 {
        let legs = path.windows(2);
        legs.map(|leg| self.edge_cost(leg[0], leg[1]).expect("a path follows edges")).sum()
    }
}

/// Directed graphs with loops, parallel edges and ties; quarters add up exactly in `f64`.
pub fn any_graph() -> impl Strategy<Value = Edges> {
    graph_with_costs(prop_oneof![
        6 => (0u32..12).prop_map(|quarters| f64::from(quarters) / 4.0),
        1 => Just(f64::INFINITY),
    ])
}

/// As [`any_graph`], with no edge that is closed or free.
pub fn positive_graph() -> impl Strategy<Value = Edges> {
    graph_with_costs((1u32..9).prop_map(|quarters| f64::from(quarters) / 4.0))
}

fn graph_with_costs(cost: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Edges> {
    (1usize..24).prop_flat_map(move |nodes| {
        let node = 0..nodes as u32;
        let edge = (node.clone(), node, cost.clone());
        proptest::collection::vec(edge, 0..nodes * 4).prop_map(move |edges| Edges { nodes, edges })
    })
}
