//! Place recognition against its definition, worked out the slow way.

use std::sync::Arc;

use geometry::Point2;
use pose::Se2;
use probe::{Id, VertexId};
use proptest::prelude::*;
use sensing::{PlaceMatch, Robot};
use worlds::{CellMap, OdometryParams, PlaceParams, RobotParams, SimRobot, World2d, paper};

/// The robot's graph as a list of ways, and its shortest distances by relaxing every way.
#[derive(Default)]
struct Ways(Vec<(usize, usize, f64)>);

impl Ways {
    fn distances_m(&self, from: usize, count: usize) -> Vec<f64> {
        let mut distance_m = vec![f64::INFINITY; count];
        distance_m[from] = 0.0;
        loop {
            let before = distance_m.clone();
            for &(a, b, length_m) in &self.0 {
                distance_m[b] = distance_m[b].min(distance_m[a] + length_m);
                distance_m[a] = distance_m[a].min(distance_m[b] + length_m);
            }
            if distance_m == before {
                return distance_m;
            }
        }
    }
}

/// Places that the definition allows: near in truth, in sight, far along the graph.
fn allowed(robot: &SimRobot, ways: &Ways, here: usize, count: usize) -> Vec<usize> {
    let places = &robot.params().places;
    let position = |v: usize| {
        Point2::from(
            robot
                .world_from_vertex(VertexId::from_index(v))
                .expect("every vertex was marked")
                .translation,
        )
    };
    let graph_m = ways.distances_m(here, count);
    (0..count)
        .filter(|&v| v != here)
        .filter(|&v| (position(v) - position(here)).norm() < places.radius_m)
        .filter(|&v| graph_m[v] >= places.exclude_factor * places.radius_m)
        .filter(|&v| !robot.world().caster().blocked(&position(here), &position(v)))
        .collect()
}

/// A walk that turns away from walls, marks most of its poses and sometimes goes back one.
/// Calls `check` with the robot, the graph before the call, the vertex, and what was recognised.
fn walk(
    robot: &mut SimRobot,
    steps: &[(f64, u8)],
    mut check: impl FnMut(&SimRobot, &Ways, usize, &[PlaceMatch]),
) {
    let mut ways = Ways::default();
    let mut count = 0;
    let (mut standing_on, mut since_m) = (None, 0.0);
    for &(turn_rad, kind) in steps {
        if kind == 0 && count > 1 && standing_on.is_some_and(|here: usize| here > 0) {
            let to = standing_on.expect("checked above") - 1;
            robot.repeat(VertexId::from_index(to), 1.0);
            (standing_on, since_m) = (Some(to), 0.0);
        }
        robot.turn(turn_rad);
        since_m += robot.forward(1.0).distance_m;
        if kind == 1 {
            continue;
        }
        robot.mark(VertexId::from_index(count));
        if let Some(left) = standing_on {
            ways.0.push((left, count, since_m));
        }
        (standing_on, since_m) = (Some(count), 0.0);
        count += 1;
        let matches = robot.recognize();
        check(robot, &ways, count - 1, &matches);
        for place in &matches {
            let length_m = place.known_from_current.distance();
            ways.0.push((count - 1, place.vertex.index(), length_m));
        }
    }
}

fn robot(world: World2d, places: PlaceParams, seed: u64) -> SimRobot {
    let params = RobotParams { places, ..RobotParams::default() };
    SimRobot::new(Arc::new(world), params, seed)
}

