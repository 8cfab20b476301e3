//! All missing segments and facets, with rising effort.

use probe::Probe;

use super::segments::Attempt;
use crate::tetrahedra::events::{Cause, TetrahedraEvent};
use crate::tetrahedra::flips::{Effort, Work};

/// First the cheap flips for all, which often clear the way of others, then the costly ones for what
/// is left.
const EFFORTS: [Effort; 3] = [
    Effort { depth: 0, ring: 16, tries: 0 },
    Effort { depth: 1, ring: 24, tries: 60 },
    Effort { depth: 2, ring: 40, tries: 400 },
];
/// After each effort, how many vertices a region to reconnect may have, and how many steps a search.
const REGIONS: [(usize, u32); 3] = [(12, 100), (16, 200), (20, 300)];
/// How often constraints are divided, all stuck ones once each.
const MOST_ROUNDS: usize = 16;

/// What a pass works on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Segments,
    Facets,
}

/// Makes all segments and facets appear: by flips, by reconnection, with free points, and at last by
/// dividing what is stuck. Returns the facets of the input that are still missing: none where all went
/// well.
pub(crate) fn conform(
    work: &mut Work,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Vec<u32> {
    for round in 0..MOST_ROUNDS {
        let stuck = pass(work, Kind::Segments, round > 0, probe);
        if !stuck.is_empty() {
            let mut divided = false;
            for id in stuck {
                let points = work.mesh.points.len();
                divided |= work.must.segments[id as usize].live && work.split_segment(id);
                commit(work, Cause::Divide, points, probe);
            }
            if !divided {
                break;
            }
            continue;
        }
        let stuck = pass(work, Kind::Facets, round > 0, probe);
        if stuck.is_empty() {
            break;
        }
        let mut divided = false;
        for id in stuck {
            let points = work.mesh.points.len();
            divided |= work.split_facet(id);
            commit(work, Cause::Divide, points, probe);
        }
        if !divided {
            break;
        }
    }
    let mut missing = work.missing_facets();
    for segment in work.missing_segments() {
        missing.extend(&work.must.segments[segment as usize].faces);
    }
    let mut inputs: Vec<u32> =
        missing.into_iter().map(|f| work.must.facets[f as usize].input).collect();
    inputs.sort_unstable();
    inputs.dedup();
    inputs
}

/// Tries to bring in all that is missing of one kind; returns what is stuck.
fn pass(
    work: &mut Work,
    kind: Kind,
    again: bool,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Vec<u32> {
    let mut missing = match kind {
        Kind::Segments if again => work.missing_segments(),
        Kind::Segments => work.hold_present_segments(),
        Kind::Facets if again => work.missing_facets(),
        Kind::Facets => work.hold_present_facets(),
    };
    for (effort, (most, steps)) in EFFORTS.into_iter().zip(REGIONS) {
        loop {
            let before = missing.len();
            work.sweep(kind, &mut missing, probe, |work, item| match item {
                Item::Segment(a, b) => work.recover_segment(a, b, effort) == Attempt::Done,
                Item::Facet(corners) => work.recover_facet(corners, effort) == Attempt::Done,
            });
            if missing.is_empty() {
                return missing;
            }
            if missing.len() == before {
                break;
            }
        }
        work.sweep(kind, &mut missing, probe, |work, item| match item {
            Item::Segment(a, b) => work.reconnect_segment(a, b, most, steps),
            Item::Facet(corners) => work.reconnect_facet(corners, most, steps),
        });
    }
    work.sweep(kind, &mut missing, probe, |work, item| match item {
        Item::Segment(a, b) => {
            work.recover_segment(a, b, EFFORTS[1]) == Attempt::Done
                || work.detour(a, b, EFFORTS[1])
                || work.unlock_segment(a, b)
        }
        Item::Facet(corners) => {
            work.recover_facet(corners, EFFORTS[1]) == Attempt::Done || work.unlock_facet(corners)
        }
    });
    missing
}

/// One thing to bring in.
enum Item {
    Segment(u32, u32),
    Facet([u32; 3]),
}

impl Work {
    /// Tries each of `missing` and holds what comes in; what is left stays.
    fn sweep(
        &mut self,
        kind: Kind,
        missing: &mut Vec<u32>,
        probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
        mut bring_in: impl FnMut(&mut Self, Item) -> bool,
    ) {
        missing.retain(|&id| {
            let item = match kind {
                Kind::Segments => {
                    let [a, b] = self.must.segments[id as usize].ends;
                    Item::Segment(a, b)
                }
                Kind::Facets => Item::Facet(self.must.facets[id as usize].corners),
            };
            let points = self.mesh.points.len();
            let done = bring_in(self, item);
            let cause = if kind == Kind::Segments { Cause::Segment } else { Cause::Facet };
            commit(self, cause, points, probe);
            if done && probe.on() {
                let ends;
                let corners = match kind {
                    Kind::Segments => {
                        ends = self.must.segments[id as usize].ends;
                        &ends[..]
                    }
                    Kind::Facets => &self.must.facets[id as usize].corners[..],
                };
                probe.emit(TetrahedraEvent::Recovered { corners, points: &self.mesh.points });
            }
            match kind {
                Kind::Segments => self.must.segments[id as usize].held = done,
                Kind::Facets => self.must.facets[id as usize].held = done,
            }
            !done
        });
    }
}

/// Forgets what could be undone, after telling the probe of it, and of the points since there were
/// `points` of them.
pub(crate) fn commit(
    work: &mut Work,
    cause: Cause,
    points: usize,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) {
    if probe.on() {
        for vertex in points..work.mesh.points.len() {
            let point = work.mesh.points[vertex];
            probe.emit(TetrahedraEvent::SteinerPlaced { vertex: vertex as u32, point, cause });
        }
        for exchange in &work.log {
            let removed: Vec<[u32; 4]> = exchange.old.iter().map(|(_, tet)| tet.v).collect();
            let made: Vec<[u32; 4]> = exchange.new.iter().map(|&(_, v)| v).collect();
            probe.emit(TetrahedraEvent::Exchanged {
                cause,
                removed: &removed,
                made: &made,
                points: &work.mesh.points,
            });
        }
    }
    work.log.clear();
}
