//! Where to look from (step 2).

use geometry::{Point3, Vector3};
use maps3d::Hovering;
use pose::Se3;
use probe::VertexId;

use super::aim::BORDER_PX;
use super::memory::Target;
use super::nearby::{Near, nearby};
use super::{FlightEvent, FlightExplorer, FlightProbe};

/// A flight to a place from which frontier is to be looked at.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// The vertex from which it is straight.
    pub(super) at: VertexId,
    /// The place in the frame of that vertex.
    pub(super) place: Point3,
    /// What is to be looked at, in the same frame.
    pub(super) targets: Vec<Target>,
}

/// Yaws of the fan of places around a vertex.
const YAWS: usize = 24;
/// Their elevations, degrees.
const ELEVATIONS_DEG: [f64; 9] = [0.0, -12.0, 12.0, -24.0, 24.0, -36.0, 36.0, -46.0, 46.0];
/// Their distances as shares of the longest hop.
const SHARES: [f64; 6] = [0.16, 0.33, 0.5, 0.67, 0.83, 1.0];
/// Distances before a frontier, along its normal, metres.
const BEFORE_M: [f64; 3] = [1.6, 1.0, 0.6];
/// The best places whose clearance is asked for.
const ASKED: usize = 80;
/// The same for frontier that was put off.
const LATE_ASKED: usize = 320;
/// An approach gains at least so much, metres.
const NEARER_M: f64 = 0.4;
/// The end of a line of sight may lie in what is not free for certain, metres: frontier is where that ends.
const SIGHT_SHORT_M: f64 = 0.15;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// A place that has targets in view.
    Look,
    /// A place that is nearer to targets, on the straight way to which nothing stands: what is too far off
    /// to be looked at from anywhere near.
    Approach,
}

impl FlightExplorer {
    /// The best place to look at targets from, or on the way there, flown to straight from `at`; all in the
    /// frame of `at`, which lies at `owner_from_at` for their owner.
    pub(super) fn choose_viewpoint(
        &mut self,
        aim: Aim,
        (at, owner_from_at): (VertexId, &Se3),
        targets: &[Target],
        probe: &mut dyn FlightProbe,
    ) -> Option<Plan> {
        let mut scored: Vec<(Point3, f64)> = Vec::new();
        // An approach leads to where nobody was: else it would lead there again and again.
        let known = match aim {
            Aim::Look => Vec::new(),
            Aim::Approach => nearby(&self.graph, at, 2.0 * self.params.hop_m),
        };
        let is_new = |place: &Point3| {
            let apart_m = |near: &Near| (near.root_from_vertex.translation - place.coords).norm();
            known.iter().all(|near| apart_m(near) >= NEARER_M)
        };
        for place in self.places(at, targets).into_iter().filter(is_new) {
            let score = self.score(aim, (at, owner_from_at), &place, targets);
            if score > 0.0 {
                scored.push((place, score));
            }
        }
        scored.sort_by(|a, b| b.1.total_cmp(&a.1));
        let asked = if self.later.is_late() { LATE_ASKED } else { ASKED };
        probe.emit(FlightEvent::ViewpointsScored { at, targets, scored: &scored });
        let hovering = Hovering { vertex: at, vertex_from_body: Se3::identity() };
        let radius_m = self.params.body_radius_m;
        let leaving_m = self.params.leaving_m;
        let least_m = self.params.margins_m.iter().copied().fold(f64::INFINITY, f64::min);
        if let Some(seen) = self.seen.get(at).filter(|_| least_m.is_finite()) {
            let keep_m = radius_m + least_m;
            let clear = scored.iter().filter(|(place, _)| seen.keeps_clear(place, keep_m));
            scored = clear.take(asked).copied().collect();
        }
        let clearances: Vec<_> = scored
            .iter()
            .map(|(place, _)| self.maps[0].clearance(&hovering, place, leaving_m))
            .collect();
        for margin_m in self.params.margins_m.clone() {
            let keep_m = radius_m + margin_m;
            let allowed = clearances.iter().position(|c| c.keeps(keep_m, radius_m));
            let Some(best) = allowed else { continue };
            let place = scored[best].0;
            let in_view: Vec<Target> = targets
                .iter()
                .filter(|target| self.gain(aim, (at, owner_from_at), &place, target) > 0.0)
                .copied()
                .collect();
            let area_m2 = in_view.iter().map(|target| target.area_m2).sum();
            probe.emit(FlightEvent::ViewpointChosen {
                at,
                place_in_vertex: place,
                area_m2,
                margin_m,
            });
            return Some(Plan { at, place, targets: in_view });
        }
        None
    }

