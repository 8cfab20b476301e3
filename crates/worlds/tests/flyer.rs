//! A robot that flies: its camera against the world, its noise, its walls.

use std::sync::Arc;

use geometry::{Point3, Vector3};
use probe::VertexId;
use sensing::FlyingRobot;
use worlds::space::{Rooms3dParams, rooms};
use worlds::{FlyerParams, SimFlyer, StructuredLight, World3d, WorldError};

fn place() -> Arc<World3d> {
    Arc::new(rooms(&Rooms3dParams::default()).expect("a world"))
}

fn flyer(params: FlyerParams, seed: u64) -> SimFlyer {
    SimFlyer::new(place(), params, seed).expect("it fits")
}

#[test]
fn every_pixel_lies_on_a_surface_and_nothing_lies_before_it() {
    let mut robot = flyer(FlyerParams::default(), 1);
    robot.turn(0.7);
    let image = robot.look();
    let world_from_camera = robot.world_from_body() * robot.body_from_camera();
    let mut read = 0;
    for (at, &depth_m) in image.depths_m.iter().enumerate() {
        if !depth_m.is_finite() {
            continue;
        }
        read += 1;
        let (column, row) = ((at % image.columns) as f64, (at / image.columns) as f64);
        let on =
            world_from_camera.transform(&image.camera.point_in_camera(column, row, depth_m.into()));
        assert!(robot.world().caster().distance_to(&on) < 1e-5);
        let before = world_from_camera.transform(&image.camera.point_in_camera(
            column,
            row,
            f64::from(depth_m) - 1e-3,
        ));
        assert!(!robot.world().caster().blocked(&world_from_camera.translation.into(), &before));
        assert!(robot.view().contains(&before) && image.rows() == 88);
    }
    assert!(read > image.depths_m.len() / 2);
    assert!(!robot.view().contains(&world_from_camera.transform(&Point3::new(0.0, 0.0, -1.0))));
    // The camera looks along the body's x axis, its y axis points down.
    let ahead = robot.body_from_camera().transform(&Point3::new(0.0, 0.0, 1.0));
    let right = robot.body_from_camera().transform(&Point3::new(1.0, 0.0, 0.0));
    assert!((ahead - Point3::new(1.0, 0.0, 0.0)).norm() < 1e-12);
    assert!((right - Point3::new(0.0, -1.0, 0.0)).norm() < 1e-12);
}

#[test]
fn noise_has_the_asked_for_spread_and_depends_on_the_count_alone() {
    let mut params = FlyerParams::default();
    params.odometry.scale = 2.0;
    params.odometry.sigma_translation = 0.03;
    params.odometry.sigma_rotation_rad = 1.5f64.to_radians();
    let mut errors = Vec::new();
    let mut yaws = Vec::new();
    for seed in 0..400 {
        let mut robot = flyer(params.clone(), seed);
        if seed % 2 == 0 {
            robot.look();
        }
        let before = robot.world_from_body();
        let told = robot.fly(&Vector3::new(0.3, 0.0, 0.4));
        assert!((told.distance_m - 0.5).abs() < 1e-12);
        let truly = before.inverse_mul(&robot.world_from_body());
        let error = told.before_from_after.inverse_mul(&truly);
        errors.extend(error.translation.iter().copied().collect::<Vec<_>>());
        yaws.push(error.rotation.scaled_axis().z);
    }
    let deviation = |x: &[f64]| (x.iter().map(|e| e * e).sum::<f64>() / x.len() as f64).sqrt();
    let expected = 2.0 * 0.5f64.sqrt();
    assert!((deviation(&errors) / (expected * 0.03) - 1.0).abs() < 0.1);
    assert!((deviation(&yaws) / (expected * 1.5f64.to_radians()) - 1.0).abs() < 0.15);
}

#[test]
fn commands_into_walls_are_collisions_and_stop_short() {
    let mut robot = flyer(FlyerParams::default(), 3);
    robot.fly(&Vector3::new(0.0, 0.0, 9.0));
    assert_eq!(robot.tally().collisions, 1);
    let at = Point3::from(robot.world_from_body().translation);
    let clearance_m = robot.world().caster().distance_to(&at);
    assert!(clearance_m > 0.2 && clearance_m < 0.5);
    let params = FlyerParams { radius_m: 9.0, ..FlyerParams::default() };
    let tight = SimFlyer::new(place(), params, 1);
    assert!(matches!(tight, Err(WorldError::StartTooTight { .. })));
}

