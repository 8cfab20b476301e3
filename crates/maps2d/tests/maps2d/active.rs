//! The active area: what it merges, what it leaves, and that it always ends.

use geometry::Point2;
use maps2d::active::{ActiveArea, ActiveAreaParams, Corner, Twisted};
use maps2d::polygons::{CorrectedPolygons, CorrectedPolygonsParams, OpenParams};
use maps2d::{Candidate, ExplorationMap, Frontier};
use pose::Se2;
use probe::Off;
use proptest::prelude::*;

use super::config;
use super::drive::{Done, Drive, Mix, stories};
use super::room::{Room, Sensor};
use super::told::Told;

const MIX: Mix = Mix { turns: 3, links: 1, withdrawals: 1 };

fn area_m2(rings: &[Vec<Corner>]) -> f64 {
    let twice: f64 = rings
        .iter()
        .flat_map(|ring| {
            let next = ring.iter().skip(1).chain(ring.first());
            ring.iter().zip(next).map(|(a, b)| a.at.coords.perp(&b.at.coords))
        })
        .sum();
    0.5 * twice
}

fn params() -> impl Strategy<Value = ActiveAreaParams> {
    let edges = prop_oneof![Just(0_usize), Just(1), Just(3), Just(1000)];
    let twisted = prop_oneof![Just(Twisted::Flip), Just(Twisted::Remove)];
    (edges, any::<bool>(), twisted).prop_map(|(area_edges, keep_intersections, twisted)| {
        ActiveAreaParams { area_edges, keep_intersections, twisted, ..ActiveAreaParams::default() }
    })
}

proptest! {
    #![proptest_config(config(64, "proptest-regressions/active.txt"))]

    /// Whatever happens, with whatever size of the area: it ends, it says when it is broken, and
    /// whoever listens changes nothing.
    #[test]
    fn it_ends_and_says_what_is_wrong(story in stories(MIX, 1..20), params in params()) {
        let mut quiet = ActiveArea::new(params);
        let mut heard = ActiveArea::new(params);
        let mut told: Vec<Told> = Vec::new();
        let mut one = Drive::new(&story.room, &story.sensor);
        let mut other = Drive::new(&story.room, &story.sensor);
        let (mut here, mut there): (Vec<Candidate>, Vec<Candidate>) = Default::default();
        for op in &story.ops {
            if one.act(op, &mut [&mut quiet]) == Done::Nothing {
                continue;
            }
            other.act_with(op, &mut [&mut heard], &mut told);
            prop_assert_eq!(quiet.rings(), heard.rings());
            quiet.in_view(&one.standing, &mut here);
            heard.in_view(&one.standing, &mut there);
            prop_assert_eq!(&here, &there);
            prop_assert_eq!(quiet.route(&one.standing, 0.3), heard.route(&one.standing, 0.3));
            prop_assert_eq!(quiet.frontier(), heard.frontier());
            prop_assert!(quiet.rings().iter().all(|ring| ring.len() >= 3));
            let finite = quiet.rings().iter().flatten().all(|corner| corner.at.x.is_finite());
            prop_assert!(finite);
        }
        let said = told.iter().filter(|event| event.variant == "Invalid").count();
        prop_assert_eq!(quiet.invalid(), said as u64);
    }
}

/// A round trip around a pillar, 0.7 m from view to view.
fn round_trip() -> (Room, Sensor, Vec<Se2>) {
    let room = Room { width_m: 12.3, height_m: 9.1, pillars: vec![[4.1, 3.2, 4.3, 2.9]] };
    let sensor = Sensor { fov_rad: 2.0, rays: 24, range_m: 4.0 };
    let corners = [(2.03, 1.57), (10.21, 1.61), (10.17, 7.63), (2.11, 7.57), (2.07, 1.7)];
    let mut poses = Vec::new();
    for pair in corners.windows(2) {
        let (dx, dy): (f64, f64) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let steps = (dx.hypot(dy) / 0.7).ceil();
        for k in 0..steps as usize {
            let share = k as f64 / steps;
            poses.push(Se2::new(pair[0].0 + share * dx, pair[0].1 + share * dy, dy.atan2(dx)));
        }
    }
    (room, sensor, poses)
}

