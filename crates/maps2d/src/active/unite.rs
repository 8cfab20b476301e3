//! The union of the map's rings with a view, inside the active area (\[Zie18\] 2.6, 2.7.1, 2.7.2).

use std::collections::BTreeSet;

use super::Corner;
use super::area::Area;
use super::rings::{crosses, joined, next, parameters, twice_area_m2, winding};
use geometry::Point2;

/// Why a union was not made: the map is not what it should be there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// An entry without an exit, or the other way round.
    Unpaired,
    /// A loop that does not close.
    OpenLoop,
    /// The robot is outside its own map.
    RobotOutside,
}

impl Broken {
    /// In a few words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unpaired => "entry without exit",
            Self::OpenLoop => "loop that does not close",
            Self::RobotOutside => "robot outside its map",
        }
    }
}

/// Where an edge of a ring and an edge of the view cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub at: Point2,
    /// Whether the ring enters the view here (eq. 2.11), else it leaves it.
    pub entry: bool,
    pub ring: usize,
    pub edge: usize,
    pub along_edge: f64,
    pub side: usize,
    pub along_side: f64,
}

/// What a union came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct United {
    pub rings: Vec<Vec<Corner>>,
    pub crossings: Vec<Crossing>,
    /// How many of them were found by following a ring on (2.7.2).
    pub followed: usize,
    /// Rings that came out of the crossings.
    pub loops: usize,
}

/// Rings smaller than this are nothing, square metres.
const LEAST_M2: f64 = 1e-6;

/// Unites a view with the rings. `keep_points` says whether intersection points become corners.
///
/// Cost: edges of the rings times sides of the view, where all is active.
pub(super) fn unite(
    rings: &[Vec<Corner>],
    view: &[Corner],
    active: &Area,
    keep_points: bool,
) -> Result<United, Broken> {
    let mut found = United::default();
    for (index, ring) in rings.iter().enumerate() {
        for edge in 0..ring.len() {
            let ends = [ring[edge].anchor, ring[next(ring, edge)].anchor];
            if ends.iter().all(|anchor| active.contains(*anchor)) {
                let is_active = |side: usize| {
                    let ends = [view[side].anchor, view[next(view, side)].anchor];
                    ends.iter().all(|anchor| active.contains(*anchor))
                };
                cross(ring, (index, edge), view, is_active, &mut found.crossings);
            }
        }
    }
    for (index, ring) in rings.iter().enumerate() {
        found.followed += follow(ring, index, view, &mut found.crossings);
    }
    if found.crossings.is_empty() {
        found.rings = without_crossing(rings, view, active);
        return Ok(found);
    }
    check_pairs(rings.len(), &mut found.crossings)?;
    let (loops, walked) = walk(rings, view, &found.crossings, keep_points)?;
    found.loops = loops.len();
    for (index, ring) in rings.iter().enumerate() {
        let swallowed = twice_area_m2(ring) < 0.0 || !walked[index];
        let inside = ring.first().is_some_and(|corner| {
            swallowed && active.contains(corner.anchor) && winding(view, &corner.at) > 0
        });
        if !walked[index] && !inside {
            found.rings.push(ring.clone());
        }
    }
    found.rings.extend(loops);
    Ok(found)
}

/// The crossings of one edge with the sides of the view that count.
fn cross(
    ring: &[Corner],
    (index, edge): (usize, usize),
    view: &[Corner],
    counts: impl Fn(usize) -> bool,
    out: &mut Vec<Crossing>,
) {
    let (a, b) = (&ring[edge].at, &ring[next(ring, edge)].at);
    for side in (0..view.len()).filter(|&side| counts(side)) {
        let (c, d) = (&view[side].at, &view[next(view, side)].at);
        if !crosses(a, b, c, d) {
            continue;
        }
        let (along_edge, along_side) = parameters(a, b, c, d);
        // What is known lies to the left of the view's sides.
        let entry = geometry::predicates::orient(c, d, b) >= 0.0;
        let at = a + (b - a) * along_edge;
        out.push(Crossing { at, entry, ring: index, edge, along_edge, side, along_side });
    }
}

/// Follows a ring on from crossings whose partner lies outside the active area (2.7.2); returns how
/// many were found.
fn follow(ring: &[Corner], index: usize, view: &[Corner], crossings: &mut Vec<Crossing>) -> usize {
    let first = crossings.len();
    let starts: Vec<Crossing> = crossings.iter().copied().filter(|c| c.ring == index).collect();
    // Edges that were asked already, and those of them that cross the view.
    let mut known: BTreeSet<usize> = starts.iter().map(|c| c.edge).collect();
    let mut crossed = known.clone();
    for start in starts {
        let mut edge = start.edge;
        for _ in 0..ring.len() {
            // Forward from an entry, back from an exit.
            edge = match start.entry {
                true => next(ring, edge),
                false => edge.checked_sub(1).unwrap_or(ring.len() - 1),
            };
            if known.insert(edge) {
                let before = crossings.len();
                cross(ring, (index, edge), view, |_| true, crossings);
                if crossings.len() > before {
                    crossed.insert(edge);
                }
            }
            if crossed.contains(&edge) {
                break;
            }
        }
    }
    crossings.len() - first
}