fn steps(count: usize) -> impl Strategy<Value = Vec<(f64, u8)>> {
    prop::collection::vec((-0.8..0.8f64, 0..8u8), count)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn recognised_is_what_the_definition_allows_with_the_exact_pose(
        steps in steps(150), seed in 0..1000u64, map in 0..3usize,
        radius_m in 2.0..10.0f64, exclude_factor in 0.5..2.5f64,
    ) {
        let world = paper::by_name(paper::NAMES[map]).unwrap();
        let places = PlaceParams { radius_m, exclude_factor, ..PlaceParams::default() };
        let mut robot = robot(world, places, seed);
        let mut total = 0;
        walk(&mut robot, &steps, |robot, ways, here, matches| {
            let found: Vec<usize> = matches.iter().map(|place| place.vertex.index()).collect();
            assert_eq!(found, allowed(robot, ways, here, here + 1));
            let current = robot.world_from_vertex(VertexId::from_index(here)).unwrap();
            for place in matches {
                let known = robot.world_from_vertex(place.vertex).unwrap();
                let reached = known * place.known_from_current;
                assert!((reached.translation - current.translation).norm() < 1e-9);
                assert!(reached.inverse_mul(&current).angle().abs() < 1e-9);
            }
            total += matches.len() as u64;
            assert_eq!(robot.tally().place_edges, total);
        });
    }

    #[test]
    fn what_is_recognised_with_low_recall_is_still_allowed(
        steps in steps(120), seed in 0..1000u64,
    ) {
        let places = PlaceParams { recall: 0.5, ..PlaceParams::default() };
        let mut robot = robot(paper::open(), places, seed);
        walk(&mut robot, &steps, |robot, ways, here, matches| {
            let allowed = allowed(robot, ways, here, here + 1);
            assert!(matches.iter().all(|place| allowed.contains(&place.vertex.index())));
        });
    }

    #[test]
    fn of_too_many_places_the_nearest_are_reported(steps in steps(120), seed in 0..1000u64) {
        let places = PlaceParams { max_matches: Some(2), ..PlaceParams::default() };
        let mut robot = robot(paper::open(), places, seed);
        walk(&mut robot, &steps, |robot, ways, here, matches| {
            // By distance, not by id: a robot that a wall stopped twice makes ties.
            let gap_m = |v: usize| {
                let known = robot.world_from_vertex(VertexId::from_index(v)).unwrap();
                (known.translation - robot.world_from_body().translation).norm()
            };
            let allowed = allowed(robot, ways, here, here + 1);
            let found: Vec<usize> = matches.iter().map(|place| place.vertex.index()).collect();
            assert!(found.is_sorted() && found.iter().all(|v| allowed.contains(v)));
            assert_eq!(found.len(), allowed.len().min(2));
            let farthest_m = found.iter().map(|&v| gap_m(v)).fold(0.0, f64::max);
            let left_out = allowed.iter().filter(|v| !found.contains(v));
            assert!(left_out.into_iter().all(|&v| gap_m(v) >= farthest_m));
        });
    }
}

/// A square lap of 24 m and a little more: at its end the robot stands where it started, far along
/// its graph.
fn lap(places: PlaceParams, seed: u64) -> (SimRobot, Vec<PlaceMatch>) {
    let start = Se2::new(4.0, 4.0, 0.0);
    let world =
        World2d::from_cells("hall", CellMap::free(20, 20, 1.0), start).expect("the start is free");
    let odometry = OdometryParams { scale: 0.0, ..OdometryParams::default() };
    let params = RobotParams { places, odometry, ..RobotParams::default() };
    let mut robot = SimRobot::new(Arc::new(world), params, seed);
    let mut found = Vec::new();
    let mut id = 0;
    robot.mark(VertexId(id));
    found.extend(robot.recognize());
    for _ in 0..4 {
        for _ in 0..6 {
            robot.forward(1.0);
            id += 1;
            robot.mark(VertexId(id));
            found.extend(robot.recognize());
        }
        robot.turn(std::f64::consts::FRAC_PI_2);
    }
    (robot, found)
}

#[test]
fn options_switch_recognition_off() {
    let near = PlaceParams { radius_m: 2.0, ..PlaceParams::default() };
    assert!(!lap(near.clone(), 1).1.is_empty());
    assert!(lap(PlaceParams { enabled: false, ..near.clone() }, 1).1.is_empty());
    assert!(lap(PlaceParams { recall: 0.0, ..near }, 1).1.is_empty());
}

#[test]
fn recall_is_the_share_of_places_recognised() {
    // Excluding nothing, every pair within the radius is a candidate.
    let all = PlaceParams { radius_m: 3.0, exclude_factor: 0.0, ..PlaceParams::default() };
    let candidates = lap(all.clone(), 1).1.len() as f64;
    let runs = 100;
    let found: usize =
        (0..runs).map(|seed| lap(PlaceParams { recall: 0.3, ..all.clone() }, seed).1.len()).sum();
    let share = found as f64 / (candidates * runs as f64);
    let five = 5.0 * (0.3 * 0.7 / (candidates * runs as f64)).sqrt();
    assert!((share - 0.3).abs() < five, "{share}");
}

