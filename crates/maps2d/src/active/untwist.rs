//! Rings that cross themselves are split, and parts that run the wrong way round dealt with
//! (\[Zie18\] 2.7.5).

use geometry::{Point2, Vector2};

use super::Corner;
use super::rings::{crosses, next, parameters, reversed, twice_area_m2, winding};

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
/// Parts are judged from the largest on, by what those before them say of a point inside: one that makes
/// it known twice is upended; one that makes it less than unknown was turned inside out where the ring
/// is an outer one, and says nothing where it is an inner one. Both kinds stay where they fit.
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
    // What surrounds an outer ring is unknown, what surrounds an inner one is known.
    let around = if outer { 0 } else { 1 };
    whole.sort_by(|a, b| twice_area_m2(b).abs().total_cmp(&twice_area_m2(a).abs()));
    let mut kept: Vec<Vec<Corner>> = Vec::new();
    for ring in whole {
        let area = twice_area_m2(&ring);
        if !kept.is_empty() && area.abs() < LEAST_M2 {
            continue;
        }
        let Some(point) = point_inside(&ring) else { continue };
        let before: i32 = around + kept.iter().map(|ring| winding(ring, &point)).sum::<i32>();
        let is_outer = area > 0.0;
        match (is_outer, twisted) {
            // Known twice.
            (true, Twisted::Flip) if before >= 1 => {
                done.flipped += 1;
                kept.push(reversed(&ring));
            }
            (true, Twisted::Remove) if before >= 1 => done.removed += 1,
            // A part of what is known that was turned inside out.
            (false, _) if before <= 0 && outer => {
                done.flipped += 1;
                kept.push(reversed(&ring));
            }
            // Unknown twice.
            (false, _) if before <= 0 => done.removed += 1,
            _ => kept.push(ring),
        }
    }
    kept
}

/// A point inside a ring that does not cross itself, beside its longest side.
fn point_inside(ring: &[Corner]) -> Option<Point2> {
    let along = |i: usize| ring[next(ring, i)].at - ring[i].at;
    let mut sides: Vec<usize> = (0..ring.len()).collect();
    sides.sort_by(|&a, &b| along(b).norm_squared().total_cmp(&along(a).norm_squared()));
    let sign = if twice_area_m2(ring) > 0.0 { 1.0 } else { -1.0 };
    let beside = |side: usize, share: f64| {
        let along = along(side);
        ring[side].at + along * 0.5 + Vector2::new(-along.y, along.x) * (sign * share)
    };
    let tried = [0.1, 1e-2, 1e-3, 1e-5].into_iter();
    let mut points = tried.flat_map(|share| sides.iter().map(move |&side| beside(side, share)));
    points.find(|point| winding(ring, point) != 0)
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

#[cfg(test)]
mod tests {
    use super::super::rings::tests::ring;
    use super::*;

    /// The signed areas of the parts, ascending, and what was done.
    fn parts(corners: &[(f64, f64)], twisted: Twisted) -> (Vec<f64>, Splits) {
        let (mut done, mut at) = (Splits::default(), Vec::new());
        let kept = untwist(ring(0, corners), |_, _| true, twisted, &mut done, &mut at);
        let mut areas: Vec<f64> = kept.iter().map(|ring| 0.5 * twice_area_m2(ring)).collect();
        areas.sort_by(f64::total_cmp);
        (areas, done)
    }

    /// Two rooms whose neck is so narrow that drift pushed its walls through each other.
    #[test]
    fn a_room_behind_a_twisted_neck_stays_known() {
        let corners = [
            (0.0, 0.0),
            (4.0, 0.0),
            (5.0, 1.1),
            (7.0, 1.1),
            (8.0, 0.0),
            (11.0, 0.0),
            (11.0, 2.0),
            (8.0, 2.0),
            (7.0, 0.9),
            (5.0, 0.9),
            (4.0, 2.0),
            (0.0, 2.0),
        ];
        for twisted in [Twisted::Flip, Twisted::Remove] {
            let (areas, done) = parts(&corners, twisted);
            assert_eq!(done.splits, 2);
            // The neck was known, too; it is turned back.
            assert_eq!((done.flipped, done.removed), (1, 0), "{areas:?}");
            assert!(areas.len() == 3 && areas.iter().all(|area| *area > 0.0), "{areas:?}");
        }
    }

    /// A corridor that came round to its own beginning, and lies on it.
    #[test]
    fn what_is_known_twice_is_flipped_or_removed() {
        let corners = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 6.0),
            (-1.0, 6.0),
            (-1.0, 0.5),
            (0.5, 0.5),
            (0.5, 5.0),
            (5.0, 5.0),
            (5.0, 1.0),
            (0.0, 1.0),
        ];
        let (areas, done) = parts(&corners, Twisted::Remove);
        assert_eq!((done.splits, done.flipped, done.removed), (2, 0, 1));
        assert!(
            areas.len() == 2 && areas[0] < 0.0 && areas[1] > 0.0,
            "a room with a hole: {areas:?}"
        );
        let (flipped, done) = parts(&corners, Twisted::Flip);
        assert_eq!((done.flipped, done.removed), (1, 0));
        let twice_m2 = 0.25;
        assert!(flipped.iter().any(|area| (area + twice_m2).abs() < 1e-9), "{flipped:?}");
    }
}