    /// Places that may be flown to: a fan around the vertex, and points before the targets.
    fn places(&self, at: VertexId, targets: &[Target]) -> Vec<Point3> {
        let Some(seen) = self.seen.get(at) else { return Vec::new() };
        let radius_m = self.params.body_radius_m;
        let mut places = Vec::new();
        let mut keep = |place: Point3| {
            let distance_m = place.coords.norm();
            if distance_m < 0.25 || distance_m > self.params.hop_m {
                return;
            }
            if seen.is_free(&(place * (1.0 + radius_m / distance_m)), 0.0) {
                places.push(place);
            }
        };
        for elevation_deg in ELEVATIONS_DEG {
            for yaw in 0..YAWS {
                let yaw_rad = std::f64::consts::TAU * yaw as f64 / YAWS as f64;
                let (sin, cos) = elevation_deg.to_radians().sin_cos();
                let direction = Vector3::new(cos * yaw_rad.cos(), cos * yaw_rad.sin(), sin);
                for share in SHARES {
                    keep(Point3::from(direction * (share * self.params.hop_m)));
                }
            }
        }
        for target in targets.iter().take(24) {
            for before_m in BEFORE_M {
                keep(target.at - target.normal * before_m);
            }
        }
        places
    }

    /// How much a place is worth: the area in view, and less the farther it is.
    fn score(&self, aim: Aim, from: (VertexId, &Se3), place: &Point3, targets: &[Target]) -> f64 {
        let gain_m2: f64 = targets.iter().map(|target| self.gain(aim, from, place, target)).sum();
        gain_m2 / (1.0 + place.coords.norm())
    }

    /// The area of a target that a look from a place is worth: 0 where it cannot be seen from there, or was
    /// looked at from there; less where it is seen along its surface. To approach it is worth its area times
    /// the share of the way.
    fn gain(
        &self,
        aim: Aim,
        (at, owner_from_at): (VertexId, &Se3),
        place: &Point3,
        target: &Target,
    ) -> f64 {
        let Some(lens) = self.lens else { return 0.0 };
        let by = target.at - place;
        let distance_m = by.norm();
        if distance_m < 0.2 {
            return 0.0;
        }
        let share = match aim {
            Aim::Look => {
                let across = by.dot(&target.normal) / distance_m;
                let limit_m = self.params.view_share * lens.far_m;
                let depth_m = lens.depth_of(&by, BORDER_PX);
                let is_in_view = across > 0.08 && depth_m.is_some_and(|depth_m| depth_m <= limit_m);
                if is_in_view { (2.0 * across).min(1.0) } else { 0.0 }
            }
            Aim::Approach => {
                let nearer_m = target.at.coords.norm() - distance_m;
                if nearer_m >= NEARER_M { nearer_m / (nearer_m + distance_m) } else { 0.0 }
            }
        };
        if share <= 0.0 {
            return 0.0;
        }
        let same_m = self.params.same_place_m;
        let from_in_owner = owner_from_at.transform(place);
        let is_free = || {
            self.seen.get(at).is_some_and(|seen| seen.is_way_free(place, &target.at, SIGHT_SHORT_M))
        };
        if self.tries.was_tried(target, &from_in_owner, same_m) || !is_free() {
            return 0.0;
        }
        target.area_m2 * share
    }
}
