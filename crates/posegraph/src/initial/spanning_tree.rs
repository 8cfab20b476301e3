//! Start values along a spanning tree.

use std::collections::VecDeque;

use super::Components;
use crate::factors::{FactorGraph, Manifold};

/// `map_from_body` of every vertex along the fewest factors from the first of its component.
///
/// The first vertex of a component keeps its initial value, or stands at the identity; so do fixed
/// vertices that have one. Of several ways with equally many factors the one that comes first in
/// the order of the factors is taken. Cost: linear in vertices and factors.
pub fn spanning_tree<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
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
    grow(graph, known)
}

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
    // Factors at each vertex, gathered by counting.
    let usable = |factor: &&crate::factors::Factor<P, D>| {
        factor.from < count && factor.to < count && factor.from_from_to.is_finite()
    };
    let mut starts = vec![0; count + 1];
    for factor in graph.factors.iter().filter(usable) {
        starts[factor.from + 1] += 1;
        starts[factor.to + 1] += 1;
    }
    for vertex in 0..count {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut at = vec![0; starts[count]];
    for (index, factor) in graph.factors.iter().enumerate().filter(|(_, factor)| usable(factor)) {
        for vertex in [factor.from, factor.to] {
            at[next[vertex]] = index;
            next[vertex] += 1;
        }
    }
    let mut open: VecDeque<usize> = (0..count).filter(|&v| known[v].is_some()).collect();
    while let Some(vertex) = open.pop_front() {
        let Some(pose) = known[vertex] else { continue };
        for &index in &at[starts[vertex]..starts[vertex + 1]] {
            let factor = &graph.factors[index];
            let (other, step) = if factor.from == vertex {
                (factor.to, factor.from_from_to)
            } else {
                (factor.from, factor.from_from_to.inverse())
            };
            if known[other].is_none() {
                known[other] = Some(pose.compose(&step));
                open.push_back(other);
            }
        }
    }
    // Every component has a known vertex, so the identity is for factors that are not finite.
    known.into_iter().map(|pose| pose.unwrap_or_else(P::identity)).collect()
}
