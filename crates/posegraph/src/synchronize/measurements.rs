//! The graph as SE-Sync sees it: relative poses with one weight for each of their blocks.

use pose::nalgebra::SMatrix;

use super::{Columns, Rigid};
use crate::factors::{FactorGraph, Manifold};
use crate::initial::Components;

/// A relative pose with one weight for each of its blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Relative {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) columns: Columns,
    /// Weight `κ` of the squared Frobenius distance of the rotations.
    pub(crate) rotation: f64,
    /// Weight `τ` of the squared distance of the translations.
    pub(crate) translation: f64,
}

/// Relative poses between vertices `0..count`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measurements {
    pub(crate) count: usize,
    pub(crate) relatives: Vec<Relative>,
}

/// The isotropic weights `(κ, τ)` of a factor with this information matrix.
///
/// `τ = d / tr(Ω_t⁻¹)`; `κ = Ω_θθ` in the plane and `3 / (2 tr(Ω_R⁻¹))` in space, blocks of the
/// matrix as the file holds it, as in SE-Sync's own reader. A block that yields no positive finite
/// number (it is singular or indefinite) is replaced by the mean of what is positive on its
/// diagonal, or 0.
pub fn isotropic_weights<P: Rigid<D>, const D: usize>(
    information: &SMatrix<f64, D, D>,
) -> (f64, f64) {
    let d = P::DIM;
    let positive = |x: f64| (x.is_finite() && x > 0.0).then_some(x);
    let mean = |range: std::ops::Range<usize>| {
        let kept: Vec<f64> = range.filter_map(|k| positive(information[(k, k)])).collect();
        if kept.is_empty() { 0.0 } else { kept.iter().sum::<f64>() / kept.len() as f64 }
    };
    let (translation, rotation) = P::inverse_traces(information);
    let tau = translation.and_then(|trace| positive(d as f64 / trace));
    let scale = if d == 2 { 1.0 } else { 1.5 };
    let kappa = rotation.and_then(|trace| positive(scale / trace));
    let tau = tau.unwrap_or_else(|| mean(0..d));
    // An isotropic block ω I of space has κ = 3 / (2 · 3 / ω) = ω / 2.
    let kappa = kappa.unwrap_or_else(|| mean(d..D) * if d == 2 { 1.0 } else { 0.5 });
    (kappa, tau)
}

impl Measurements {
    /// Factors that are not finite or lead nowhere are left out.
    pub(crate) fn new<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Self {
        let count = graph.ids.len();
        let relatives = graph
            .factors
            .iter()
            .filter(|factor| {
                factor.from < count
                    && factor.to < count
                    && factor.from != factor.to
                    && Manifold::is_finite(&factor.from_from_to)
                    && factor.information.iter().all(|x| x.is_finite())
            })
            .filter_map(|factor| {
                let (rotation, translation) = isotropic_weights::<P, D>(&factor.information);
                (rotation > 0.0 || translation > 0.0).then(|| Relative {
                    from: factor.from,
                    to: factor.to,
                    columns: factor.from_from_to.columns(),
                    rotation,
                    translation,
                })
            })
            .collect();
        Self { count, relatives }
    }

    /// For each vertex the first one that is joined to it by measurements that count.
    pub(crate) fn components(&self, counts: impl Fn(&Relative) -> bool) -> Vec<usize> {
        let pairs = self.relatives.iter().filter(|r| counts(r)).map(|r| (r.from, r.to));
        let components = Components::new(self.count, pairs);
        let firsts = components.anchors(&[]);
        components.of().iter().map(|&component| firsts[component]).collect()
    }
}

/// SE-Sync's cost `F = Σ κ ‖R_j - R_i R̃_ij‖² + τ ‖t_j - t_i - R_i t̃_ij‖²` of poses.
///
/// Another cost than `χ²`: chordal, with one weight for each block (Rosen et al. 2019, eq. 12).
/// `poses` holds `map_from_body` of every vertex.
pub fn sesync_cost<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>, poses: &[P]) -> f64 {
    let d = P::DIM;
    let mut cost = 0.0;
    for relative in &Measurements::new(graph).relatives {
        let (from, to) = (poses[relative.from].columns(), poses[relative.to].columns());
        for k in 0..=d {
            let mut squares = 0.0;
            for c in 0..d {
                let mut gap = to[k][c];
                for l in 0..d {
                    gap -= from[l][c] * relative.columns[k][l];
                }
                if k == d {
                    gap -= from[d][c];
                }
                squares += gap * gap;
            }
            cost += squares * if k == d { relative.translation } else { relative.rotation };
        }
    }
    cost
}