/// With everything active and no noise, the global polygon is the union of the views, but for the
/// margin; the pillar is an inner ring.
#[test]
fn with_all_active_it_is_the_union() {
    let (room, sensor, poses) = round_trip();
    let params = ActiveAreaParams { area_edges: 1000, ..ActiveAreaParams::default() };
    let mut active = ActiveArea::new(params);
    let mut united = CorrectedPolygons::new(CorrectedPolygonsParams::default());
    let mut drive = Drive::new(&room, &sensor);
    for pose in &poses {
        drive.go(pose, &[], &mut [&mut active, &mut united], &mut Off);
    }
    assert_eq!(active.invalid(), 0);
    let (area, expected) = (area_m2(active.rings()), united.region().area_m2());
    assert!(area > 0.93 * expected && area < 1.01 * expected, "{area} m2 for {expected} m2");
}

/// Walls settle the frontier along them, though the union swallows them: what is left open is what the
/// union of all views has left, whose walls are all there.
#[test]
fn frontier_along_walls_is_settled() {
    let (room, sensor, poses) = round_trip();
    let params = ActiveAreaParams { area_edges: 1000, ..ActiveAreaParams::default() };
    let without = OpenParams { wall_closing_m: 0.0, ..params.open };
    let mut active = ActiveArea::new(params);
    let mut blind = ActiveArea::new(ActiveAreaParams { open: without, ..params });
    let mut united = CorrectedPolygons::new(CorrectedPolygonsParams::default());
    let mut drive = Drive::new(&room, &sensor);
    for pose in &poses {
        drive.go(pose, &[], &mut [&mut active, &mut blind, &mut united], &mut Off);
    }
    let [settled, open, expected] = [active.frontier(), blind.frontier(), united.frontier()];
    assert!((settled.open_m - expected.open_m).abs() < 1.0, "{settled:?}, {expected:?}");
    assert!(open.open_m > settled.open_m + 1.0, "{open:?}, {settled:?}");
    let all = |left: Frontier| left.open_m + left.ignored_m;
    assert!((all(open) - all(settled)).abs() < 0.05 * all(open), "settled, not lost: {settled:?}");
}

/// With a small area the end of the round trip lies on top of its beginning, as a sheet of its own.
#[test]
fn outside_the_area_sheets_stay_apart() {
    let (room, sensor, poses) = round_trip();
    let params = ActiveAreaParams { area_edges: 5, ..ActiveAreaParams::default() };
    let mut active = ActiveArea::new(params);
    let mut united = CorrectedPolygons::new(CorrectedPolygonsParams::default());
    let mut drive = Drive::new(&room, &sensor);
    for pose in &poses {
        drive.go(pose, &[], &mut [&mut active, &mut united], &mut Off);
    }
    // What lies twice is counted twice.
    let (area, once) = (area_m2(active.rings()), united.region().area_m2());
    assert!(area > once + 1.0, "{area} m2, {once} m2 of which are different");
}

/// Corners move with the vertex that they were seen from (eq. 2.12).
#[test]
fn corners_move_with_their_anchors() {
    let (room, sensor, poses) = round_trip();
    let mut map = ActiveArea::new(ActiveAreaParams::default());
    let mut drive = Drive::new(&room, &sensor);
    for pose in &poses[..4] {
        drive.go(pose, &[], &mut [&mut map], &mut Off);
    }
    let before = map.rings().to_vec();
    let moved: Vec<Se2> =
        map.correction().poses().iter().map(|pose| Se2::new(5.0, -3.0, 0.4) * *pose).collect();
    map.poses_reestimated(&moved, &mut Off);
    for (old, new) in before.iter().flatten().zip(map.rings().iter().flatten()) {
        let expected: Point2 = Se2::new(5.0, -3.0, 0.4).transform(&old.at);
        assert!((expected - new.at).norm() < 1e-9);
    }
}
