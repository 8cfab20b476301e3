//! Biased randomised insertion order (\[ACR03\]).

use super::hilbert::Grid;

/// The smallest first round.
const FIRST_ROUND: usize = 64;

/// How much larger each round is than the one before it, about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Growth {
    /// Twice.
    Double = 1,
    /// Eight times: of eight points seven come in one round, where they follow one another closely.
    Eightfold = 3,
}

/// The order in which to insert `points`: growing rounds, each along a Hilbert curve.
///
/// Which round a point falls into is decided by a fixed hash of its index, so that the same points
/// give the same order. O(n log n).
pub(crate) fn brio(points: &[[f64; 3]], growth: Growth) -> Vec<u32> {
    let growth = growth as u32;
    let grid = Grid::new(points);
    let mut rounds = 0;
    while (points.len() >> (growth * rounds)) > FIRST_ROUND {
        rounds += 1;
    }
    let mut keyed: Vec<(u64, u32)> = points
        .iter()
        .enumerate()
        .map(|(i, point)| {
            // Half of all points, or seven eighths, fall into the last round, of the rest as many into the
            // one before it, ...
            let back = (mix(i as u64).trailing_zeros() / growth).min(rounds);
            let key = grid.key(point);
            let round = u64::from(rounds - back);
            // Two rounds run the curve in opposite ways, so that one begins where the last ended.
            let along = if round % 2 == 0 { key } else { (1 << 60) - 1 - key };
            // Eight times as many points fill a cell of half the width: nearer than that, order is noise.
            ((round << 58) | (along >> 2), i as u32)
        })
        .collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, i)| i).collect()
}

/// A fixed scramble of 64 bits (the finaliser of SplitMix64).
fn mix(value: u64) -> u64 {
    let z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
