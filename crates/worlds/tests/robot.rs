//! The robot in truth: noise, walls, repeated legs, the sensor.

use std::sync::Arc;

use geometry::Point2;
use pose::Se2;
use probe::VertexId;
use proptest::prelude::*;
use sensing::{Reading, Robot};
use worlds::{
    CellMap, DriveParams, OdometryParams, RobotParams, SensorParams, SimRobot, World2d, paper,
};

fn field(size: usize) -> Arc<World2d> {
    let middle = size as f64 / 2.0;
    let start = Se2::new(middle, middle, 0.0);
    Arc::new(
        World2d::from_cells("field", CellMap::free(size, size, 1.0), start)
            .expect("the middle is free"),
    )
}

fn quiet() -> RobotParams {
    let odometry = OdometryParams { scale: 0.0, ..OdometryParams::default() };
    RobotParams { odometry, ..RobotParams::default() }
}

/// The error of one motion: commanded end to true end.
fn slip(robot: &mut SimRobot, distance_m: f64) -> Se2 {
    let before = robot.world_from_body();
    let told = robot.forward(distance_m).before_from_after;
    (before * told).inverse_mul(&robot.world_from_body())
}

fn variance(samples: &[f64]) -> (f64, f64) {
    let n = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / n;
    (mean, samples.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n)
}

#[test]
fn slip_has_no_mean_and_a_variance_that_grows_with_the_distance() {
    for (scale, distance_m) in [(1.0, 1.0), (1.0, 0.25), (0.5, 1.0), (1.0, 4.0)] {
        let odometry = OdometryParams { scale, ..OdometryParams::default() };
        let params = RobotParams { odometry: odometry.clone(), ..RobotParams::default() };
        let n = 3000u64;
        let slips: Vec<Se2> = (0..n)
            .map(|seed| slip(&mut SimRobot::new(field(40), params.clone(), seed), distance_m))
            .collect();
        let sigma =
            [odometry.sigma_translation, odometry.sigma_translation, odometry.sigma_rotation_rad];
        let parts: [Vec<f64>; 3] = [
            slips.iter().map(|s| s.translation.x).collect(),
            slips.iter().map(|s| s.translation.y).collect(),
            slips.iter().map(Se2::angle).collect(),
        ];
        for (samples, sigma) in parts.iter().zip(sigma) {
            let expected = (scale * sigma).powi(2) * distance_m;
            let (mean, found) = variance(samples);
            // Five standard errors: of a variance, sqrt(2 / n) of it; of a mean, sigma / sqrt(n).
            let five = 5.0 / (n as f64).sqrt();
            assert!((found / expected - 1.0).abs() < five * 2f64.sqrt(), "{found} {expected}");
            assert!(mean.abs() < five * expected.sqrt(), "{mean}");
        }
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            let product: f64 = parts[a].iter().zip(&parts[b]).map(|(x, y)| x * y).sum();
            let scale = (variance(&parts[a]).1 * variance(&parts[b]).1).sqrt() * n as f64;
            assert!((product / scale).abs() < 5.0 / (n as f64).sqrt(), "{}", product / scale);
        }
    }
}

#[test]
fn bias_shifts_the_mean_and_scales_with_alpha() {
    let odometry = OdometryParams {
        sigma_translation: 0.0,
        sigma_rotation_rad: 0.0,
        scale: 0.5,
        bias_translation: 0.1,
        bias_rotation_rad: 0.02,
    };
    let params = RobotParams { odometry, ..RobotParams::default() };
    let off = slip(&mut SimRobot::new(field(40), params, 1), 2.0);
    assert!((off.translation.x - 0.1).abs() < 1e-12);
    assert!(off.translation.y.abs() < 1e-12);
    assert!((off.angle() - 0.02).abs() < 1e-12);
}

