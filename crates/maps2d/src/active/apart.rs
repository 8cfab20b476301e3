//! Views that meet several sheets which the area does not hold enough of to unite them.
//!
//! What lies twice stays so (\[Zie18\] 2.7.1). The largest sheet that can takes the view. On the others
//! what was frontier inside the view is free from then on, else the robot would have to explore the place
//! again on each of them; and they do not grow, else they would become maps of the whole place.

use super::Corner;
use super::area::Area;
use super::rings::{boxes_meet, crosses, next, parameters, twice_area_m2, winding};
use super::unite::{Broken, United, unite};
use super::walls::settle;
use geometry::planar::Interval;

/// Unites a view with one sheet, and settles frontier of the others inside it.
///
/// A sheet is an outer ring with its holes. An error where none can take the view. Cost: one union for
/// each sheet at most; and the holes near the view times the outer rings near it.
pub(super) fn unite_apart(
    rings: &[Vec<Corner>],
    view: &[Corner],
    active: &Area,
    keep_points: bool,
) -> Result<United, Broken> {
    let (near, far): (Vec<&Vec<Corner>>, Vec<&Vec<Corner>>) = rings.iter().partition(|ring| {
        boxes_meet(ring, view) && ring.iter().any(|corner| active.contains(corner.anchor))
    });
    let mut taken: Option<United> = None;
    let mut why = None;
    let mut others: Vec<Vec<Corner>> = Vec::new();
    for sheet in sheets_of(&near).into_iter().rev() {
        let mut sheet: Vec<Vec<Corner>> = sheet.into_iter().cloned().collect();
        if taken.is_none() {
            match unite(&sheet, view, active, keep_points) {
                Ok(united) if !united.crossings.is_empty() => {
                    taken = Some(united);
                    continue;
                }
                Ok(_) => {}
                Err(broken) => _ = why.get_or_insert(broken),
            }
        }
        sheet.iter_mut().for_each(|ring| settle_inside(ring, view, active));
        others.append(&mut sheet);
    }
    let Some(mut united) = taken else { return Err(why.unwrap_or(Broken::OpenLoop)) };
    // The loops that came out stay last.
    others.extend(far.into_iter().cloned());
    others.append(&mut united.rings);
    Ok(United { rings: others, ..united })
}

/// Marks as free what of a ring's frontier lies inside the view, where both its ends are in the area.
fn settle_inside(ring: &mut Vec<Corner>, view: &[Corner], active: &Area) {
    let takes =
        |from: &Corner, to: &Corner| active.contains(from.anchor) && active.contains(to.anchor);
    settle(ring, takes, |from, to, spans| {
        let mut cuts = vec![0.0, 1.0];
        for (side, corner) in view.iter().enumerate() {
            let end = &view[next(view, side)].at;
            if crosses(&from.at, &to.at, &corner.at, end) {
                cuts.push(parameters(&from.at, &to.at, &corner.at, end).0);
            }
        }
        cuts.sort_by(f64::total_cmp);
        spans.extend(cuts.windows(2).filter_map(|pair| {
            let middle = from.at + (to.at - from.at) * (0.5 * (pair[0] + pair[1]));
            let span = Interval { from: pair[0], to: pair[1] };
            (pair[0] < pair[1] && winding(view, &middle) > 0).then_some(span)
        }));
    });
}

/// The rings by sheet: an outer ring, and the holes whose smallest outer ring it is; a hole that lies
/// in none is one of its own. Larger ones come last.
fn sheets_of<'a>(rings: &[&'a Vec<Corner>]) -> Vec<Vec<&'a Vec<Corner>>> {
    let (mut outers, holes): (Vec<&Vec<Corner>>, Vec<&Vec<Corner>>) =
        rings.iter().partition(|ring| twice_area_m2(ring) > 0.0);
    outers.sort_by(|a, b| twice_area_m2(a).total_cmp(&twice_area_m2(b)));
    let mut sheets: Vec<Vec<&Vec<Corner>>> = outers.into_iter().map(|ring| vec![ring]).collect();
    let outers = sheets.len();
    let mut alone: Vec<Vec<&Vec<Corner>>> = Vec::new();
    for hole in holes {
        let lies_in = |outer: &[Corner]| {
            twice_area_m2(outer) > -twice_area_m2(hole)
                && boxes_meet(outer, hole)
                && is_mostly_in(hole, outer)
        };
        match (0..outers).find(|&sheet| lies_in(sheets[sheet][0])) {
            Some(sheet) => sheets[sheet].push(hole),
            None => alone.push(vec![hole]),
        }
    }
    alone.extend(sheets);
    alone
}

/// How many corners of a hole are asked where it lies.
const ASKED: usize = 8;

/// Whether most of a hole's corners lie in a ring: drift may have pushed a few of them out.
fn is_mostly_in(hole: &[Corner], outer: &[Corner]) -> bool {
    let asked: Vec<bool> = hole
        .iter()
        .step_by(hole.len().div_ceil(ASKED).max(1))
        .map(|corner| winding(outer, &corner.at) > 0)
        .collect();
    2 * asked.iter().filter(|inside| **inside).count() > asked.len()
}

#[cfg(test)]
mod tests {
    use geometry::planar::overlay::EdgeLabel;
    use probe::VertexId;

    use super::super::area::Links;
    use super::super::rings::tests::{areas_m2, rectangle};
    use super::*;

    /// The larger sheet takes the view; the other does not grow, and its frontier in view is settled.
    #[test]
    fn one_sheet_takes_the_view_and_the_other_is_settled() {
        let mut links = Links::default();
        links.cover(VertexId(0));
        let active = links.within(VertexId(0), 1);
        let mut small = rectangle(0, (4.0, 1.0), (9.0, 3.0));
        // Its far end is not in the area, so the sheets cannot be merged.
        small[1].anchor = VertexId(7);
        let rings = vec![small, rectangle(0, (0.0, 0.0), (6.0, 4.0))];
        let view = rectangle(0, (3.0, 2.5), (7.0, 5.0));
        assert_eq!(unite(&rings, &view, &active, true).err(), Some(Broken::OpenLoop));
        let united = unite_apart(&rings, &view, &active, true).unwrap();
        assert_eq!(areas_m2(&united.rings), [10.0, 24.0 + 10.0 - 4.5]);
        let free_m = |ring: &Vec<Corner>| -> f64 {
            let sides = ring.iter().enumerate();
            let free = sides.filter(|(_, corner)| corner.edge.label == EdgeLabel::Free);
            free.map(|(i, corner)| (ring[next(ring, i)].at - corner.at).norm()).sum()
        };
        let settled: Vec<f64> = united.rings.iter().map(free_m).collect();
        // From x = 4 to 7 along its upper side, and half a metre of its left side.
        assert!(settled.contains(&3.5) && settled.contains(&0.0), "{settled:?}");
    }
}
