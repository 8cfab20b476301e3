//! Start values from the chain of odometry.

use crate::factors::{FactorGraph, Manifold};

/// `map_from_body` of every vertex by following the first factor from each vertex to the next.
///
/// The chain starts at the initial value of vertex 0, or at the identity. It follows the factors
/// from index `i` to `i + 1`, the first of each where there are several. Where one is missing, a
/// factor from `i + 1` to `i` is followed backwards; where that is missing too, the vertex gets its
/// initial value, or else that of the vertex before it.
pub fn odometry<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    let count = graph.ids.len();
    let mut steps: Vec<Option<P>> = vec![None; count];
    let mut backward: Vec<Option<P>> = vec![None; count];
    for factor in &graph.factors {
        if factor.to < count && factor.from + 1 == factor.to {
            steps[factor.to].get_or_insert(factor.from_from_to);
        } else if factor.from < count && factor.to + 1 == factor.from {
            backward[factor.from].get_or_insert(factor.from_from_to.inverse());
        }
    }
    let given = |index: usize| graph.initial.get(index).copied().flatten();
    let mut poses: Vec<P> = Vec::with_capacity(count);
    for (index, (step, backward)) in steps.iter().zip(&backward).enumerate() {
        let last = poses.last().copied();
        let pose = match (last, step.or(*backward)) {
            (Some(last), Some(step)) => last.compose(&step),
            (last, _) => given(index).or(last).unwrap_or_else(P::identity),
        };
        poses.push(pose);
    }
    poses
}
