//! Frontier that no volume covers but that leads nowhere: along walls, and where nobody can get.

use geometry::Point2;
use geometry::planar::Interval;
use geometry::planar::near_segment;
use pose::Se2;

use super::VolumeState;
use crate::volume::LocalVolume;

/// The stretches of open frontier of `state` within `radius_m` of what is solid in `other`.
///
/// Under drift the frontier bits that touch a wall are never quite inside another volume; without
/// this rule they would stay for ever. Not in \[ISRR19\], which leaves it open.
pub(super) fn spans_along_walls(
    state: &VolumeState,
    other: &LocalVolume,
    at_from_other: &Se2,
    radius_m: f64,
    spans: &mut Vec<(usize, Interval)>,
) {
    let reach_m = state.volume.radius_m() + other.radius_m() + radius_m;
    if radius_m <= 0.0 || at_from_other.translation.norm_squared() > reach_m * reach_m {
        return;
    }
    let other_from_at = at_from_other.inverse();
    for (edge, ledger) in state.ledgers.iter().enumerate() {
        if ledger.is_closed() {
            continue;
        }
        let frontier = &state.volume.frontier[edge];
        let from = other_from_at.transform(&frontier.from);
        let to = other_from_at.transform(&frontier.to);
        let near = Box2::around(&from, &to, radius_m);
        if near.distance_squared_to_origin() > other.radius_m() * other.radius_m() {
            continue;
        }
        for wall in &other.obstacles {
            if near.meets(&wall.from, &wall.to)
                && let Some(span) = near_segment(&from, &to, &wall.from, &wall.to, radius_m)
            {
                spans.push((edge, span));
            }
        }
        for post in &other.posts {
            if near.meets(post, post)
                && let Some(span) = near_segment(&from, &to, post, post, radius_m)
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
