//! Step 7: ways to the nearest frontier through the tetrahedra.

use solid::Point3;

use super::ask::clearance;
use super::places::is_in;
use super::surface::Surface;
use super::volumes::Volumes;
use crate::events::Relay;
use crate::plan::polyline_m;
use crate::{FlightClearance, Maps3dError, Plan, Target};

/// What was not seen does not count so near to where a way starts, metres: the robot is there.
const LEAVING_M: f64 = 1.0;

/// A way is cut at multiples of this, metres.
const STEP_M: f64 = 0.1;

/// A start so near to the map counts as in it, metres.
const NEAR_M: f64 = 0.1;

/// A shorter way than this leads to nothing new, metres.
const LEAST_M: f64 = 0.3;

/// A leg that is shorter than this joins the next, metres.
const LEAST_LEG_M: f64 = 0.01;

/// Goals that are tried before less is asked.
const GOALS: usize = 6;

/// Goals nearer than this to one that no way leads to are left out with it, metres.
const SAME_M: f64 = 0.75;

/// Where the robot is too near to an obstacle already, a way may keep less, but this share of the clearance.
const LEAST_SHARE: f64 = 0.4;

/// What a way must keep: the share of the clearance from obstacles, and from what was not seen.
const ASKED: [[f64; 2]; 3] = [[1.0, 0.7], [1.0, 0.0], [0.6, 0.0]];

/// What counts as a goal, and how a way ends.
pub(super) struct Wanted<'a> {
    pub surfaces: &'a [&'a Surface],
    /// Frontier faces of the united map that count, ascending.
    pub faces: &'a [u32],
    /// Balls in which frontier was given up.
    pub given_up: &'a [(Point3, f64)],
    pub clearance_m: f64,
    pub stop_short_m: f64,
}

/// The plan to the nearest frontier that counts, and the part of its path that keeps clear; `None` where no
/// way is found to any. Everything is in the frame `map`. The probe hears of every search.
pub(super) fn to_frontier(
    volumes: &mut Volumes,
    from: &Point3,
    wanted: &Wanted<'_>,
    probe: &mut Relay<'_>,
) -> Option<(Plan, Vec<Point3>)> {
    // Round the robot's own place, the tip of its view included, it sees nothing by going there: the last choice.
    let apart_m = LEAST_M.max(wanted.clearance_m);
    [apart_m, 0.0].into_iter().find_map(|apart_m| to_goal(volumes, from, apart_m, wanted, probe))
}

/// The same to frontier that is farther than this from where it starts.
fn to_goal(
    volumes: &mut Volumes,
    from: &Point3,
    apart_m: f64,
    wanted: &Wanted<'_>,
    probe: &mut Relay<'_>,
) -> Option<(Plan, Vec<Point3>)> {
    let united = volumes.united;
    for [solid, unseen] in ASKED {
        let mut radius_m = wanted.clearance_m * solid;
        let unseen_m = wanted.clearance_m * unseen;
        let mut blocked: Vec<(Point3, f64)> = Vec::new();
        while blocked.len() < GOALS {
            let Ok(planner) = volumes.planner(radius_m, probe) else { return None };
            planner.set_goals(|space, node| {
                let face = space.frontier()[node.face as usize];
                let counts =
                    !united || face.volume > 0 || wanted.faces.binary_search(&face.face).is_ok();
                counts
                    && (node.at - from).norm() >= apart_m
                    && !is_in(wanted.given_up, &node.at)
                    && !is_in(&blocked, &node.at)
            });
            let start = planner.space().entry(from, NEAR_M)?;
            let is_outside = (start - from).norm() > NEAR_M;
            let plan = match planner.plan_with(&start, &Target::Frontier, probe) {
                Ok(Some(plan)) => plan,
                // Nearer to something than it should be: the robot leaves as it came.
                Err(Maps3dError::TooNear { distance_m, .. })
                    if (LEAST_SHARE * wanted.clearance_m..radius_m)
                        .contains(&(0.9 * distance_m)) =>
                {
                    radius_m = 0.9 * distance_m;
                    continue;
                }
                _ => break,
            };
            let points = plan.points();
            let Some(goal) = points.last().copied() else { break };
            let keeps = |c: &FlightClearance| c.keeps(0.99 * radius_m, unseen_m);
            let given = cut(wanted.surfaces, &points, wanted.stop_short_m, keeps);
            let given = straightened(wanted.surfaces, given, keeps);
            if plan.clear && polyline_m(&given) >= LEAST_M.min(0.5 * plan.path_m) {
                let skipped = usize::from(!is_outside);
                return Some((plan, given[skipped..].to_vec()));
            }
            blocked.push((goal, SAME_M));
        }
    }
    None
}

/// The same path with its first leg as long as it may be: whoever flies it leg by leg asks for a new one after
/// each, and the first may be no longer than rounding where the path passes close by an edge.
fn straightened(
    surfaces: &[&Surface],
    mut points: Vec<Point3>,
    keeps: impl Fn(&FlightClearance) -> bool,
) -> Vec<Point3> {
    let is_straight = |to: &usize| keeps(&clearance(surfaces, &points[0], &points[*to], LEAVING_M));
    if let Some(first) = (2..points.len()).rev().find(is_straight) {
        points.drain(1..first);
    }
    while points.len() > 2 && (points[1] - points[0]).norm() < LEAST_LEG_M {
        points.remove(1);
    }
    points
}

/// The start of a path, as far as it keeps clear and no nearer to its end than `short_m`, or half of its
/// length where that is less.
fn cut(
    surfaces: &[&Surface],
    points: &[Point3],
    short_m: f64,
    keeps: impl Fn(&FlightClearance) -> bool,
) -> Vec<Point3> {
    let whole_m = polyline_m(points);
    let mut left_m = whole_m - short_m.min(0.5 * whole_m);
    let mut gone_m = 0.0;
    let mut kept = vec![points[0]];
    for pair in points.windows(2) {
        let (leg, leg_m) = (pair[1] - pair[0], (pair[1] - pair[0]).norm());
        if leg_m == 0.0 {
            continue;
        }
        let end_m = leg_m.min(left_m);
        let leaving_m = (LEAVING_M - gone_m).max(0.0);
        let at = |along_m: f64| pair[0] + leg * (along_m / leg_m);
        let is_clear = |a_m: f64, b_m: f64| {
            let leaving_m = (leaving_m - a_m).max(0.0);
            keeps(&clearance(surfaces, &at(a_m), &at(b_m), leaving_m))
        };
        let mut clear_m = 0.0;
        if is_clear(0.0, end_m) {
            clear_m = end_m;
        } else {
            while clear_m < end_m && is_clear(clear_m, end_m.min(clear_m + STEP_M)) {
                clear_m = end_m.min(clear_m + STEP_M);
            }
        }
        if clear_m > 0.0 {
            kept.push(at(clear_m));
        }
        (gone_m, left_m) = (gone_m + clear_m, left_m - clear_m);
        if clear_m < leg_m || left_m <= 0.0 {
            break;
        }
    }
    kept
}
