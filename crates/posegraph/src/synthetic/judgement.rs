//! How well wrong closures were told from right ones.

use super::WithOutliers;
use crate::robust::RobustSolution;
use crate::synchronize::Rigid;

/// How far a map is off, and how well the wrong closures of its graph were named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// Root mean square distance of positions to the map without wrong closures, as a share of the
    /// longest side of its bounding box; both hold the first vertex.
    pub rmse: f64,
    /// Share of wrong closures among the rejected; 1 where none is rejected.
    pub precision: f64,
    /// Share of rejected closures among the wrong; 1 where none is wrong.
    pub recall: f64,
}

impl Judgement {
    /// A map is right up to this share of its extent.
    pub const RIGHT: f64 = 0.01;

    /// Precision and recall are right from here.
    pub const NAMED: f64 = 0.95;

    /// Whether the map is right and the wrong closures are named.
    pub fn success(&self) -> bool {
        self.rmse <= Self::RIGHT && self.precision >= Self::NAMED && self.recall >= Self::NAMED
    }
}

impl<P: Rigid<D>, const D: usize> WithOutliers<P, D> {
    /// Holds a solution of the graph against `map`, which holds `map_from_body` of every vertex as it
    /// comes out without wrong closures.
    pub fn judge(&self, found: &RobustSolution<P>, map: &[P]) -> Judgement {
        let hits = found.rejected.iter().filter(|k| self.wrong.binary_search(k).is_ok());
        let hits = hits.count() as f64;
        let of = |count: usize| if count == 0 { 1.0 } else { hits / count as f64 };
        Judgement {
            rmse: rmse(&found.solution.poses, map),
            precision: of(found.rejected.len()),
            recall: of(self.wrong.len()),
        }
    }
}

/// Distance of positions as a share of the extent, first poses laid onto each other.
fn rmse<P: Rigid<D>, const D: usize>(found: &[P], map: &[P]) -> f64 {
    let at = |pose: &P| pose.columns()[P::DIM];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut sum = 0.0;
    let Some(turn) = found.first().zip(map.first()).map(|(a, b)| b.compose(&a.inverse())) else {
        return 0.0;
    };
    for (found, wanted) in found.iter().zip(map) {
        let (found, wanted) = (at(&turn.compose(found)), at(wanted));
        for k in 0..P::DIM {
            low[k] = low[k].min(wanted[k]);
            high[k] = high[k].max(wanted[k]);
            sum += (found[k] - wanted[k]).powi(2);
        }
    }
    let extent = (0..P::DIM).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    (sum / map.len() as f64).sqrt() / extent
}