#[test]
fn noise_depends_on_the_seed_and_the_count_of_motions_alone() {
    let drive = |busy: bool, seed: u64| -> Vec<Se2> {
        let mut robot = SimRobot::new(field(60), RobotParams::default(), seed);
        (0..12u32)
            .map(|i| {
                if busy {
                    robot.turn(0.7);
                    robot.scan();
                    robot.mark(VertexId(i));
                    robot.recognize();
                    robot.turn(-0.7);
                    if i > 0 {
                        robot.repeat(VertexId(i - 1), 1.0);
                    }
                }
                slip(&mut robot, 1.0)
            })
            .collect()
    };
    let (calm, busy) = (drive(false, 7), drive(true, 7));
    for (a, b) in calm.iter().zip(&busy) {
        assert!((a.translation - b.translation).norm() < 1e-12);
        assert!((a.angle() - b.angle()).abs() < 1e-12);
    }
    assert_ne!(calm, drive(false, 8));
    let again = drive(true, 7);
    assert_eq!(busy, again, "the same calls give the same bits");
}

#[test]
fn turns_are_exact_and_told_exactly() {
    let mut robot = SimRobot::new(field(10), RobotParams::default(), 1);
    let start = robot.world_from_body();
    for _ in 0..8 {
        let told = robot.turn(std::f64::consts::FRAC_PI_4);
        assert_eq!(told.distance_m, 0.0);
        assert_eq!(told.before_from_after.distance(), 0.0);
    }
    let end = robot.world_from_body();
    assert_eq!(end.translation, start.translation);
    assert!(start.inverse_mul(&end).angle().abs() < 1e-12);
    assert!((robot.tally().turning_rad - std::f64::consts::TAU).abs() < 1e-12);
    assert_eq!(robot.tally().distance_m, 0.0);
}

#[test]
fn a_commanded_motion_into_a_wall_is_a_collision_and_stops_short_of_it() {
    // The right wall stands at x = 10, the start at x = 5.
    for radius_m in [0.0, 0.3] {
        let drive = DriveParams { robot_radius_m: radius_m, ..DriveParams::default() };
        let mut robot = SimRobot::new(field(10), RobotParams { drive, ..quiet() }, 1);
        robot.forward(4.0);
        assert_eq!(robot.tally().collisions, 0);
        let told = robot.forward(2.0);
        assert_eq!(told.before_from_after, Se2::new(2.0, 0.0, 0.0), "the wheels know no wall");
        assert_eq!((robot.tally().collisions, robot.tally().bumps), (1, 0));
        let stopped_m = 10.0 - robot.world_from_body().translation.x - radius_m;
        assert!((stopped_m - 1e-3).abs() < 1e-8, "{stopped_m}");
        assert!((robot.tally().min_clearance_m - radius_m - 1e-3).abs() < 1e-8);
        // It may leave, and pressing on counts again.
        robot.forward(1.0);
        assert_eq!(robot.tally().collisions, 2);
        robot.turn(std::f64::consts::PI);
        robot.forward(1.0);
        assert_eq!(robot.tally().collisions, 2);
        let x = robot.world_from_body().translation.x;
        assert!((x - (9.0 - radius_m - 1e-3)).abs() < 1e-8);
        assert_eq!(robot.tally().distance_m, 8.0, "the distance is the commanded one");
        assert_eq!(robot.tally().forwards, 4);
    }
}

#[test]
fn noise_into_a_wall_is_a_bump_and_not_a_collision() {
    let odometry =
        OdometryParams { bias_translation: 1.0, scale: 1.0, ..OdometryParams::default() };
    let params = RobotParams { odometry, ..RobotParams::default() };
    let mut robot = SimRobot::new(field(10), params, 3);
    // The command ends at x = 8, its noise would end near x = 11.
    robot.forward(3.0);
    assert_eq!((robot.tally().collisions, robot.tally().bumps), (0, 1));
    let gap_m = 10.0 - robot.world_from_body().translation.x;
    assert!(gap_m > 0.0 && gap_m < 0.01, "{gap_m}");
}

