//! Frontier that no volume covers but that leads nowhere: along walls, and where nobody can get.

use geometry::Point2;
use geometry::planar::Interval;
use geometry::planar::{box_gap, near_segment};
use pose::Se2;

use super::VolumeState;
use super::params::{Certainty, RelativeParams};
use crate::volume::LocalVolume;

/// By how much rounding may move a point, metres: many times too much.
pub(super) const ROUNDING_M: f64 = 1e-6;

/// Walls close frontier only where it may be off by no more than so many times the width within which
/// they do, at the named number of standard deviations.
///
/// Beyond, the mouth of a corridor may lie along a wall by chance: of twelve mazes with corridors of
/// 1 m one ended with a ninth unseen. To ask for half of it makes robots drive two to three times as
/// far, because bits along walls are then left wherever they have not been close.
const MOST_WIDTHS_OFF: f64 = 12.0;

/// How walls close frontier: within which width, and how far the frontier may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallRule {
    radius_m: f64,
    /// Standard deviations of the odometry in between, times their number.
    shift_m: f64,
    turn_rad: f64,
}

impl WallRule {
    /// Between volumes with so much noisy odometry between them, metres.
    pub fn over(odometry_m: f64, params: &RelativeParams) -> Self {
        let Certainty { sigmas, sigma_translation, sigma_rotation_rad } = params.certainty;
        let root = sigmas * odometry_m.max(0.0).sqrt();
        Self {
            radius_m: params.wall_closing_m,
            shift_m: root * sigma_translation,
            turn_rad: root * sigma_rotation_rad,
        }
    }

    /// Whether an edge so far from where the wall was seen from may be closed.
    fn is_sure_at(&self, distance_m: f64) -> bool {
        self.shift_m + self.turn_rad * distance_m <= MOST_WIDTHS_OFF * self.radius_m
    }
}

/// The stretches of open frontier of `state` near what is solid in `other`, by a rule.
///
/// Under drift the frontier bits that touch a wall are never quite inside another volume; without
/// this rule they would stay for ever. Not in \[ISRR19\], which leaves it open.
///
/// The disc around what is open has to be that of the ledgers. Cost: for each open
/// edge the solid parts of `other` that lie in its direction.
pub(super) fn spans_along_walls(
    state: &VolumeState,
    other: &LocalVolume,
    at_from_other: &Se2,
    rule: WallRule,
    spans: &mut Vec<(usize, Interval)>,
) {
    let radius_m = rule.radius_m;
    if radius_m <= 0.0 || !rule.is_sure_at(0.0) {
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
    let walls = other.obstacles.len();
    let mut solid: Vec<u32> = Vec::new();
    let margin_m = radius_m + ROUNDING_M;
    for part in &state.open {
        // A wall that is not near what is open closes nothing.
        if box_gap(&part.from, &part.to, &open_at, &open_at) > open_m {
            continue;
        }
        let (open_from, open_to) =
            (other_from_at.transform(&part.from), other_from_at.transform(&part.to));
        other.rim.solid_near(&open_from, &open_to, margin_m, &mut solid);
        if solid.is_empty() || state.ledgers[part.edge].is_closed() {
            continue;
        }
        let frontier = &state.volume.frontier[part.edge];
        let from = other_from_at.transform(&frontier.from);
        let to = other_from_at.transform(&frontier.to);
        if !rule.is_sure_at(0.5 * (from.coords + to.coords).norm()) {
            continue;
        }
        let near = Box2::around(&open_from, &open_to, margin_m);
        for &number in &solid {
            let number = number as usize;
            let (a, b) = match other.obstacles.get(number) {
                Some(wall) => (wall.from, wall.to),
                None => (other.posts[number - walls], other.posts[number - walls]),
            };
            if near.meets(&a, &b)
                && let Some(span) = near_segment(&from, &to, &a, &b, radius_m)
            {
                spans.push((part.edge, span));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(sigmas: f64, odometry_m: f64) -> WallRule {
        let certainty =
            Certainty { sigmas, sigma_translation: 0.1, sigma_rotation_rad: 5.0_f64.to_radians() };
        let params = RelativeParams { certainty, wall_closing_m: 0.1, ..RelativeParams::default() };
        WallRule::over(odometry_m, &params)
    }

    #[test]
    fn as_in_the_paper_walls_close_over_any_way() {
        assert!(rule(0.0, 1e6).is_sure_at(1e6));
    }

    #[test]
    fn over_a_recognised_place_walls_close_at_any_distance() {
        assert!(rule(2.0, 0.0).is_sure_at(1e6));
    }

    #[test]
    fn after_much_drift_walls_close_only_what_is_near() {
        // Over 1 m of odometry what is d metres away may be off by 2 * (0.1 + 0.0873 d) m.
        assert!(rule(2.0, 1.0).is_sure_at(5.5) && !rule(2.0, 1.0).is_sure_at(6.0));
        assert!(rule(2.0, 4.0).is_sure_at(2.0) && !rule(2.0, 4.0).is_sure_at(2.5));
        assert!(!rule(2.0, 49.0).is_sure_at(0.0));
    }
}
