//! Frontier that no volume covers but that leads nowhere: along walls, and where nobody can get.

use geometry::Point2;
use geometry::planar::Interval;
use geometry::planar::{box_gap, near_segment};
use pose::Se2;

use super::VolumeState;
use crate::volume::LocalVolume;

/// By how much rounding may move a point, metres: many times too much.
pub(super) const ROUNDING_M: f64 = 1e-6;

/// The stretches of open frontier of `state` within `radius_m` of what is solid in `other`.
///
/// Under drift the frontier bits that touch a wall are never quite inside another volume; without
/// this rule they would stay for ever. Not in \[ISRR19\], which leaves it open.
///
/// The disc around what is open has to be that of the ledgers. Cost: the solid parts of `other`, and
/// for those near the disc the open edges.
pub(super) fn spans_along_walls(
    state: &VolumeState,
    other: &LocalVolume,
    at_from_other: &Se2,
    radius_m: f64,
    spans: &mut Vec<(usize, Interval)>,
) {
    if radius_m <= 0.0 {
        return;
    }
    let other_from_at = at_from_other.inverse();
    // Walls far from all that is open close nothing: only the rest is held against every edge.
    let (open_at, open_m) = state.open_disc;
    let open_m = open_m + ROUNDING_M;
    let centre = other_from_at.transform(&open_at);
    let around = Box2::around(&centre, &centre, open_m + radius_m);
    if around.distance_squared_to_origin() > other.radius_m() * other.radius_m() {
        return;
    }
    let posts = other.posts.iter().map(|post| (*post, *post));
    let solid = other.obstacles.iter().map(|wall| (wall.from, wall.to)).chain(posts);
    let solid: Vec<(Point2, Point2)> = solid.filter(|(a, b)| around.meets(a, b)).collect();
    if solid.is_empty() {
        return;
    }
    for (edge, ledger) in state.ledgers.iter().enumerate() {
        if ledger.is_closed() {
            continue;
        }
        let frontier = &state.volume.frontier[edge];
        if box_gap(&frontier.from, &frontier.to, &open_at, &open_at) > open_m {
            continue;
        }
        let from = other_from_at.transform(&frontier.from);
        let to = other_from_at.transform(&frontier.to);
        let near = Box2::around(&from, &to, radius_m);
        for (a, b) in &solid {
            if near.meets(a, b)
                && let Some(span) = near_segment(&from, &to, a, b, radius_m)
            {
                spans.push((edge, span));
            }
        }
    }
}

/// The stretches of open frontier of `state` near places that were given up.
pub(super) fn spans_given_up(
    state: &VolumeState,
    given_up: &[(Point2, f64)],
    at_from_other: &Se2,
    spans: &mut Vec<(usize, Interval)>,
) {
    for (place_in_other, radius_m) in given_up {
        let place = at_from_other.transform(place_in_other);
        for (edge, frontier) in state.volume.frontier.iter().enumerate() {
            if !state.ledgers[edge].is_closed()
                && let Some(span) =
                    near_segment(&frontier.from, &frontier.to, &place, &place, *radius_m)
            {
                spans.push((edge, span));
            }
        }
    }
}

/// An axis-parallel box around a segment.
struct Box2 {
    min: Point2,
    max: Point2,
}

impl Box2 {
    fn around(a: &Point2, b: &Point2, margin_m: f64) -> Self {
        Self {
            min: Point2::new(a.x.min(b.x) - margin_m, a.y.min(b.y) - margin_m),
            max: Point2::new(a.x.max(b.x) + margin_m, a.y.max(b.y) + margin_m),
        }
    }

    fn meets(&self, a: &Point2, b: &Point2) -> bool {
        a.x.min(b.x) <= self.max.x
            && a.x.max(b.x) >= self.min.x
            && a.y.min(b.y) <= self.max.y
            && a.y.max(b.y) >= self.min.y
    }

    fn distance_squared_to_origin(&self) -> f64 {
        let x = 0.0_f64.clamp(self.min.x, self.max.x);
        let y = 0.0_f64.clamp(self.min.y, self.max.y);
        x * x + y * y
    }
}
