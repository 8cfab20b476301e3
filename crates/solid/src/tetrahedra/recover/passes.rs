//! All missing segments and facets, with rising effort.

use probe::Probe;

use super::plan::{ANYHOW, DETOUR, Plan};
use super::segments::Attempt;
use crate::tetrahedra::events::{Cause, TetrahedraEvent};
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::NONE;

/// How often constraints are divided, all stuck ones once each.
const MOST_ROUNDS: usize = 60;
/// How often in a row more may be stuck than before.
const MOST_GROWTH: usize = 2;
/// A sweep is repeated where it brought in more than one of so many.
const WORTH_IT: usize = 8;
/// A far search costs most where it finds nothing: it is repeated only where it brought in more than one
/// of so few.
const WORTH_IT_FAR: usize = 3;
/// Searches from this depth on are far.
const FAR: u32 = 2;

/// How many places of a segment are tried for a detour.
const MOST_TURNS: usize = 3;

/// What a pass works on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Segments,
    Facets,
}

/// Makes all segments and facets appear: by flips, and by dividing what is stuck. Returns the facets of
/// the input that are still missing: none where all went well.
pub(crate) fn conform(
    work: &mut Work,
    plan: &Plan,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Vec<u32> {
    work.even = true;
    let (mut before, mut growth) = (usize::MAX, 0);
    for round in 0..MOST_ROUNDS {
        let stuck = pass(work, Kind::Segments, plan, round > 0, probe);
        growth = if stuck.len() > before { growth + 1 } else { 0 };
        before = stuck.len();
        let mut divided = false;
        if stuck.is_empty() {
            let stuck = pass(work, Kind::Facets, plan, round > 0, probe);
            if stuck.is_empty() {
                break;
            }
            for id in stuck {
                let points = work.mesh.points.len();
                divided |= work.split_facet(id);
                commit(work, Cause::Divide, points, probe);
            }
        }
        for id in stuck {
            let points = work.mesh.points.len();
            divided |= work.must.segments[id as usize].live && work.split_segment(id);
            commit(work, Cause::Divide, points, probe);
        }
        if !divided || growth >= MOST_GROWTH {
            break;
        }
    }
    work.even = false;
    let mut missing: Vec<u32> = work
        .missing_segments()
        .into_iter()
        .flat_map(|segment| work.must.segments[segment as usize].faces.clone())
        .collect();
    if missing.is_empty() {
        missing = work.missing_facets();
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
    plan: &Plan,
    again: bool,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Vec<u32> {
    let mut missing = match kind {
        Kind::Segments if again => work.missing_segments(),
        Kind::Segments => work.hold_present_segments(),
        Kind::Facets => work.hold_present_facets(),
    };
    plan.arrange(&mut missing);
    for &effort in plan.efforts {
        let worth_it = if effort.depth < FAR { WORTH_IT } else { WORTH_IT_FAR };
        while !missing.is_empty() {
            let before = missing.len();
            work.sweep(kind, &mut missing, probe, |work, item| match item {
                Item::Segment(a, b) => work.recover_segment(a, b, effort) == Attempt::Done,
                Item::Facet(corners) => work.recover_facet(corners, effort) == Attempt::Done,
            });
            if (before - missing.len()) * worth_it < before {
                break;
            }
        }
    }
    if kind == Kind::Segments {
        take_detours(work, &mut missing, probe);
    }
    if !missing.is_empty() {
        // Flat tetrahedra are better than a division.
        work.even = false;
        work.sweep(kind, &mut missing, probe, |work, item| match item {
            Item::Segment(a, b) => {
                work.recover_segment(a, b, ANYHOW) == Attempt::Done
                    || work.recover_by_detour(a, b, ANYHOW, 0)
            }
            Item::Facet(corners) => work.recover_facet(corners, ANYHOW) == Attempt::Done,
        });
        work.even = true;
    }
    missing
}

/// Brings stuck segments in by detours: over the point first thought of as long as that helps, then over
/// others.
fn take_detours(
    work: &mut Work,
    missing: &mut Vec<u32>,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) {
    let mut turn = 0;
    while !missing.is_empty() && turn < MOST_TURNS {
        let before = missing.len();
        work.sweep(Kind::Segments, missing, probe, |work, item| match item {
            Item::Segment(a, b) => {
                work.recover_segment(a, b, DETOUR) == Attempt::Done
                    || work.recover_by_detour(a, b, DETOUR, turn)
            }
            Item::Facet(_) => false,
        });
        if (before - missing.len()) * WORTH_IT < before {
            turn += 1;
        }
    }
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
        for vertex in points..work.mesh.points.len() {
            // Points of detours come and go in one step.
            if work.mesh.at[vertex] == NONE {
                let point = work.mesh.points[vertex];
                probe.emit(TetrahedraEvent::SteinerRemoved { vertex: vertex as u32, point });
            }
        }
    }
    work.settle();
}
