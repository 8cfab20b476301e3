//! Partition into monotone polygons, and their triangulation.

use std::cmp::Ordering;

use crate::image::Pixel;
use crate::triangulate::orient;

use super::Piece;

/// Room for the sweep.
#[derive(Clone, Debug, Default)]
pub(super) struct Sweep {
    order: Vec<u16>,
    /// Sides that the sweep line cuts with the inside to their right, and each one's helper.
    status: Vec<(u16, u16)>,
    diagonals: Vec<(u16, u16)>,
    parts: Vec<Vec<u16>>,
    stack: Vec<u16>,
    sorted: Vec<(u16, bool)>,
}

/// From top to bottom, and from left to right in a row.
fn compare(a: Pixel, b: Pixel) -> Ordering {
    (a[1], a[0]).cmp(&(b[1], b[0]))
}

/// Cuts the polygon into parts that each row meets in one stretch (\[Mos15\] 3.6.3), then each part
/// into triangles by two chains (3.6.2).
///
/// The sweep is that of de Berg et al., *Computational Geometry*, 3.2: a split corner is joined to
/// the helper of the side left of it, a merge corner to the next corner below. Scenario 6 of the
/// thesis tests visibility pair by pair; the stack needs none. Its simplification "corners of one
/// chain are never joined" is not right, and not used. O(n log n) but for the short list of sides
/// that the line cuts, which is searched one by one.
pub(super) fn triangulate(polygon: &[Pixel], sweep: &mut Sweep, pieces: &mut Vec<Piece>) {
    partition(polygon, sweep);
    let mut parts = std::mem::take(&mut sweep.parts);
    split_along(polygon, &sweep.diagonals, &mut parts);
    for part in &parts {
        triangulate_part(polygon, part, sweep, pieces);
    }
    sweep.parts = parts;
}

#[derive(PartialEq)]
enum Corner {
    Start,
    End,
    Split,
    Merge,
    /// Not an extreme; the inside lies right of it.
    InsideRight,
    /// Not an extreme; the inside lies left of it.
    InsideLeft,
}

fn corner_of(polygon: &[Pixel], i: u16) -> Corner {
    let n = polygon.len();
    let i = usize::from(i);
    let (before, here, after) = (polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]);
    let convex = orient(before, here, after) > 0;
    match (compare(before, here).is_lt(), compare(after, here).is_lt()) {
        (false, false) if convex => Corner::Start,
        (false, false) => Corner::Split,
        (true, true) if convex => Corner::End,
        (true, true) => Corner::Merge,
        // Positive turns run down on the right and up on the left, rows counting downwards.
        (true, false) => Corner::InsideLeft,
        (false, true) => Corner::InsideRight,
    }
}

fn partition(polygon: &[Pixel], sweep: &mut Sweep) {
    let n = polygon.len() as u16;
    sweep.diagonals.clear();
    sweep.status.clear();
    sweep.order.clear();
    sweep.order.extend(0..n);
    sweep
        .order
        .sort_unstable_by(|&a, &b| compare(polygon[usize::from(a)], polygon[usize::from(b)]));
    for step in 0..sweep.order.len() {
        let i = sweep.order[step];
        let corner = corner_of(polygon, i);
        // A side is named by its lower end, which comes first in order of positive turns on the
        // left of the inside: side `s` runs from corner `s` up to corner `s + 1`.
        let ending = i;
        let starting = (i + n - 1) % n;
        let close = |sweep: &mut Sweep, side: u16| {
            if let Some(at) = sweep.status.iter().position(|&(s, _)| s == side) {
                let (_, helper) = sweep.status.swap_remove(at);
                if corner_of(polygon, helper) == Corner::Merge {
                    join(polygon, sweep, i, helper);
                }
            }
        };
        match corner {
            Corner::Start => sweep.status.push((starting, i)),
            Corner::End => close(sweep, ending),
            Corner::Split => {
                if let Some(at) = left_of(polygon, sweep, i) {
                    let helper = sweep.status[at].1;
                    join(polygon, sweep, i, helper);
                    sweep.status[at].1 = i;
                }
                sweep.status.push((starting, i));
            }
            Corner::Merge => {
                close(sweep, ending);
                hand_over(polygon, sweep, i);
            }
            Corner::InsideRight => {
                close(sweep, ending);
                sweep.status.push((starting, i));
            }
            Corner::InsideLeft => hand_over(polygon, sweep, i),
        }
    }
}

/// Makes the corner the helper of the side left of it.
fn hand_over(polygon: &[Pixel], sweep: &mut Sweep, i: u16) {
    if let Some(at) = left_of(polygon, sweep, i) {
        let helper = sweep.status[at].1;
        if corner_of(polygon, helper) == Corner::Merge {
            join(polygon, sweep, i, helper);
        }
        sweep.status[at].1 = i;
    }
}

