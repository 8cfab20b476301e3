//! Start values along a spanning tree: the shortest, or the surest.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use super::Components;
use crate::factors::{Factor, FactorGraph, Manifold};
use crate::synchronize::{Rigid, isotropic_weights};

/// `map_from_body` of every vertex along the fewest factors from the first of its component.
///
/// The first vertex of a component keeps its initial value, or stands at the identity; so do fixed
/// vertices that have one. Of several ways with equally many factors the one that comes first in
/// the order of the factors is taken. Cost: linear in vertices and factors.
pub fn spanning_tree<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    grow(graph, roots(graph))
}

/// The poses that trees grow from: the first of each component, and fixed ones that have a value.
fn roots<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<Option<P>> {
    let count = graph.ids.len();
    let joins = graph.factors.iter().map(|factor| (factor.from, factor.to));
    let fixed: Vec<usize> = (graph.fixed.iter().copied())
        .filter(|&vertex| graph.initial.get(vertex).is_some_and(Option::is_some))
        .collect();
    let mut known = vec![None; count];
    for vertex in Components::new(count, joins).anchors(&fixed) {
        let initial = graph.initial.get(vertex).copied().flatten();
        known[vertex] = Some(initial.unwrap_or_else(P::identity));
    }
    known
}

/// `map_from_body` of every vertex along the surest way from the first of its component: the one on
/// which the variances of measured rotations add up to the least.
///
/// Variances are those of [`isotropic_weights`]; a factor without one is a last resort. What is given
/// is kept as by [`spanning_tree`]. Cost: Dijkstra's search, `O(m log n)`.
pub fn surest_tree<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    let mut known = roots(graph);
    let count = known.len();
    let beside = Beside::new(graph);
    let variance: Vec<f64> = (graph.factors.iter())
        .map(|factor| {
            let (rotation, _) = isotropic_weights::<P, D>(&factor.information);
            if rotation > 0.0 { (1.0 / rotation).min(UNSURE) } else { UNSURE }
        })
        .collect();
    let mut sum = vec![f64::INFINITY; count];
    let mut open = BinaryHeap::new();
    for vertex in (0..count).filter(|&vertex| known[vertex].is_some()) {
        sum[vertex] = 0.0;
        open.push(Reverse((0, vertex)));
    }
    let mut done = vec![false; count];
    while let Some(Reverse((_, vertex))) = open.pop() {
        let Some(pose) = known[vertex].filter(|_| !std::mem::replace(&mut done[vertex], true))
        else {
            continue;
        };
        for &index in beside.of(vertex) {
            let (other, step) = across(&graph.factors[index], vertex);
            let longer = sum[vertex] + variance[index];
            if longer < sum[other] {
                sum[other] = longer;
                known[other] = Some(pose.compose(&step));
                // Bits of numbers that are not negative stand in the order of the numbers.
                open.push(Reverse((longer.to_bits(), other)));
            }
        }
    }
    known.into_iter().map(|pose| pose.unwrap_or_else(P::identity)).collect()
}

/// The variance of a rotation that nothing is known of.
const UNSURE: f64 = 1e6;

/// `map_from_body` of every vertex as the graph gives it; those without a value are placed along
/// the fewest factors from those with one.
///
/// A component without any value starts with its first vertex at the identity.
pub fn given<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    let count = graph.ids.len();
    let mut known = graph.initial.clone();
    known.resize(count, None);
    let joins = graph.factors.iter().map(|factor| (factor.from, factor.to));
    let has: Vec<usize> = (0..count).filter(|&vertex| known[vertex].is_some()).collect();
    for vertex in Components::new(count, joins).anchors(&has) {
        known[vertex].get_or_insert_with(P::identity);
    }
    grow(graph, known)
}

/// Places vertices along factors, breadth first from those that are known.
fn grow<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    mut known: Vec<Option<P>>,
) -> Vec<P> {
    let count = known.len();
    let beside = Beside::new(graph);
    let mut open: VecDeque<usize> = (0..count).filter(|&v| known[v].is_some()).collect();
    while let Some(vertex) = open.pop_front() {
        let Some(pose) = known[vertex] else { continue };
        for &index in beside.of(vertex) {
            let (other, step) = across(&graph.factors[index], vertex);
            if known[other].is_none() {
                known[other] = Some(pose.compose(&step));
                open.push_back(other);
            }
        }
    }
    // Every component has a known vertex, so the identity is for factors that are not finite.
    known.into_iter().map(|pose| pose.unwrap_or_else(P::identity)).collect()
}

/// Factors at each vertex that lead somewhere, in order.
struct Beside {
    starts: Vec<usize>,
    factors: Vec<usize>,
}

impl Beside {
    fn new<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Self {
        let count = graph.ids.len();
        let usable = |factor: &&Factor<P, D>| {
            factor.from < count && factor.to < count && factor.from_from_to.is_finite()
        };
        // Gathered by counting.
        let mut starts = vec![0; count + 1];
        for factor in graph.factors.iter().filter(usable) {
            starts[factor.from + 1] += 1;
            starts[factor.to + 1] += 1;
        }
        for vertex in 0..count {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut factors = vec![0; starts[count]];
        for (index, factor) in graph.factors.iter().enumerate().filter(|(_, f)| usable(f)) {
            for vertex in [factor.from, factor.to] {
                factors[next[vertex]] = index;
                next[vertex] += 1;
            }
        }
        Self { starts, factors }
    }

    fn of(&self, vertex: usize) -> &[usize] {
        &self.factors[self.starts[vertex]..self.starts[vertex + 1]]
    }
}

/// The other end of a factor, and the motion from a vertex to it.
fn across<P: Manifold<D>, const D: usize>(factor: &Factor<P, D>, vertex: usize) -> (usize, P) {
    if factor.from == vertex {
        (factor.to, factor.from_from_to)
    } else {
        (factor.from, factor.from_from_to.inverse())
    }
}
