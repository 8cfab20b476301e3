//! The cost of poses.

use super::{ErrorKind, FactorGraph, Manifold};

/// `χ² = Σ eᵀ Ω e` over all factors, without one half; information matrices as they stand.
///
/// `poses` holds `map_from_body` of every vertex.
pub fn chi2<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    poses: &[P],
    kind: ErrorKind,
) -> f64 {
    // From +0: an empty sum of floats is -0.
    chi2_of_factors(graph, poses, kind).iter().fold(0.0, |sum, chi2| sum + chi2)
}

/// `eᵀ Ω e` of each factor, in the order of the factors; information matrices as they stand.
///
/// `poses` holds `map_from_body` of every vertex.
pub fn chi2_of_factors<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    poses: &[P],
    kind: ErrorKind,
) -> Vec<f64> {
    graph
        .factors
        .iter()
        .map(|factor| {
            let (from, to) = (&poses[factor.from], &poses[factor.to]);
            let error = P::error(kind, &factor.from_from_to, from, to);
            error.dot(&(factor.information * error))
        })
        .collect()
}
