//! Pairwise consistent measurement set maximisation.

use super::believed::Believed;
use super::chain::{Chain, Closure};
use super::chi_square::chi_square_quantile;
use super::clique::{Adjacency, largest_clique};
use crate::factors::Manifold;

/// Probability with which two good closures agree, were their noise Gaussian: a clique needs all pairs
/// to agree, so one in a hundred may not fail.
const PAIR_GATE: f64 = 1.0 - 1e-6;

/// Closures of a largest consistent set.
pub(super) struct Consistent {
    /// Whether each factor is a closure of the set.
    pub members: Vec<bool>,
    /// Whether no larger set exists.
    pub proven: bool,
}

/// The largest set of closures that agree in pairs, by odometry between their ends.
///
/// Pairs that odometry does not join say nothing against each other. Cost: all pairs.
pub(super) fn consistent<P: Manifold<D>, const D: usize>(
    believed: &Believed<P, D>,
    scale: f64,
) -> Consistent {
    let kind = believed.options.error;
    let chain = Chain::new(&believed.graph, kind);
    let list: Vec<(usize, Closure<P, D>)> = believed
        .closures()
        .filter_map(|index| Some((index, Closure::new(&believed.graph.factors[index], kind)?)))
        .collect();
    let gate = chi_square_quantile(PAIR_GATE, D) * scale;
    let mut adjacency = Adjacency::new(list.len());
    for (a, (_, first)) in list.iter().enumerate() {
        for (b, (_, second)) in list.iter().enumerate().take(a) {
            let joined = chain.joins(first.low, second.low) && chain.joins(first.high, second.high);
            if !joined || chain.compare(first, second).chi2 <= gate {
                adjacency.join(a, b);
            }
        }
    }
    let clique = largest_clique(&adjacency);
    let mut members = vec![false; believed.closes.len()];
    for at in clique.vertices {
        members[list[at].0] = true;
    }
    Consistent { members, proven: clique.proven }
}
