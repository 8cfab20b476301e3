//! What is asked of the map: clearance, membership, frontier in sight.

use solid::{Label, Point3, Side, Vector3};

use super::surface::Surface;
use crate::{FlightClearance, FrontierPatch, Known};

/// Distances are told up to this, metres.
pub(super) const REACH_M: f64 = 2.0;

/// How far before a frontier a line of sight may end, metres: the frontier itself is in its way.
const BEFORE_M: f64 = 0.02;

/// A line of sight starts so far from the camera, metres, where many faces meet.
const START_M: f64 = 0.05;

/// How near a straight motion in the frame `map` comes to what is solid and to what was not seen.
///
/// Where surfaces overlap because one was refused by the union, the one that allows most is asked.
pub(super) fn clearance(
    surfaces: &[&Surface],
    from: &Point3,
    to: &Point3,
    leaving_m: f64,
) -> FlightClearance {
    let all = surfaces.iter().map(|surface| in_one(surface, from, to, leaving_m));
    all.max_by(|a, b| a.unseen_m.total_cmp(&b.unseen_m).then(a.solid_m.total_cmp(&b.solid_m)))
        .unwrap_or(FlightClearance::NONE)
}

fn in_one(surface: &Surface, from: &Point3, to: &Point3, leaving_m: f64) -> FlightClearance {
    let near = |a: &Point3, b: &Point3, label: Label| {
        surface.near(a, b, REACH_M, label).unwrap_or(REACH_M)
    };
    let solid_m = near(from, to, Label::Obstacle);
    let length_m = (to - from).norm();
    let is_free = |at: &Point3| surface.side(at) == Side::Inside;
    let ends_free = is_free(to);
    // Behind an obstacle face distances to faces tell nothing.
    let (unseen_m, unseen_at_end_m) = if !ends_free {
        (0.0, 0.0)
    } else if length_m <= leaving_m {
        (REACH_M, near(to, to, Label::Frontier))
    } else {
        let left = from + (to - from) * (leaving_m / length_m);
        let along_m = if is_free(&left) { near(&left, to, Label::Frontier) } else { 0.0 };
        (along_m, near(to, to, Label::Frontier))
    };
    FlightClearance {
        solid_at_start_m: near(from, from, Label::Obstacle),
        solid_m,
        solid_at_end_m: near(to, to, Label::Obstacle),
        unseen_m,
        unseen_at_end_m,
    }
}

/// What a point of the frame `map` is taken for: free inside of a surface, solid outside or on it and near to
/// an obstacle face, otherwise unknown.
pub(super) fn knows(surfaces: &[&Surface], point: &Point3, solid_m: f64) -> Known {
    if surfaces.iter().any(|surface| surface.side(point) == Side::Inside) {
        return Known::Free;
    }
    let is_solid = |surface: &&Surface| {
        surface.near(point, point, solid_m.max(1e-9), Label::Obstacle).is_some()
    };
    if surfaces.iter().any(is_solid) { Known::Solid } else { Known::Unknown }
}

/// The parts of patches that a straight line leads to, no farther than `reach_m`; all in the frame `map`.
pub(super) fn in_sight(
    surfaces: &[&Surface],
    patches: &[FrontierPatch],
    from: &Point3,
    reach_m: f64,
) -> Vec<FrontierPatch> {
    let is_seen = |at: &Point3, normal: &Vector3| {
        let by = at - normal * BEFORE_M - from;
        let length_m = by.norm();
        if length_m > reach_m {
            return false;
        }
        let start = from + by * (START_M / length_m.max(START_M));
        !surfaces.iter().any(|surface| surface.is_crossed(&start, &(from + by)))
    };
    let of = |patch: &FrontierPatch| {
        let points = patch.points.iter();
        let points: Vec<_> =
            points.filter(|p| is_seen(&p.in_body, &p.normal_in_body)).copied().collect();
        let area_m2 = points.iter().map(|point| point.area_m2).sum();
        (!points.is_empty()).then_some(FrontierPatch { points, area_m2, ..*patch })
    };
    patches.iter().filter_map(of).collect()
}
