//! Frontier that runs along walls which other views of the area saw.
//!
//! Where a view grazes a wall, its rays end far from each other, and between them it has frontier on
//! the wall itself. Another view that saw the wall there is pulled in by the same margin, so either may
//! be swallowed by the other in the union: the frontier would stay, and the wall that settles it be
//! gone. So this is settled between views, before they are united.

use geometry::Point2;
use geometry::planar::overlay::EdgeLabel;
use geometry::planar::{EdgeLedger, Interval, box_gap, near_segment};
use pose::Se2;
use probe::VertexId;

use super::Corner;
use super::rings::next;
use crate::volume::LocalVolume;

/// Something solid, in the map's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wall {
    pub seen_from: VertexId,
    pub from: Point2,
    pub to: Point2,
}

/// What a view saw that is solid and comes within a radius of the box between two corners.
pub(super) fn walls_near(
    vertex: VertexId,
    volume: &LocalVolume,
    map_from_vertex: &Se2,
    (low, high): (Point2, Point2),
    radius_m: f64,
    out: &mut Vec<Wall>,
) {
    let place = |point: &Point2| map_from_vertex.transform(point);
    let walls = volume.obstacles.iter().map(|edge| Wall {
        seen_from: vertex,
        from: place(&edge.from),
        to: place(&edge.to),
    });
    out.extend(walls.filter(|wall| box_gap(&wall.from, &wall.to, &low, &high) < radius_m));
}

/// Pieces shorter than this are not cut off, metres.
const LEAST_PIECE_M: f64 = 1e-3;

/// Marks as free what of a ring's frontier lies within a radius of a wall that another view saw.
///
/// Cost: the frontier edges that `takes` holds for, times the walls.
pub(super) fn settle_along(
    ring: &mut Vec<Corner>,
    takes: impl Fn(&Corner) -> bool,
    walls: &[Wall],
    radius_m: f64,
) {
    settle(
        ring,
        |corner, _| takes(corner),
        |from, to, spans| {
            let near = |wall: &&Wall| {
                wall.seen_from != from.edge.data.vertex
                    && box_gap(&from.at, &to.at, &wall.from, &wall.to) < radius_m
            };
            spans.extend(
                walls.iter().filter(near).filter_map(|wall| {
                    near_segment(&from.at, &to.at, &wall.from, &wall.to, radius_m)
                }),
            );
        },
    );
}

/// Marks stretches of a ring's frontier as free: `spans` of an edge, by its ends; edges are cut where
/// that starts and ends.
pub(super) fn settle(
    ring: &mut Vec<Corner>,
    takes: impl Fn(&Corner, &Corner) -> bool,
    spans: impl Fn(&Corner, &Corner, &mut Vec<Interval>),
) {
    let mut ledger: EdgeLedger<()> = EdgeLedger::new();
    let mut newly = Vec::new();
    let mut found = Vec::new();
    let mut cuts: Vec<(usize, Vec<Corner>)> = Vec::new();
    for (index, corner) in ring.iter().enumerate() {
        let end = ring[next(ring, index)];
        if corner.edge.label != EdgeLabel::Frontier || !takes(corner, &end) {
            continue;
        }
        found.clear();
        spans(corner, &end, &mut found);
        found.iter().for_each(|span| ledger.close(*span, &(), &mut newly));
        if !ledger.is_open() {
            cuts.push((index, pieces(corner, &end, &ledger)));
            ledger = EdgeLedger::new();
        }
    }
    // From the end, so that what comes before stays where it is.
    for (index, pieces) in cuts.into_iter().rev() {
        ring.splice(index..=index, pieces);
    }
}

/// An edge cut into what is closed, which is free now, and what is open.
fn pieces(corner: &Corner, end: &Corner, ledger: &EdgeLedger<()>) -> Vec<Corner> {
    let along = end.at - corner.at;
    let least = LEAST_PIECE_M / along.norm().max(LEAST_PIECE_M);
    let mut starts: Vec<(f64, EdgeLabel)> = vec![(0.0, EdgeLabel::Frontier)];
    for closed in ledger.closed().iter().filter(|closed| closed.span.share() >= least) {
        // What is left between two closed stretches may be too short to be told.
        match starts.last_mut() {
            Some(open) if closed.span.from - open.0 < least => open.1 = EdgeLabel::Free,
            _ => starts.push((closed.span.from, EdgeLabel::Free)),
        }
        if 1.0 - closed.span.to >= least {
            starts.push((closed.span.to, EdgeLabel::Frontier));
        }
    }
    starts.dedup_by_key(|start| start.1);
    let piece = |&(share, label): &(f64, EdgeLabel)| {
        let mut piece = if share <= 0.0 {
            *corner
        } else {
            // Cut points move with the end that is nearer.
            let anchor = if share < 0.5 { corner.anchor } else { end.anchor };
            Corner { at: corner.at + along * share, anchor, ..*corner }
        };
        piece.edge.label = label;
        piece
    };
    starts.iter().map(piece).collect()
}
