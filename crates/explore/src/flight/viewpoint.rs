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
/// No margin is kept.
const NO_MARGIN: u8 = 254;
/// The depth images show something in the way.
pub(super) const BLOCKED: u8 = 255;
/// A plan so near to where it begins is none to fly, metres: the robot only turns.
pub(super) const STAYS_M: f64 = 0.01;
/// Of the fan, every so manyth yaw, elevation and distance is asked for lines of sight through all that is
/// believed to be free: these cost more.
const BELIEVE_EVERY: [usize; 3] = [2, 2, 2];
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
    /// A place that has targets in view by all that is believed to be free, whoever saw it; the vertex itself
    /// as well.
    Believe,
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
            Aim::Look | Aim::Believe => Vec::new(),
            Aim::Approach => nearby(&self.graph, at, 2.0 * self.params.hop_m),
        };
        let is_new = |place: &Point3| {
            let apart_m = |near: &Near| (near.root_from_vertex.translation - place.coords).norm();
            known.iter().all(|near| apart_m(near) >= NEARER_M)
        };
        let places: Vec<Point3> =
            self.places(aim, at, targets).into_iter().filter(is_new).collect();
        let gains = self.gains(aim, (at, owner_from_at), &places, targets);
        for (place, gains_m2) in places.iter().zip(&gains) {
            let gain_m2: f64 = gains_m2.iter().sum();
            if gain_m2 > 0.0 {
                // The area in view, and less the farther it is.
                scored.push((*place, gain_m2 / (1.0 + place.coords.norm())));
            }
        }
        scored.sort_by(|a, b| b.1.total_cmp(&a.1));
        let asked = if self.later.is_late() { LATE_ASKED } else { ASKED };
        probe.emit(FlightEvent::ViewpointsScored { at, targets, scored: &scored });
        // The best of those that keep the widest margin.
        let mut best: Option<(u8, Point3)> = None;
        let mut count = 0;
        for (place, _) in &scored {
            let margin = self.margin_of(at, place);
            count += usize::from(margin != BLOCKED);
            let is_better = best.is_none_or(|(widest, _)| margin < widest);
            if margin < NO_MARGIN && is_better {
                best = Some((margin, *place));
            }
            if margin == 0 || count >= asked {
                break;
            }
        }
        let (margin, place) = best?;
        let gains_m2 = self.gains(aim, (at, owner_from_at), &[place], targets).swap_remove(0);
        let in_view: Vec<Target> = targets
            .iter()
            .zip(&gains_m2)
            .filter(|(_, gain_m2)| **gain_m2 > 0.0)
            .map(|(target, _)| *target)
            .collect();
        let area_m2 = in_view.iter().map(|target| target.area_m2).sum();
        let margin_m = self.params.margins_m.get(usize::from(margin)).copied().unwrap_or(0.0);
        probe.emit(FlightEvent::ViewpointChosen { at, place_in_vertex: place, area_m2, margin_m });
        Some(Plan { at, place, targets: in_view })
    }

    /// Whether a straight flight from a vertex keeps clear of everything, by the least margin.
    pub(super) fn may_fly(&mut self, at: VertexId, place: &Point3) -> bool {
        self.margin_of(at, place) < NO_MARGIN
    }

    /// The first of the margins that a straight flight from a vertex keeps, as its number; [`NO_MARGIN`] for
    /// none, [`BLOCKED`] where the depth images alone tell so.
    ///
    /// In maps whose frontier belongs to vertices it follows from the looks of the vertex alone, and is kept
    /// until the next one there.
    fn margin_of(&mut self, at: VertexId, place: &Point3) -> u8 {
        if place.coords.norm() < STAYS_M {
            return 0;
        }
        let key = (at, [place.x, place.y, place.z].map(f64::to_bits));
        if let Some(&known) = self.margins_known.get(&key) {
            return known;
        }
        let radius_m = self.params.body_radius_m;
        let margins_m = &self.params.margins_m;
        let least_m = margins_m.iter().copied().fold(f64::INFINITY, f64::min);
        let is_clear = least_m.is_finite()
            && self.seen.get(at).is_some_and(|seen| seen.keeps_clear(place, radius_m + least_m));
        let margin = if is_clear {
            let hovering = Hovering { vertex: at, vertex_from_body: Se3::identity() };
            let clearance = self.maps[0].clearance(&hovering, place, self.params.leaving_m);
            let keeps = |margin_m: &f64| clearance.keeps(radius_m + margin_m, radius_m);
            let first = margins_m.iter().take(usize::from(NO_MARGIN)).position(keeps);
            first.map_or(NO_MARGIN, |first| first as u8)
        } else {
            BLOCKED
        };
        if self.maps[0].is_by_vertex() {
            self.margins_known.insert(key, margin);
        }
        margin
    }

    /// Places that may be flown to: a fan around the vertex, and points before the targets.
    fn places(&self, aim: Aim, at: VertexId, targets: &[Target]) -> Vec<Point3> {
        let Some(seen) = self.seen.get(at) else { return Vec::new() };
        let radius_m = self.params.body_radius_m;
        let (mut places, every) = match aim {
            Aim::Look | Aim::Approach => (Vec::new(), [1; 3]),
            Aim::Believe => (vec![Point3::origin()], BELIEVE_EVERY),
        };
        let mut keep = |place: Point3| {
            let distance_m = place.coords.norm();
            if distance_m < 0.25 || distance_m > self.params.hop_m {
                return;
            }
            if seen.is_free(&(place * (1.0 + radius_m / distance_m)), 0.0) {
                places.push(place);
            }
        };
        for elevation_deg in ELEVATIONS_DEG.into_iter().step_by(every[1]) {
            for yaw in (0..YAWS).step_by(every[0]) {
                let yaw_rad = std::f64::consts::TAU * yaw as f64 / YAWS as f64;
                let (sin, cos) = elevation_deg.to_radians().sin_cos();
                let direction = Vector3::new(cos * yaw_rad.cos(), cos * yaw_rad.sin(), sin);
                for share in SHARES.into_iter().skip(every[2] - 1).step_by(every[2]) {
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

    /// What looks from places are worth, for each place by target.
    fn gains(
        &mut self,
        aim: Aim,
        from: (VertexId, &Se3),
        places: &[Point3],
        targets: &[Target],
    ) -> Vec<Vec<f64>> {
        let mut gains: Vec<Vec<f64>> = places
            .iter()
            .map(|place| targets.iter().map(|t| self.gain(aim, from, place, t)).collect())
            .collect();
        if aim == Aim::Believe {
            // Lines of sight through what others saw are asked for all at once.
            let pairs: Vec<(usize, usize)> = (0..places.len())
                .flat_map(|at| (0..targets.len()).map(move |of| (at, of)))
                .filter(|&(at, of)| gains[at][of] > 0.0)
                .collect();
            let lines: Vec<[Point3; 2]> =
                pairs.iter().map(|&(at, of)| [places[at], targets[of].at]).collect();
            let hovering = Hovering { vertex: from.0, vertex_from_body: Se3::identity() };
            let are_free = self.maps[0].free_lines(&hovering, &lines, SIGHT_SHORT_M);
            for (&(at, of), is_free) in pairs.iter().zip(are_free) {
                if !is_free {
                    gains[at][of] = 0.0;
                }
            }
        }
        gains
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
            Aim::Look | Aim::Believe => {
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
            self.seen.get(at).is_some_and(|seen| match aim {
                Aim::Look | Aim::Approach => seen.is_way_free(place, &target.at, SIGHT_SHORT_M),
                // The line itself is looked at by who asked.
                Aim::Believe if place.coords.norm() < STAYS_M => {
                    !seen.has_in_view(&target.at, BORDER_PX)
                }
                Aim::Believe => true,
            })
        };
        if self.tries.was_tried(target, &from_in_owner, same_m) || !is_free() {
            return 0.0;
        }
        target.area_m2 * share
    }
}
