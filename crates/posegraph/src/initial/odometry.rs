//! Start values from the chain of odometry.

use crate::factors::{FactorGraph, Manifold};

/// `map_from_body` of every vertex by following the first factor from each vertex to the next.
///
/// The chain starts at the initial value of vertex 0, or at the identity. Vertex `i` is placed from
/// vertex `i - 1` by the first factor from `i - 1` to `i`, or else from `i` to `i - 1`. Where there
/// is none, a factor to the nearest earlier vertex is taken; where that is missing too, its initial
/// value, or else the pose of vertex `i - 1`. Cost: linear in vertices and factors.
pub fn odometry<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    let count = graph.ids.len();
    // For each vertex the factor to the nearest earlier one, forward before backward.
    let mut step: Vec<Option<(usize, bool, usize)>> = vec![None; count];
    for (index, factor) in graph.factors.iter().enumerate() {
        let (earlier, later) = (factor.from.min(factor.to), factor.from.max(factor.to));
        if later >= count || earlier == later || !factor.from_from_to.is_finite() {
            continue;
        }
        let forward = factor.from == earlier;
        let better = step[later].is_none_or(|(known, known_forward, _)| {
            earlier > known || (earlier == known && forward && !known_forward)
        });
        if better {
            step[later] = Some((earlier, forward, index));
        }
    }
    let mut poses: Vec<P> = Vec::with_capacity(count);
    for (vertex, step) in step.iter().enumerate() {
        let pose = match step {
            Some((earlier, true, index)) => {
                poses[*earlier].compose(&graph.factors[*index].from_from_to)
            }
            Some((earlier, false, index)) => {
                poses[*earlier].compose(&graph.factors[*index].from_from_to.inverse())
            }
            None => {
                let initial = graph.initial.get(vertex).copied().flatten();
                initial.or(poses.last().copied()).unwrap_or_else(P::identity)
            }
        };
        poses.push(pose);
    }
    poses
}
