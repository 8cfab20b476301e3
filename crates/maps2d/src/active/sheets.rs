//! Sheets that lie over each other inside the active area (\[Zie18\] 2.7.3).
//!
//! A robot that comes back to its own ground before it recognises it lays a second sheet over it, as a
//! ring of its own. Once a loop closes, both are in the area; a view that meets both of them would
//! leave one sheet while it is still on the other, and no entry follows. So they are united first: two
//! parts of what is known are treated as two polygons.

use std::collections::BTreeSet;

use geometry::Point2;

use super::Corner;
use super::area::Area;
use super::rings::{boxes_meet, crosses, next, reversed, twice_area_m2, winding};
use super::unite::{Crossing, United, unite};

/// Unites rings whose edges cross inside the area, pair by pair; a pair that cannot be united stays.
/// Returns where boundaries went over from one to the other.
///
/// At most as many unions as there are rings. Cost: the edges in the area, sorted, for each.
pub(super) fn merge_sheets(
    rings: &mut Vec<Vec<Corner>>,
    active: &Area,
    keep_points: bool,
) -> Vec<Crossing> {
    let mut merged = Vec::new();
    for _ in 0..rings.len() {
        let united = crossing_pairs(rings, active).into_iter().find_map(|(a, b)| {
            let united = match twice_area_m2(&rings[b]) > 0.0 {
                true => unite_sheets(rings, (a, b), active, keep_points),
                false => unite_holes(rings, (a, b), active, keep_points),
            };
            let united = united.filter(|united| !united.crossings.is_empty())?;
            Some((a.min(b), a.max(b), united))
        });
        let Some((first, last, united)) = united else { break };
        rings.remove(last);
        rings.remove(first);
        rings.extend(united.rings);
        merged.extend(united.crossings);
    }
    drop_nested(rings, active);
    merged
}

/// Drops outer rings that lie in another, where the area holds all of both: nothing is known by them
/// that the other does not know; and holes in what is unknown without them.
fn drop_nested(rings: &mut Vec<Vec<Corner>>, active: &Area) {
    let is_whole = |ring: &Vec<Corner>| {
        twice_area_m2(ring) > 0.0 && ring.iter().all(|corner| active.contains(corner.anchor))
    };
    let whole: Vec<usize> = (0..rings.len()).filter(|&index| is_whole(&rings[index])).collect();
    let lies_in = |inner: usize, outer: usize| {
        inner != outer
            && boxes_meet(&rings[inner], &rings[outer])
            && rings[inner].iter().all(|corner| winding(&rings[outer], &corner.at) > 0)
    };
    let nested =
        whole.iter().copied().filter(|&inner| whole.iter().any(|&outer| lies_in(inner, outer)));
    let nested: Vec<usize> = nested.collect();
    for index in nested.into_iter().rev() {
        rings.remove(index);
    }
    for index in (0..rings.len()).rev() {
        let is_in_hole = twice_area_m2(&rings[index]) < 0.0
            && rings[index].iter().all(|corner| {
                let others = rings.iter().enumerate().filter(|&(other, _)| other != index);
                others.map(|(_, ring)| winding(ring, &corner.at)).sum::<i32>() <= 0
            });
        if is_in_hole {
            rings.remove(index);
        }
    }
}

fn unite_sheets(
    rings: &[Vec<Corner>],
    (a, b): (usize, usize),
    active: &Area,
    keep_points: bool,
) -> Option<United> {
    if !may_swallow(rings, a, b) {
        return None;
    }
    unite(std::slice::from_ref(&rings[a]), &rings[b], active, keep_points).ok()
}

/// Holes of one sheet that overlap are one hole: seen from the unknown, they are united as rings are.
fn unite_holes(
    rings: &[Vec<Corner>],
    (a, b): (usize, usize),
    active: &Area,
    keep_points: bool,
) -> Option<United> {
    let others = || rings.iter().enumerate().filter(|&(index, _)| index != b);
    let known = |point: &Point2| others().map(|(_, ring)| winding(ring, point)).sum::<i32>();
    let mut inside = rings[b].iter().filter(|corner| winding(&rings[a], &corner.at) != 0);
    if inside.any(|corner| known(&corner.at) > 0) {
        // Another sheet is known there.
        return None;
    }
    let (first, second) = (reversed(&rings[a]), reversed(&rings[b]));
    let united = unite(&[first], &second, active, keep_points).ok()?;
    let rings = united.rings.iter().map(|ring| reversed(ring)).collect();
    Some(United { rings, ..united })
}

/// Whether the first ring is an outer one, too, or a hole of another sheet: where the second lies
/// outside that hole, something else is known around it, so its boundary there may go.
fn may_swallow(rings: &[Vec<Corner>], first: usize, second: usize) -> bool {
    let near: Vec<&Vec<Corner>> = rings
        .iter()
        .enumerate()
        .filter(|&(index, ring)| index != second && boxes_meet(ring, &rings[second]))
        .map(|(_, ring)| ring)
        .collect();
    let is_known = |point: &Point2| near.iter().map(|ring| winding(ring, point)).sum::<i32>() > 0;
    twice_area_m2(&rings[first]) > 0.0
        || rings[second]
            .iter()
            .all(|corner| winding(&rings[first], &corner.at) != 0 || is_known(&corner.at))
}

