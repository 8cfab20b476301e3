//! Rings that cross themselves are split, and parts that run the wrong way round dealt with
//! (\[Zie18\] 2.7.5).

use geometry::Point2;

use super::Corner;
use super::rings::{crosses, next, parameters, reversed, twice_area_m2};

/// What becomes of an upended part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Twisted {
    /// It is turned round, so that it bounds unknown space: what the thesis does.
    #[default]
    Flip,
    /// It is removed, which is right where it was explored already.
    Remove,
}

/// What the split of one ring came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Splits {
    pub splits: usize,
    pub flipped: usize,
    pub removed: usize,
}

/// Rings smaller than this are nothing, square metres.
const LEAST_M2: f64 = 1e-4;

/// Splits a ring at crossings of edges that `counts` holds for, by their first and second corners.
///
/// The ring's own kind, outer or inner, goes on with the part that has most area of that sign; other
/// parts that run clockwise are inner rings, those that run counter-clockwise are upended.
/// At most as many splits as there are corners.
pub(super) fn untwist(
    ring: Vec<Corner>,
    counts: impl Fn(&Corner, &Corner) -> bool,
    twisted: Twisted,
    done: &mut Splits,
    crossed: &mut Vec<Point2>,
) -> Vec<Vec<Corner>> {
    let outer = twice_area_m2(&ring) > 0.0;
    let limit = ring.len();
    let mut whole: Vec<Vec<Corner>> = Vec::new();
    let mut open = vec![ring];
    let mut splits = 0;
    while let Some(ring) = open.pop() {
        match first_crossing(&ring, &counts) {
            Some((i, j)) if splits < limit => {
                splits += 1;
                let (a, b) = (ring[i], ring[next(&ring, i)]);
                let (c, d) = (ring[j], ring[next(&ring, j)]);
                let (t, _) = parameters(&a.at, &b.at, &c.at, &d.at);
                let at = a.at + (b.at - a.at) * t;
                crossed.push(at);
                // a -> X -> d, and c -> X -> b.
                let mut rest: Vec<Corner> = ring[..=i].to_vec();
                rest.push(Corner { at, edge: c.edge, ..a });
                rest.extend_from_slice(&ring[j + 1..]);
                let mut part: Vec<Corner> = ring[i + 1..=j].to_vec();
                part.push(Corner { at, edge: a.edge, ..c });
                open.push(part);
                open.push(rest);
            }
            _ => whole.push(ring),
        }
    }
    done.splits += splits;
    if splits == 0 {
        return whole;
    }
    let mut kept = Vec::new();
    let mut main: Option<(f64, usize)> = None;
    for (i, ring) in whole.iter().enumerate() {
        let area = twice_area_m2(ring);
        let fits = (area > 0.0) == outer;
        if fits && main.is_none_or(|(best, _)| area.abs() > best) {
            main = Some((area.abs(), i));
        }
    }
    for (i, ring) in whole.into_iter().enumerate() {
        let area = twice_area_m2(&ring);
        let is_main = main.is_some_and(|(_, index)| index == i);
        if !is_main && area.abs() < LEAST_M2 {
            continue;
        }
        if is_main || area < 0.0 {
            kept.push(ring);
            continue;
        }
        match twisted {
            Twisted::Flip => {
                done.flipped += 1;
                kept.push(reversed(&ring));
            }
            Twisted::Remove => done.removed += 1,
        }
    }
    kept
}

/// The first pair of edges that cross, in the order of the ring.
///
/// Edges are swept by their least x, so that only those that overlap along it are compared.
fn first_crossing(
    ring: &[Corner],
    counts: &impl Fn(&Corner, &Corner) -> bool,
) -> Option<(usize, usize)> {
    let n = ring.len();
    let mut active: Vec<(f64, f64, usize)> = (0..n)
        .map(|i| (i, &ring[i], &ring[next(ring, i)]))
        .filter(|(_, from, to)| counts(from, to))
        .map(|(i, from, to)| (from.at.x.min(to.at.x), from.at.x.max(to.at.x), i))
        .collect();
    active.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut first: Option<(usize, usize)> = None;
    for (k, &(_, high, i)) in active.iter().enumerate() {
        for &(low, _, j) in &active[k + 1..] {
            if low > high {
                break;
            }
            let pair = (i.min(j), i.max(j));
            // Neighbours share a corner.
            let beside = pair.1 <= pair.0 + 1 || (pair.0 == 0 && pair.1 + 1 == n);
            if beside || first.is_some_and(|best| best <= pair) {
                continue;
            }
            let (a, b) = (&ring[pair.0].at, &ring[next(ring, pair.0)].at);
            let (c, d) = (&ring[pair.1].at, &ring[next(ring, pair.1)].at);
            let shares = a == c || a == d || b == c || b == d;
            if !shares && crosses(a, b, c, d) {
                first = Some(pair);
            }
        }
    }
    first
}