#[test]
fn the_way_back_is_exact_and_places_are_recognised() {
    let mut params = FlyerParams::default();
    params.odometry.scale = 3.0;
    params.places.exclude_factor = 0.5;
    let mut robot = flyer(params, 5);
    robot.mark(VertexId(0));
    robot.turn(1.0);
    robot.turn(-1.0);
    for vertex in 1..=4 {
        robot.fly(&Vector3::new(if vertex <= 2 { 0.8 } else { -0.8 }, 0.0, 0.0));
        robot.mark(VertexId(vertex));
    }
    let matches = robot.recognize();
    assert_eq!(matches.iter().map(|m| m.vertex.0).collect::<Vec<_>>(), [0, 1, 2]);
    for found in &matches {
        let known = robot.world_from_vertex(found.vertex).expect("marked");
        let off = (known * found.known_from_current).inverse_mul(&robot.world_from_body());
        assert!(off.distance() < 1e-9 && off.rotation.angle() < 1e-9);
    }
    let flown = robot.tally().distance_m;
    let told = robot.repeat(VertexId(3), 0.8);
    assert_eq!(told.vertex, VertexId(3));
    assert_eq!(robot.world_from_vertex(VertexId(3)), Some(robot.world_from_body()));
    assert!((robot.tally().distance_m - flown - 0.8).abs() < 1e-12);
}

#[test]
fn structured_light_grows_with_the_square_of_the_depth() {
    let mut params = FlyerParams::default();
    params.camera.noise = Some(StructuredLight { sigma_m: 0.0, sigma_per_m: 0.01 });
    let mut robot = flyer(params.clone(), 1);
    let image = robot.look();
    let shares: Vec<f64> = image
        .depths_m
        .iter()
        .zip(&robot.view().depths_m)
        .filter(|(told, _)| told.is_finite())
        .map(|(told, truly)| (f64::from(*told) - truly) / (truly * truly))
        .collect();
    let deviation = (shares.iter().map(|s| s * s).sum::<f64>() / shares.len() as f64).sqrt();
    assert!((deviation - 0.01).abs() < 1e-3, "{deviation}");
    let again = flyer(params, 1).look();
    let bits = |image: &sensing::DepthImage| -> Vec<u32> {
        image.depths_m.iter().map(|depth_m| depth_m.to_bits()).collect()
    };
    assert_eq!(bits(&image), bits(&again));
}

#[test]
fn bad_meshes_are_told() {
    let points =
        vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, f64::NAN)];
    let build = |vertices: &[Point3], triangles: Vec<[u32; 3]>, start| {
        World3d::from_mesh("bad", vertices.to_vec(), triangles, start)
    };
    assert!(matches!(build(&points, vec![], None), Err(WorldError::NoTriangles)));
    let corner = build(&points, vec![[0, 1, 2]], None);
    assert!(matches!(corner, Err(WorldError::Corner { triangle: 0, vertex: 2, vertices: 3 })));
    let mut points = points;
    points[2] = Point3::new(0.0, 1.0, 0.0);
    assert!(matches!(build(&points, vec![[0, 1, 2]], None), Err(WorldError::NotClosedIn)));
    let outside = Some((Point3::new(0.0, 0.0, 5.0), 0.0));
    assert!(matches!(
        build(&points, vec![[0, 1, 2]], outside),
        Err(WorldError::StartInSpace { .. })
    ));
    points[1].x = 1e9;
    assert!(matches!(build(&points, vec![[0, 1, 2]], None), Err(WorldError::FarVertex { .. })));
    // A start is found where none is named.
    let world = place();
    let mesh = (world.vertices().to_vec(), world.triangles().to_vec());
    let found = World3d::from_mesh("found", mesh.0, mesh.1, None).expect("closed in");
    let start = Point3::from(found.world_from_start().translation);
    assert!(found.caster().distance_to(&start) > 0.8);
}