/// Pairs of rings that cross inside the area, each once, ascending; if either is an outer one, the
/// second is.
fn crossing_pairs(rings: &[Vec<Corner>], active: &Area) -> BTreeSet<(usize, usize)> {
    let is_outer: Vec<bool> = rings.iter().map(|ring| twice_area_m2(ring) > 0.0).collect();
    // Edges are swept by their least x, so that only those that overlap along it are compared.
    let mut edges: Vec<(f64, f64, usize, usize)> = Vec::new();
    for (index, ring) in rings.iter().enumerate() {
        for (edge, from) in ring.iter().enumerate() {
            let to = &ring[next(ring, edge)];
            if active.contains(from.anchor) && active.contains(to.anchor) {
                edges.push((from.at.x.min(to.at.x), from.at.x.max(to.at.x), index, edge));
            }
        }
    }
    edges.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.2, a.3).cmp(&(b.2, b.3))));
    let mut pairs = BTreeSet::new();
    for (k, &(_, high, i, edge)) in edges.iter().enumerate() {
        let (a, b) = (&rings[i][edge].at, &rings[i][next(&rings[i], edge)].at);
        for &(low, _, j, other) in &edges[k + 1..] {
            if low > high {
                break;
            }
            let (first, second) =
                if is_outer[i.max(j)] { (i.min(j), i.max(j)) } else { (i.max(j), i.min(j)) };
            if i == j || pairs.contains(&(first, second)) {
                continue;
            }
            let (c, d) = (&rings[j][other].at, &rings[j][next(&rings[j], other)].at);
            if crosses(a, b, c, d) {
                pairs.insert((first, second));
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::super::area::Links;
    use super::super::rings::tests::{areas_m2, rectangle};
    use super::super::unite::Broken;
    use super::*;
    use probe::VertexId;

    fn area_of_zero() -> Area {
        let mut links = Links::default();
        links.cover(VertexId(0));
        links.within(VertexId(0), 1)
    }

    /// A view that leaves one sheet while it is still on another cannot be united, but for this.
    #[test]
    fn sheets_that_cross_are_one() {
        let mut rings =
            vec![rectangle(0, (0.0, 0.0), (6.0, 4.0)), rectangle(0, (4.0, 1.0), (9.0, 3.0))];
        let view = rectangle(0, (3.0, 2.5), (7.0, 5.0));
        assert_eq!(unite(&rings, &view, &area_of_zero(), true).err(), Some(Broken::OpenLoop));
        let merged = merge_sheets(&mut rings, &area_of_zero(), true);
        assert_eq!((merged.len(), areas_m2(&rings)), (2, vec![30.0]));
        let united = unite(&rings, &view, &area_of_zero(), true).unwrap();
        assert_eq!(areas_m2(&united.rings), [30.0 + 10.0 - 4.5 - 0.5]);
    }

    #[test]
    fn sheets_that_cross_outside_the_area_stay() {
        let mut rings =
            vec![rectangle(0, (0.0, 0.0), (6.0, 4.0)), rectangle(7, (4.0, 1.0), (9.0, 3.0))];
        assert!(merge_sheets(&mut rings, &area_of_zero(), true).is_empty());
        assert_eq!(areas_m2(&rings), [10.0, 24.0]);
    }

    /// An island in a hole of its sheet grows over the edge of the hole; the sheet around stays.
    #[test]
    fn an_island_and_the_hole_around_it_become_a_smaller_hole() {
        let hole = reversed(&rectangle(0, (2.0, 2.0), (8.0, 8.0)));
        let island = rectangle(0, (3.0, 3.0), (9.0, 5.0));
        let mut rings = vec![rectangle(0, (0.0, 0.0), (10.0, 10.0)), hole, island];
        merge_sheets(&mut rings, &area_of_zero(), true);
        assert_eq!(areas_m2(&rings), [-26.0, 100.0]);
    }

    /// What a hole leaves of the ring that it lies in is not for a union to find.
    #[test]
    fn a_hole_that_sticks_out_of_its_own_ring_swallows_nothing() {
        let hole = reversed(&rectangle(0, (5.0, 1.0), (11.0, 3.0)));
        let mut rings = vec![rectangle(0, (0.0, 0.0), (10.0, 4.0)), hole];
        let before = rings.clone();
        assert!(merge_sheets(&mut rings, &area_of_zero(), true).is_empty());
        assert_eq!(rings, before);
    }

    #[test]
    fn holes_that_overlap_are_one_and_holes_in_holes_none() {
        let hole = |low, high| reversed(&rectangle(0, low, high));
        let mut rings = vec![
            rectangle(0, (0.0, 0.0), (10.0, 10.0)),
            hole((1.0, 1.0), (5.0, 5.0)),
            hole((4.0, 2.0), (7.0, 4.0)),
            hole((2.0, 2.0), (3.0, 3.0)),
        ];
        merge_sheets(&mut rings, &area_of_zero(), true);
        assert_eq!(areas_m2(&rings), [-20.0, 100.0]);
    }

    #[test]
    fn a_sheet_in_a_sheet_goes_where_the_area_holds_both() {
        for (vertex, left) in [(0, vec![100.0]), (7, vec![4.0, 100.0])] {
            let inner = rectangle(vertex, (1.0, 1.0), (3.0, 3.0));
            let mut rings = vec![rectangle(0, (0.0, 0.0), (10.0, 10.0)), inner];
            merge_sheets(&mut rings, &area_of_zero(), true);
            assert_eq!(areas_m2(&rings), left);
        }
    }
}
