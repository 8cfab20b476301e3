//! Distances along the graph from a few far nodes: what is left at least, walls included.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::graph::DualGraph;

/// How many landmarks there are.
pub const LANDMARKS: usize = 8;

/// The costs from each landmark to all nodes (Goldberg and Harrelson 2005).
///
/// For a landmark L, the cost from L to a node and to the goal differ by no more than the cost between
/// these two. Costs are exact, so that this is an admissible and consistent estimate, exactly. Gates that a
/// ball cannot pass count as open: that only makes costs less.
#[derive(Clone, Debug)]
pub(super) struct Landmarks {
    costs: Vec<[f64; LANDMARKS]>,
}

impl Landmarks {
    /// Takes far nodes of the largest connected part, each the farthest from those before it.
    /// O(n log n) for each.
    pub fn new(graph: &DualGraph) -> Self {
        let count = graph.points().len();
        let mut costs = vec![[f64::INFINITY; LANDMARKS]; count];
        let mut least = vec![f64::INFINITY; count];
        let Some(mut from) = inside_largest(graph) else { return Self { costs } };
        // The first one only tells what is far.
        for landmark in 0..=LANDMARKS {
            let now = all_costs(graph, from);
            let mut farthest = (-1.0, from);
            for (node, &cost) in now.iter().enumerate() {
                if landmark > 0 {
                    costs[node][landmark - 1] = cost;
                    least[node] = cost.min(least[node]);
                }
                let far = if landmark > 0 { least[node] } else { cost };
                if far.is_finite() && far > farthest.0 {
                    farthest = (far, node as u32);
                }
            }
            from = farthest.1;
        }
        Self { costs }
    }

    /// What is left from one node to another at least; infinite where there is no way.
    #[inline]
    pub fn estimate(&self, node: u32, goal: u32) -> f64 {
        let (a, b) = (&self.costs[node as usize], &self.costs[goal as usize]);
        // Two infinities tell nothing: their difference is NaN, which `max` passes over.
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

/// A node of the part with most nodes.
fn inside_largest(graph: &DualGraph) -> Option<u32> {
    let mut seen = vec![false; graph.points().len()];
    let mut best: Option<(usize, u32)> = None;
    for start in 0..seen.len() {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let (mut waiting, mut size) = (vec![start as u32], 0);
        while let Some(node) = waiting.pop() {
            size += 1;
            for edge in graph.edges_of(node) {
                if !std::mem::replace(&mut seen[edge.to as usize], true) {
                    waiting.push(edge.to);
                }
            }
        }
        if best.is_none_or(|(most, _)| size > most) {
            best = Some((size, start as u32));
        }
    }
    best.map(|best| best.1)
}

fn all_costs(graph: &DualGraph, from: u32) -> Vec<f64> {
    let mut costs = vec![f64::INFINITY; graph.points().len()];
    costs[from as usize] = 0.0;
    // The bits of numbers that are not negative are in their order.
    let mut open = BinaryHeap::from([Reverse((0.0_f64.to_bits(), from))]);
    while let Some(Reverse((bits, node))) = open.pop() {
        let cost = f64::from_bits(bits);
        if cost > costs[node as usize] {
            continue;
        }
        for edge in graph.edges_of(node) {
            let further = cost + edge.cost;
            if further < costs[edge.to as usize] {
                costs[edge.to as usize] = further;
                open.push(Reverse((further.to_bits(), edge.to)));
            }
        }
    }
    costs
}
