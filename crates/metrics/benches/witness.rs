//! The cost of watching a simulated robot: per scan and per step, in small and large places.

use std::sync::Arc;

use criterion::{BenchmarkId, Criterion};
use metrics::{CellShape, Coverage, CoverageParams, Rule, Witness};
use pose::Se2;
use probe::VertexId;
use sensing::Robot;
use worlds::{CellMap, OdometryParams, RobotParams, SensorParams, SimRobot, World2d, paper};

/// A hall with a pillar every 2 m, raster cells of 0.1 m.
fn hall(size: usize) -> World2d {
    let mut cells = CellMap::free(size, size, 0.1);
    for row in (5..size).step_by(20) {
        for column in (5..size).step_by(20) {
            cells.solid[row * size + column] = true;
        }
    }
    let middle = 0.05 * size as f64;
    World2d::from_cells("hall", cells, Se2::new(middle, middle, 0.0)).expect("the middle is free")
}

/// Marking one view as seen: a fresh coverage, and one that saw it already.
fn views(c: &mut Criterion) {
    let mut group = c.benchmark_group("coverage");
    group.sample_size(20);
    for size in [200usize, 2000] {
        let world = hall(size);
        let fov_rad = std::f64::consts::TAU;
        let sensor = SensorParams { fov_rad, rays: 360, range_m: 5.0, range_sigma_m: 0.0 };
        let params = RobotParams { sensor, ..RobotParams::default() };
        let mut robot = SimRobot::new(Arc::new(world.clone()), params, 1);
        robot.scan();
        for rule in [Rule::Rays, Rule::View] {
            let mut coverage = Coverage::new(
                &world,
                CoverageParams { cells: CellShape::Square { side_m: 0.25 }, rule },
            )
            .expect("the cell size is sound");
            coverage.see(robot.view(), 0.0);
            group.bench_function(BenchmarkId::new(format!("see_{rule:?}"), size * size), |b| {
                b.iter(|| coverage.see(robot.view(), 0.0));
            });
        }
    }
    group.finish();
}

/// One step of a robot that drives down a corridor and marks every pose.
fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group.sample_size(10);
    for known in [1_000u32, 100_000] {
        // Long enough never to end: at its end the robot would pile vertices on one spot.
        let length = 1_000_000;
        let start = Se2::new(1.0, 1.5, 0.0);
        let cells = CellMap::free(length, 3, 1.0);
        let world = World2d::from_cells("corridor", cells, start).expect("the start is free");
        let odometry = OdometryParams { scale: 0.0, ..OdometryParams::default() };
        let params = RobotParams { odometry, ..RobotParams::default() };
        let coverage =
            Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
        let mut robot = Witness::new(SimRobot::new(Arc::new(world), params, 1), coverage);
        let mut next = 0;
        let mut step = |robot: &mut Witness| {
            robot.forward(0.5);
            robot.scan();
            robot.mark(VertexId(next));
            next += 1;
            robot.recognize()
        };
        for _ in 0..known {
            step(&mut robot);
        }
        group.bench_function(BenchmarkId::new("new_ground", known), |b| {
            b.iter(|| step(&mut robot));
        });
    }
    let world = Arc::new(paper::maze());
    group.bench_function("construct_maze", |b| {
        b.iter(|| {
            let coverage =
                Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
            Witness::new(SimRobot::new(world.clone(), RobotParams::default(), 1), coverage)
        });
    });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    views(&mut criterion);
    steps(&mut criterion);
    criterion.final_summary();
}
