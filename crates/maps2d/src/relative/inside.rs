//! Frontier that lies inside another volume, as placed and as it may be misplaced (\[ISRR19\] 4.3).

use geometry::planar::{Interval, box_gap};
use pose::Se2;

use super::walls::ROUNDING_M;
use super::{Certainty, VolumeState};
use crate::volume::LocalVolume;

/// The stretches of open frontier of `state` that lie strictly inside `other`, under each of the
/// placements.
///
/// Whole edges are clipped, not their open parts, so that a stretch does not depend on what was
/// closed before. Only edges are looked at of which an open part comes near the disc around what is
/// open, and near the other volume. Returns whether none comes as near to it as walls close frontier,
/// metres, under the first placement.
pub(super) fn spans_inside(
    state: &VolumeState,
    other: &LocalVolume,
    placements: &[Se2],
    wall_m: f64,
    clipped: &mut Vec<Interval>,
    spans: &mut Vec<(usize, Interval)>,
) -> bool {
    let (centre, open_m) = state.open_disc;
    let open_m = open_m + ROUNDING_M;
    let wall_m = wall_m + ROUNDING_M;
    let reach_m = open_m + other.radius_m() + wall_m;
    if placements[0].transform(&centre).coords.norm_squared() > reach_m * reach_m {
        return true;
    }
    let mut far = true;
    let mut common: Vec<Interval> = Vec::new();
    for parts in state.open.chunk_by(|one, next| one.edge == next.edge) {
        let edge = parts[0].edge;
        // What is closed may lie inside: that changes nothing.
        let mut near = false;
        for part in parts {
            if box_gap(&part.from, &part.to, &centre, &centre) > open_m {
                continue;
            }
            let from = placements[0].transform(&part.from);
            let to = placements[0].transform(&part.to);
            if !other.rim.is_clear_of(&from, &to, wall_m) {
                far = false;
                near = near || !other.rim.is_clear_of(&from, &to, ROUNDING_M);
            }
        }
        if !near || state.ledgers[edge].is_closed() {
            continue;
        }
        let frontier = &state.volume.frontier[edge];
        for (i, other_from_at) in placements.iter().enumerate() {
            clipped.clear();
            other.inner.clip(
                &other_from_at.transform(&frontier.from),
                &other_from_at.transform(&frontier.to),
                clipped,
            );
            if i == 0 {
                common.clone_from(clipped);
            } else {
                common = shared(&common, clipped);
            }
            if common.is_empty() {
                break;
            }
        }
        spans.extend(common.iter().map(|&span| (edge, span)));
    }
    far
}

/// What two sorted lists of disjoint stretches have in common.
fn shared(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    a.iter().flat_map(|x| b.iter().filter_map(|y| x.overlap(y))).collect()
}

/// `other_from_at` as estimated, and as it would be were the odometry in between wrong by the named
/// number of standard deviations.
pub(super) fn placements(
    at_from_other: &Se2,
    odometry_m: f64,
    certainty: &Certainty,
    out: &mut Vec<Se2>,
) {
    let other_from_at = at_from_other.inverse();
    out.clear();
    out.push(other_from_at);
    let root = certainty.sigmas * odometry_m.max(0.0).sqrt();
    let (shift_m, turn_rad) =
        (root * certainty.sigma_translation, root * certainty.sigma_rotation_rad);
    if turn_rad > 0.0 {
        out.push(Se2::from_angle(turn_rad) * other_from_at);
        out.push(Se2::from_angle(-turn_rad) * other_from_at);
    }
    if shift_m > 0.0 {
        for (x_m, y_m) in [(shift_m, 0.0), (-shift_m, 0.0), (0.0, shift_m), (0.0, -shift_m)] {
            out.push(Se2::new(x_m, y_m, 0.0) * other_from_at);
        }
    }
}