#[test]
fn distances_that_make_no_sense_do_not_move_the_robot() {
    let mut robot = SimRobot::new(field(10), RobotParams::default(), 1);
    let start = robot.world_from_body();
    for bad_m in [-1.0, f64::NAN, f64::INFINITY, 0.0] {
        assert_eq!(robot.forward(bad_m).distance_m, 0.0);
        assert_eq!(robot.world_from_body().translation, start.translation);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn however_wild_the_noise_the_robot_stays_in_free_space(
        seed in 0..1000u64,
        scale in 0.0..8.0f64,
        radius_m in prop_oneof![Just(0.0), 0.05..0.3f64],
        steps in prop::collection::vec((-3.2..3.2f64, 0.0..3.0f64), 60),
    ) {
        let params = RobotParams {
            odometry: OdometryParams { scale, ..OdometryParams::default() },
            drive: DriveParams { robot_radius_m: radius_m, ..DriveParams::default() },
            ..RobotParams::default()
        };
        let world = Arc::new(paper::forest_house());
        let mut robot = SimRobot::new(world.clone(), params, seed);
        let mut least_m = f64::INFINITY;
        for (turn_rad, distance_m) in steps {
            robot.turn(turn_rad);
            robot.forward(distance_m);
            let at = Point2::from(robot.world_from_body().translation);
            prop_assert!(world.is_free(&at));
            least_m = least_m.min(world.caster().distance_to(&at));
        }
        prop_assert!(robot.tally().min_clearance_m <= least_m + 1e-12);
        prop_assert!(robot.tally().min_clearance_m > 0.0);
        // A disc grazes by at most the standoff, which only a stop enforces.
        prop_assert!(robot.tally().min_clearance_m > radius_m - 1e-6);
        if scale == 0.0 {
            prop_assert_eq!(robot.tally().bumps, 0);
        }
    }
}

#[test]
fn repeating_ends_on_the_true_place_heading_along_the_way() {
    let mut robot = SimRobot::new(field(60), RobotParams::default(), 5);
    robot.mark(VertexId(0));
    robot.turn(0.4);
    robot.forward(3.0);
    robot.mark(VertexId(1));
    let first = robot.world_from_vertex(VertexId(0)).unwrap();
    let from = robot.world_from_body();
    let repeated = robot.repeat(VertexId(0), 3.0);
    let body = robot.world_from_body();
    assert_eq!(body.translation, first.translation);
    let way = first.translation - from.translation;
    assert!((body.rotation * geometry::Vector2::x() - way.normalize()).norm() < 1e-12);
    assert_eq!(repeated.vertex, VertexId(0));
    assert_eq!(repeated.vertex_from_body.translation.norm(), 0.0);
    let believed = first * repeated.vertex_from_body;
    assert!(believed.inverse_mul(&body).angle().abs() < 1e-12, "the belief is exact");
    assert_eq!(repeated.distance_m, 3.0);
    assert_eq!(robot.tally().distance_m, 6.0);
    assert_eq!((robot.tally().collisions, robot.tally().bumps), (0, 0));
    // Where the two places coincide the heading stays.
    let before = robot.world_from_body();
    robot.repeat(VertexId(0), 0.0);
    assert_eq!(robot.world_from_body(), before);
}

#[test]
fn repeat_error_is_not_known_to_the_robot() {
    let drive = DriveParams {
        repeat_sigma_m: 0.1,
        repeat_sigma_rotation_rad: 0.05,
        ..DriveParams::default()
    };
    let params = RobotParams { drive, ..quiet() };
    let mut errors = Vec::new();
    for seed in 0..1000 {
        let mut robot = SimRobot::new(field(60), params.clone(), seed);
        robot.mark(VertexId(0));
        robot.forward(2.0);
        let told = robot.repeat(VertexId(0), 2.0);
        assert_eq!(told.vertex_from_body.translation.norm(), 0.0);
        let believed = robot.world_from_vertex(VertexId(0)).unwrap() * told.vertex_from_body;
        errors.push(believed.inverse_mul(&robot.world_from_body()));
    }
    let x: Vec<f64> = errors.iter().map(|e| e.translation.x).collect();
    let theta: Vec<f64> = errors.iter().map(Se2::angle).collect();
    assert!((variance(&x).1.sqrt() / 0.1 - 1.0).abs() < 0.12);
    assert!((variance(&theta).1.sqrt() / 0.05 - 1.0).abs() < 0.12);
}

#[test]
fn snapping_puts_the_robot_onto_a_vertex_it_comes_near_to() {
    let drive = DriveParams { snap_radius_m: Some(0.5), ..DriveParams::default() };
    let mut robot = SimRobot::new(field(60), RobotParams { drive, ..quiet() }, 1);
    robot.mark(VertexId(0));
    assert_eq!(robot.forward(0.3).snapped, None, "not onto the vertex that it just left");
    robot.forward(1.7);
    robot.mark(VertexId(1));
    robot.turn(std::f64::consts::PI);
    let told = robot.forward(1.8);
    let (vertex, vertex_from_body) = told.snapped.unwrap();
    assert_eq!(vertex, VertexId(0));
    assert_eq!(told.distance_m, 1.8);
    let first = robot.world_from_vertex(vertex).unwrap();
    assert_eq!(robot.world_from_body().translation, first.translation);
    assert_eq!(vertex_from_body.translation.norm(), 0.0);
    assert!((first * vertex_from_body).inverse_mul(&robot.world_from_body()).angle().abs() < 1e-12);
}

#[test]
fn both_borders_of_the_field_of_view_carry_a_ray_and_a_circle_none_twice() {
    let mut robot = SimRobot::new(field(6), quiet(), 1);
    let scan = robot.scan();
    assert_eq!(scan.len(), 16);
    assert!((scan.span_rad().to_degrees() - 115.0).abs() < 1e-9);
    assert!((scan.bearing_rad(0) + scan.bearing_rad(15)).abs() < 1e-12);
    assert!(!scan.is_full_circle() && !robot.view().full_circle);

    let sensor =
        SensorParams { fov_rad: std::f64::consts::TAU, rays: 8, ..SensorParams::default() };
    let mut robot = SimRobot::new(field(6), RobotParams { sensor, ..quiet() }, 1);
    let scan = robot.scan();
    assert!(scan.is_full_circle() && robot.view().full_circle);
    // From the middle of a 6 m square: 3 m to each side, 3 √2 m to each corner.
    for (i, (_, reading)) in scan.readings().enumerate() {
        let expected_m = if i % 2 == 0 { 3.0 } else { 3.0 * 2f64.sqrt() };
        let Reading::Hit(range_m) = reading else { panic!("ray {i} must hit") };
        assert!((range_m - expected_m).abs() < 1e-9, "ray {i}: {range_m}");
    }

    let sensor = SensorParams { rays: 1, ..SensorParams::default() };
    let mut robot = SimRobot::new(field(6), RobotParams { sensor, ..quiet() }, 1);
    let scan = robot.scan();
    assert_eq!((scan.len(), scan.bearing_rad(0)), (1, 0.0));
    assert!(!scan.is_full_circle());
}

#[test]
fn nothing_in_range_is_a_miss_and_range_noise_leaves_the_true_view_alone() {
    let mut robot = SimRobot::new(field(60), RobotParams::default(), 1);
    assert!(robot.scan().readings().all(|(_, reading)| reading == Reading::Miss));
    assert!(robot.view().hit.iter().all(|&hit| !hit));
    let at = Point2::from(robot.world_from_body().translation);
    assert!(robot.view().ends_in_world.iter().all(|end| ((end - at).norm() - 5.0).abs() < 1e-12));

    let sensor = SensorParams { range_sigma_m: 0.1, rays: 400, ..SensorParams::default() };
    let mut robot = SimRobot::new(field(6), RobotParams { sensor, ..quiet() }, 1);
    let at = Point2::from(robot.world_from_body().translation);
    let (first, second) = (robot.scan(), robot.scan());
    let errors: Vec<f64> = first
        .ranges_m
        .iter()
        .zip(&robot.view().ends_in_world)
        .map(|(range_m, end)| range_m - (end - at).norm())
        .collect();
    let (mean, spread) = variance(&errors);
    assert!(mean.abs() < 0.03 && (spread.sqrt() / 0.1 - 1.0).abs() < 0.2, "{mean} {spread}");
    assert_ne!(first.ranges_m, second.ranges_m, "each scan has its own noise");
}