/// Sorts crossings along the rings; entries and exits have to take turns.
fn check_pairs(rings: usize, crossings: &mut [Crossing]) -> Result<(), Broken> {
    crossings.sort_by(|a, b| {
        (a.ring, a.edge).cmp(&(b.ring, b.edge)).then(a.along_edge.total_cmp(&b.along_edge))
    });
    for ring in 0..rings {
        let of: Vec<bool> = crossings.iter().filter(|c| c.ring == ring).map(|c| c.entry).collect();
        let turns = (0..of.len()).all(|i| of[i] != of[(i + 1) % of.len()]);
        if !of.is_empty() && !turns {
            return Err(Broken::Unpaired);
        }
    }
    Ok(())
}

/// Walks the loops of the union: out along a ring from an exit, over to the view at the next entry,
/// back at the next exit (eq. 2.6). Says which rings were walked on.
fn walk(
    rings: &[Vec<Corner>],
    view: &[Corner],
    crossings: &[Crossing],
    keep_points: bool,
) -> Result<(Vec<Vec<Corner>>, Vec<bool>), Broken> {
    let mut along_view: Vec<usize> = (0..crossings.len()).collect();
    along_view.sort_by(|&a, &b| {
        let (a, b) = (&crossings[a], &crossings[b]);
        a.side.cmp(&b.side).then(a.along_side.total_cmp(&b.along_side))
    });
    let mut rank = vec![0; crossings.len()];
    along_view.iter().enumerate().for_each(|(place, &i)| rank[i] = place);
    let after_on_ring = |i: usize| {
        let ring = crossings[i].ring;
        let first = crossings.partition_point(|c| c.ring < ring);
        let end = crossings.partition_point(|c| c.ring <= ring);
        if i + 1 == end { first } else { i + 1 }
    };
    let mut walked = vec![false; rings.len()];
    crossings.iter().for_each(|crossing| walked[crossing.ring] = true);
    let mut visited = vec![false; crossings.len()];
    let mut loops = Vec::new();
    for start in (0..crossings.len()).filter(|&i| !crossings[i].entry) {
        if visited[start] {
            continue;
        }
        let mut ring: Vec<Corner> = Vec::new();
        let mut exit = start;
        loop {
            if std::mem::replace(&mut visited[exit], true) {
                if exit == start && !ring.is_empty() {
                    break;
                }
                return Err(Broken::OpenLoop);
            }
            let (out, entry) = (crossings[exit], after_on_ring(exit));
            let back = crossings[entry];
            let on = &rings[out.ring];
            turn(&mut ring, out.at, on[out.edge], keep_points);
            stretch(&mut ring, on, (out.edge, out.along_edge), (back.edge, back.along_edge));
            let place = rank[entry] + 1;
            exit = along_view[if place == along_view.len() { 0 } else { place }];
            if crossings[exit].entry {
                return Err(Broken::OpenLoop);
            }
            let to = crossings[exit];
            turn(&mut ring, back.at, view[back.side], keep_points);
            stretch(&mut ring, view, (back.side, back.along_side), (to.side, to.along_side));
        }
        if !keep_points && let (Some(first), Some(last)) = (crossings.get(start), ring.last_mut()) {
            // The loop closes over an intersection that is left out.
            last.edge = joined(last.edge, rings[first.ring][first.edge].edge);
        }
        if ring.len() >= 3 && twice_area_m2(&ring).abs() >= 2.0 * LEAST_M2 {
            loops.push(ring);
        }
    }
    Ok((loops, walked))
}

/// Goes over to another edge at an intersection.
fn turn(ring: &mut Vec<Corner>, at: Point2, onto: Corner, keep_points: bool) {
    if keep_points {
        ring.push(Corner { at, ..onto });
    } else if let Some(last) = ring.last_mut() {
        last.edge = joined(last.edge, onto.edge);
    }
}

/// The corners of a chain between two places on its edges.
fn stretch(out: &mut Vec<Corner>, chain: &[Corner], from: (usize, f64), to: (usize, f64)) {
    if from.0 == to.0 && from.1 <= to.1 {
        return;
    }
    let mut edge = from.0;
    for _ in 0..=chain.len() {
        edge = next(chain, edge);
        out.push(chain[edge]);
        if edge == to.0 {
            break;
        }
    }
}

/// No crossing: the view lies in what is known, or around it, or apart.
fn without_crossing(rings: &[Vec<Corner>], view: &[Corner], active: &Area) -> Vec<Vec<Corner>> {
    let Some(first) = view.first() else { return rings.to_vec() };
    // Active rings inside the view: all that they bound was seen now.
    let mut kept: Vec<Vec<Corner>> = rings
        .iter()
        .filter(|ring| {
            let inside =
                |corner: &Corner| active.contains(corner.anchor) && winding(view, &corner.at) > 0;
            !ring.iter().all(inside)
        })
        .cloned()
        .collect();
    let around: i32 = kept.iter().map(|ring| winding(ring, &first.at)).sum();
    if around <= 0 {
        kept.push(view.to_vec());
    }
    kept
}