#[test]
fn relative_poses_err_as_asked() {
    let exact = PlaceParams { radius_m: 2.0, ..PlaceParams::default() };
    let noisy = PlaceParams { sigma_translation_m: 0.2, sigma_rotation_rad: 0.1, ..exact.clone() };
    let truth = lap(exact, 0).1[0];
    let errors: Vec<Se2> = (0..2000)
        .map(|seed| lap(noisy.clone(), seed).1[0])
        .inspect(|found| assert_eq!(found.vertex, truth.vertex))
        .map(|found| truth.known_from_current.inverse_mul(&found.known_from_current))
        .collect();
    let rms = |value: fn(&Se2) -> f64| {
        (errors.iter().map(|e| value(e).powi(2)).sum::<f64>() / errors.len() as f64).sqrt()
    };
    assert!((rms(|e| e.translation.x) / 0.2 - 1.0).abs() < 0.1);
    assert!((rms(|e| e.translation.y) / 0.2 - 1.0).abs() < 0.1);
    assert!((rms(Se2::angle) / 0.1 - 1.0).abs() < 0.1);
}

#[test]
fn false_places_come_at_their_rate_and_are_false() {
    let places = PlaceParams {
        radius_m: 2.0,
        recall: 0.0,
        false_positive_rate: 0.2,
        ..PlaceParams::default()
    };
    let runs = 200;
    let mut total = 0;
    for seed in 0..runs {
        let (robot, found) = lap(places.clone(), seed);
        total += found.len();
        for place in &found {
            assert!(place.known_from_current.distance() <= 2.0);
        }
        assert_eq!(robot.tally().place_edges, found.len() as u64);
    }
    // 25 calls; the first few have no vertex far enough along the graph (3 m), and one draw in
    // eight tries may find none.
    let per_run = total as f64 / f64::from(runs as u32);
    assert!(per_run > 0.2 * 14.0 && per_run < 0.2 * 25.0, "{per_run}");
}

#[test]
fn streams_do_not_disturb_each_other() {
    let base =
        PlaceParams { radius_m: 3.0, exclude_factor: 0.0, recall: 0.5, ..PlaceParams::default() };
    let mixed = PlaceParams {
        sigma_translation_m: 0.3,
        sigma_rotation_rad: 0.1,
        false_positive_rate: 0.5,
        ..base.clone()
    };
    let true_ids = |places: &PlaceParams| -> Vec<VertexId> {
        let (robot, found) = lap(places.clone(), 9);
        let truly = |place: &&PlaceMatch| {
            // A false place is out of the radius in truth; in a hall all else is in sight.
            let known = robot.world_from_vertex(place.vertex).unwrap();
            let error = place.known_from_current;
            let body = known * error;
            (0..25).any(|v| {
                let mark = robot.world_from_vertex(VertexId(v)).unwrap();
                (mark.translation - body.translation).norm() < 1.5
                    && (mark.translation - known.translation).norm() < 3.0
            })
        };
        found.iter().filter(truly).map(|place| place.vertex).collect()
    };
    let (alone, with_others) = (true_ids(&base), true_ids(&mixed));
    assert!(alone.len() > 10);
    // The other options only add: what recall decided stays decided, in its order.
    let mut rest = with_others.iter();
    assert!(alone.iter().all(|id| rest.any(|other| other == id)), "{alone:?} {with_others:?}");
}

#[test]
fn a_false_link_leads_where_the_robot_believes_not_where_the_place_is() {
    let places = PlaceParams {
        radius_m: 2.0,
        recall: 0.0,
        false_positive_rate: 1.0,
        ..PlaceParams::default()
    };
    let (mut robot, found) = lap(places, 4);
    let wrong = *found.last().unwrap();
    let here = robot.world_from_vertex(VertexId(24)).unwrap();
    let believed = here * wrong.known_from_current.inverse();
    let told = robot.repeat(wrong.vertex, wrong.known_from_current.distance());
    let body = robot.world_from_body();
    let hall_is_free = believed.translation.iter().all(|x| (0.1..19.9).contains(x));
    assert!(hall_is_free, "the seed is chosen so that no wall is in the way");
    assert!((body.translation - believed.translation).norm() < 1e-9);
    assert!((believed * told.vertex_from_body).inverse_mul(&body).angle().abs() < 1e-9);
    let truly = robot.world_from_vertex(wrong.vertex).unwrap();
    assert!((truly.translation - body.translation).norm() > 0.5);
}
