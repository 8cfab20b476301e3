//! A first polyline with few knots: those that can be left out are.

use super::super::corridor::{Corridor, Knot};
use super::super::space::{Exit, Space};

/// Whether a segment may stand for all that is between its ends: it meets the faces between, exactly,
/// and keeps the radius from obstacles.
pub(super) fn is_direct(
    space: &Space,
    corridor: &Corridor,
    radius_m: f64,
    from: &Knot,
    to: &Knot,
) -> bool {
    gates_between(from, to).all(|gate| corridor.meets(space, gate, &from.at, &to.at))
        && (radius_m == 0.0 || space.obstacles().near_segment(&from.at, &to.at, radius_m).is_none())
}

/// The gates strictly between two knots: not those that they lie on.
pub(super) fn gates_between(from: &Knot, to: &Knot) -> std::ops::Range<u32> {
    from.place.div_ceil(2)..to.place / 2
}

/// Leaves out knots: from each one goes as far as a straight segment is allowed to, as far as doubling
/// and halving tells.
pub(super) fn pulled(
    space: &Space,
    corridor: &Corridor,
    radius_m: f64,
    knots: &[Knot],
) -> Vec<Knot> {
    let mut kept = vec![knots[0]];
    let mut at = 0;
    while at + 1 < knots.len() {
        let direct = |to: usize| is_direct(space, corridor, radius_m, &knots[at], &knots[to]);
        let last = knots.len() - 1;
        let (mut good, mut step) = (at + 1, 2);
        let mut bad = last + 1;
        while good < last {
            let to = (at + step).min(last);
            if direct(to) {
                good = to;
                step *= 2;
            } else {
                bad = to;
                break;
            }
        }
        while good + 1 < bad && bad <= last {
            let half = good.midpoint(bad);
            if direct(half) {
                good = half;
            } else {
                bad = half;
            }
        }
        kept.push(knots[good]);
        at = good;
    }
    kept
}

/// The exits are faces all: overlaps must be met by knots.
pub(super) fn is_overlap(corridor: &Corridor, knot: &Knot) -> bool {
    !knot.place.is_multiple_of(2)
        && matches!(corridor.exits[(knot.place / 2) as usize], Exit::Overlap(_))
}
