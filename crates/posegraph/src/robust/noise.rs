//! How far information matrices are off, and which closures have witnesses.

use super::chain::{Agreement, Chain, Closure};
use super::chance::{ball, tangents};
use super::chi_square::chi_square_quantile;
use crate::factors::{ErrorKind, FactorGraph, Manifold};

/// Witnesses that are asked for each closure: those nearest to it along odometry.
const WITNESSES: usize = 4;

/// Loops below this quantile are taken for good at first: with half of the closures wrong it is
/// still among the good ones.
const FIRST_GUESS: f64 = 0.1;

/// Expected number of random closures that find a witness by chance, at most: with more, agreeing
/// says nothing.
const FALSE_WITNESSES: f64 = 0.5;

/// Probability with which a good loop passes.
const LOOP_GATE: f64 = 0.99;

/// What loops of two neighbouring closures tell before anything is optimised.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Witnessed {
    /// Variance of the errors in units of what the information matrices say; `None` where no two
    /// closures can be compared.
    pub scale: Option<f64>,
    /// Whether each factor is a closure that agrees with one of its neighbours.
    pub supported: Vec<bool>,
}

/// Compares each closure with its nearest neighbours along odometry.
///
/// Cost: sorting, and a few loops for each closure.
pub(super) fn witnessed<P: Manifold<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    closes: &[bool],
    kind: ErrorKind,
) -> Witnessed {
    let chain = Chain::new(graph, kind);
    let mut list: Vec<(usize, Closure<P, D>)> = (graph.factors.iter().enumerate())
        .filter(|&(index, _)| closes[index])
        .filter_map(|(index, factor)| Some((index, Closure::new(factor, kind)?)))
        .collect();
    list.sort_by_key(|(index, closure)| (closure.low, closure.high, *index));
    let loops: Vec<Vec<Agreement>> = (0..list.len())
        .map(|at| {
            let own = &list[at].1;
            let near = nearest(&list, at, &chain);
            near.into_iter().map(|other| chain.compare(own, &list[other].1)).collect()
        })
        .collect();
    let nearest_loops: Vec<f64> = loops.iter().filter_map(|own| Some(own.first()?.chi2)).collect();
    let scale = scale_of_loops(nearest_loops, D);
    let mut supported = vec![false; graph.factors.len()];
    if let Some(scale) = scale {
        let gate = chi_square_quantile(LOOP_GATE, D) * scale;
        // A random pose passes with the share of the volume that the gate's ellipsoid takes.
        let ellipsoid = ball(D) * gate.powi(D as i32).sqrt();
        let compared = (list.len() * WITNESSES) as f64;
        let widest = FALSE_WITNESSES / compared * tangents(chain.poses()) / ellipsoid;
        for ((index, _), own) in list.iter().zip(&loops) {
            supported[*index] =
                own.iter().any(|loop_| loop_.chi2 <= gate && loop_.spread <= widest);
        }
    }
    Witnessed { scale, supported }
}

/// The closures nearest to one, nearest first: by the steps of odometry between their ends.
fn nearest<P: Manifold<D>, const D: usize>(
    list: &[(usize, Closure<P, D>)],
    at: usize,
    chain: &Chain<P, D>,
) -> Vec<usize> {
    let own = &list[at].1;
    let mut best: Vec<(usize, usize)> = Vec::with_capacity(WITNESSES + 1);
    let mut look = |other: usize| -> bool {
        let closure = &list[other].1;
        let along = closure.low.abs_diff(own.low);
        let full = best.len() == WITNESSES;
        if full && best.last().is_some_and(|&(worst, _)| along > worst) {
            return false;
        }
        let joined = chain.joins(closure.low, own.low) && chain.joins(closure.high, own.high);
        let steps = along + closure.high.abs_diff(own.high);
        if joined && !(full && best.last().is_some_and(|&(worst, _)| steps >= worst)) {
            let place = best.partition_point(|&(known, _)| known <= steps);
            best.insert(place, (steps, other));
            best.truncate(WITNESSES);
        }
        true
    };
    // Lists are sorted by the earlier vertex, so each side ends where that alone is too far away.
    let mut after = at + 1..list.len();
    let mut before = (0..at).rev();
    let (mut go_after, mut go_before) = (true, true);
    while go_after || go_before {
        go_after = go_after && after.next().is_some_and(&mut look);
        go_before = go_before && before.next().is_some_and(&mut look);
    }
    best.into_iter().map(|(_, other)| other).collect()
}

/// The scale at which the median of the loops within the gate is that of good loops.
fn scale_of_loops(mut loops: Vec<f64>, degrees: usize) -> Option<f64> {
    loops.retain(|value| value.is_finite());
    loops.sort_by(f64::total_cmp);
    let first = *loops.get((loops.len() as f64 * FIRST_GUESS) as usize)?;
    let mut scale = first / chi_square_quantile(FIRST_GUESS, degrees);
    let (gate, median) =
        (chi_square_quantile(LOOP_GATE, degrees), chi_square_quantile(0.5, degrees));
    for _ in 0..50 {
        let within = loops.partition_point(|&value| value <= gate * scale);
        let next = loops[within.saturating_sub(1) / 2] / median;
        if within == 0 || next <= scale * (1.0 + 1e-9) {
            break;
        }
        scale = next;
    }
    (scale > 0.0).then_some(scale)
}

/// The scale of the noise by the `χ²` of closures that are believed: the median, or more where the
/// upper tail is heavier than the median says, up to [`HEAVIEST`] times.
pub(super) fn scale_of_closures(mut chi2: Vec<f64>, degrees: usize) -> Option<f64> {
    chi2.sort_by(f64::total_cmp);
    let at = |share: f64| chi2.get((chi2.len().saturating_sub(1) as f64 * share).round() as usize);
    let median = at(0.5)? / chi_square_quantile(0.5, degrees);
    let tail = at(TAIL)? / chi_square_quantile(TAIL, degrees);
    let scale = median.max(tail.min(HEAVIEST * median));
    (scale > 0.0 && scale.is_finite()).then_some(scale)
}

/// The quantile at which the tail is measured.
const TAIL: f64 = 0.95;

/// A tail that says more than this times what the median says is not believed further.
const HEAVIEST: f64 = 20.0;