fn join(polygon: &[Pixel], sweep: &mut Sweep, a: u16, b: u16) {
    let n = polygon.len() as u16;
    if (a + 1) % n != b && (b + 1) % n != a {
        sweep.diagonals.push((a.min(b), a.max(b)));
    }
}

/// The side of the status that is the nearest to the left of a corner.
fn left_of(polygon: &[Pixel], sweep: &Sweep, i: u16) -> Option<usize> {
    let n = polygon.len();
    let p = polygon[usize::from(i)];
    // A side from its lower end up to its upper end has what is left of it on its negative side...
    let ends = |side: u16| (polygon[(usize::from(side) + 1) % n], polygon[usize::from(side)]);
    let mut best: Option<usize> = None;
    for (at, &(side, _)) in sweep.status.iter().enumerate() {
        let (upper, lower) = ends(side);
        // ... so a corner right of it turns negatively from its upper end to its lower end.
        if orient(upper, lower, p) >= 0 {
            continue;
        }
        let nearer = best.is_none_or(|best| {
            let (other_upper, other_lower) = ends(sweep.status[best].0);
            // Of two sides that the line cuts, the one whose end lies right of the other.
            if compare(upper, other_upper).is_ge() {
                orient(other_upper, other_lower, upper) < 0
                    || (orient(other_upper, other_lower, upper) == 0
                        && orient(other_upper, other_lower, lower) < 0)
            } else {
                orient(upper, lower, other_upper) > 0
                    || (orient(upper, lower, other_upper) == 0
                        && orient(upper, lower, other_lower) > 0)
            }
        });
        if nearer {
            best = Some(at);
        }
    }
    best
}

/// Cuts the polygon along its diagonals, which do not cross.
fn split_along(polygon: &[Pixel], diagonals: &[(u16, u16)], parts: &mut Vec<Vec<u16>>) {
    parts.clear();
    parts.push((0..polygon.len() as u16).collect());
    for &(a, b) in diagonals {
        let holder = parts.iter().position(|part| {
            let at = |corner| part.iter().position(|&c| c == corner);
            // Both corners, and not joined already.
            matches!((at(a), at(b)), (Some(p), Some(q)) if p.abs_diff(q) > 1 && p.abs_diff(q) + 1 < part.len())
        });
        let Some(holder) = holder else { continue };
        let part = &mut parts[holder];
        let at = |corner| part.iter().position(|&c| c == corner).unwrap_or(0);
        let (p, q) = (at(a).min(at(b)), at(a).max(at(b)));
        let cut: Vec<u16> = part[p..=q].to_vec();
        part.drain(p + 1..q);
        parts.push(cut);
    }
}

/// Triangulates a part that is monotone from top to bottom.
fn triangulate_part(polygon: &[Pixel], part: &[u16], sweep: &mut Sweep, pieces: &mut Vec<Piece>) {
    let at = |i: u16| polygon[usize::from(i)];
    let n = part.len();
    if n == 3 {
        pieces.push([part[0], part[1], part[2]]);
        return;
    }
    let by_row = |a: &usize, b: &usize| compare(at(part[*a]), at(part[*b]));
    let (Some(top), Some(bottom)) = ((0..n).min_by(by_row), (0..n).max_by(by_row)) else { return };
    // Positive turns lead from the top down the right chain to the bottom.
    sweep.sorted.clear();
    let right = (bottom + n - top) % n;
    sweep.sorted.extend((0..n).map(|step| (part[(top + step) % n], step > 0 && step <= right)));
    sweep.sorted.sort_unstable_by(|a, b| compare(at(a.0), at(b.0)));
    sweep.stack.clear();
    // The chain of what is on top of the stack.
    let mut on_right = sweep.sorted[1].1;
    let (first, second) = (sweep.sorted[0].0, sweep.sorted[1].0);
    sweep.stack.extend([first, second]);
    let mut push = |a: u16, b: u16, c: u16| {
        pieces.push(if orient(at(a), at(b), at(c)) > 0 { [a, b, c] } else { [a, c, b] });
    };
    for step in 2..n {
        let (corner, is_right) = sweep.sorted[step];
        // Both chains lead to the bottom, so it counts to the one that waits: what waits is nowhere
        // convex, so that the bottom cuts off all of it, and no flat triangle is made.
        if step < n - 1 && is_right != on_right {
            for pair in sweep.stack.windows(2) {
                push(corner, pair[0], pair[1]);
            }
            let last = sweep.stack[sweep.stack.len() - 1];
            sweep.stack.clear();
            sweep.stack.extend([last, corner]);
            on_right = is_right;
        } else {
            while let [.., below, last] = sweep.stack[..] {
                let turn = orient(at(below), at(last), at(corner));
                if (on_right && turn <= 0) || (!on_right && turn >= 0) {
                    break;
                }
                push(below, last, corner);
                sweep.stack.pop();
            }
            sweep.stack.push(corner);
        }
    }
}
