//! Coverage of space against what can be told by hand.

use std::sync::Arc;

use geometry::{Point3, Vector3};
use metrics::{FlightWitness, MetricsError, VoxelCoverage, VoxelParams};
use sensing::FlyingRobot;
use worlds::space::{Rooms3dParams, rooms};
use worlds::{CameraParams, FlyerParams, SimFlyer, World3d};

/// A closed box with another, out of reach, beside it.
fn two_boxes() -> World3d {
    let mut vertices: Vec<Point3> = Vec::new();
    let mut triangles = Vec::new();
    for x in [0.0, 5.0] {
        let first = vertices.len() as u32;
        vertices.extend((0..8).map(|i| {
            let side = |bit: usize| if i >> bit & 1 == 1 { 4.0 } else { 0.0 };
            Point3::new(x + side(0), side(1), side(2))
        }));
        for axis in 0..3 {
            let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            for side in [0, 1 << axis] {
                triangles.push([side, side + u, side + u + v].map(|i: u32| first + i));
                triangles.push([side, side + u + v, side + v].map(|i: u32| first + i));
            }
        }
    }
    let start = Some((Point3::new(2.1, 2.05, 2.0), 0.0));
    World3d::from_mesh("boxes", vertices, triangles, start).expect("a world")
}

#[test]
fn the_box_next_door_does_not_count() {
    let world = two_boxes();
    let camera = CameraParams::default();
    let params = VoxelParams { cell_m: 0.5, ..VoxelParams::default() };
    let coverage = VoxelCoverage::new(&world, &camera, 0.2, params).expect("voxels");
    assert_eq!(coverage.size(), [18, 8, 8]);
    assert_eq!(coverage.cells_total(), 512, "8 x 8 x 8 voxels in the near box");
    assert_eq!(coverage.cells_counted(), 512);
    // A camera that sees level alone, from a body that stays away from the floor, misses the floor.
    let level = CameraParams { fov_down_rad: 0.02, ..camera.clone() };
    let params = VoxelParams { cell_m: 0.5, ..VoxelParams::default() };
    let coverage = VoxelCoverage::new(&world, &level, 0.6, params).expect("voxels");
    assert_eq!(coverage.cells_counted(), 8 * 8 * 6);
    for cell_m in [0.0, f64::NAN, 1e-9] {
        let params = VoxelParams { cell_m, ..VoxelParams::default() };
        let found = VoxelCoverage::new(&world, &camera, 0.2, params);
        assert!(matches!(found, Err(MetricsError::CellSize { .. })), "{cell_m}");
    }
}

#[test]
fn free_space_is_held_against_the_truth() {
    let world = two_boxes();
    let params = VoxelParams { cell_m: 0.5, ..VoxelParams::default() };
    let coverage =
        VoxelCoverage::new(&world, &CameraParams::default(), 0.2, params).expect("voxels");
    let judge = |most: usize, is_free: fn(&Point3) -> bool| {
        coverage.accuracy(&world, most, &mut |at| Some(is_free(at)))
    };
    // 512 voxels of the near box are free, as many of the other are out of reach, 128 lie between them.
    let right = judge(10_000, |at| at.x < 4.0);
    assert_eq!((right.free_iou, right.wrong_share, right.asked), (1.0, 0.0, 1152));
    let all = judge(10_000, |_| true);
    assert_eq!((all.free_iou, all.wrong_share), (512.0 / 1152.0, 640.0 / 1152.0));
    let none = judge(10_000, |_| false);
    assert_eq!((none.free_iou, none.wrong_share), (0.0, 0.0));
    let half = judge(10_000, |at| at.x < 2.0);
    assert_eq!((half.free_iou, half.wrong_share), (0.5, 0.0));
    let near = coverage.accuracy(&world, 10_000, &mut |at| (at.x < 4.0).then_some(at.x > 2.0));
    assert_eq!((near.free_iou, near.wrong_share, near.asked), (0.5, 0.0, 512));
    let few = judge(200, |at| at.x < 4.0);
    assert!(few.free_iou == 1.0 && (150..=200).contains(&few.asked), "{few:?}");
}

#[test]
fn what_is_seen_is_in_sight() {
    let world =
        Arc::new(rooms(&Rooms3dParams { columns: 1, ..Rooms3dParams::default() }).expect("good"));
    let params = FlyerParams::default();
    let coverage =
        VoxelCoverage::new(&world, &params.camera, params.radius_m, VoxelParams::default());
    let robot = SimFlyer::new(world.clone(), params, 1).expect("it fits");
    let mut witness = FlightWitness::new(robot, coverage.expect("voxels"));
    witness.look();
    let eye = Point3::from(witness.world_from_body().translation);
    let seen = witness.take_newly_seen();
    assert!(seen.len() > 200);
    let blocked = seen
        .iter()
        .filter(|&&at| world.caster().blocked(&eye, &witness.coverage().centre_in_world(at)))
        .count();
    // The nearest pixel may see past an edge that hides the centre.
    assert!(blocked * 50 < seen.len(), "{blocked} of {}", seen.len());
    for _ in 0..3 {
        witness.turn(std::f64::consts::FRAC_PI_2);
        witness.look();
    }
    let turned = witness.coverage().fraction();
    witness.fly(&Vector3::new(1.0, 0.0, 0.0));
    witness.look();
    let now = witness.coverage().fraction();
    assert!(now >= turned && turned > 0.05, "{turned} {now}");
    assert!(witness.coverage().first_seen_m(seen[0]) == Some(0.0));
    let verdict = witness.verdict(true);
    assert!(verdict.false_completion && verdict.d_exp_m.is_none());
    assert_eq!(verdict.cells_reachable, witness.coverage().cells_counted());
}
