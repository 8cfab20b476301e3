//! Coverage: which cells count, which are seen, and the distance at first sight.

use std::sync::Arc;

use geometry::{Point2, Vector2};
use metrics::{CellShape, Coverage, CoverageParams, MetricsError, Rule, Verdict, View, Witness};
use pose::Se2;
use probe::VertexId;
use proptest::prelude::*;
use sensing::Robot;
use worlds::{CellMap, OdometryParams, RobotParams, SensorParams, SimRobot, World2d};

fn square(side_m: f64) -> CellShape {
    CellShape::Square { side_m }
}

fn still() -> OdometryParams {
    OdometryParams { scale: 0.0, ..OdometryParams::default() }
}

prop_compose! {
    fn cell_map()(columns in 2..16usize, rows in 2..16usize)(
        solid in prop::collection::vec(prop::bool::weighted(0.3), columns * rows),
        columns in Just(columns), rows in Just(rows),
        x in -20.0..20.0f64, y in -20.0..20.0f64, cell_m in 0.1..2.0f64,
    ) -> CellMap {
        CellMap { columns, rows, cell_m, origin_in_world: Point2::new(x, y), solid }
    }
}

fn centre(cells: &CellMap, index: usize) -> Point2 {
    let (column, row) = (index % cells.columns, index / cells.columns);
    cells.origin_in_world + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cells.cell_m
}

/// A world whose start is the middle of its first free cell.
fn world(cells: &CellMap) -> Option<World2d> {
    let first = cells.solid.iter().position(|&solid| !solid)?;
    let start = centre(cells, first);
    World2d::from_cells("random", cells.clone(), Se2::new(start.x, start.y, 0.0)).ok()
}

/// Whether all raster cells under a block of `k` by `k` are free, outside being solid.
fn block_is_free(cells: &CellMap, k: usize, column: usize, row: usize) -> bool {
    (0..k)
        .all(|dy| (0..k).all(|dx| !cells.is_solid((column * k + dx) as i64, (row * k + dy) as i64)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_cell_is_free_when_every_raster_cell_in_it_is(cells in cell_map(), k in 1..4usize) {
        let Some(world) = world(&cells) else { return Ok(()) };
        let params = CoverageParams { cells: square(cells.cell_m * k as f64), rule: Rule::Rays };
        let coverage = Coverage::new(&world, params).expect("the cell size is sound");
        let (columns, rows) = coverage.size();
        prop_assert_eq!((columns, rows), (cells.columns.div_ceil(k), cells.rows.div_ceil(k)));
        let free: Vec<bool> =
            (0..columns * rows).map(|i| block_is_free(&cells, k, i % columns, i / columns)).collect();
        prop_assert_eq!(coverage.cells_total(), free.iter().filter(|&&free| free).count());

        // What counts is one component of the free cells, by relaxing labels until they rest.
        let counted: Vec<bool> = (0..free.len()).map(|i| coverage.counts(i)).collect();
        prop_assert!(counted.iter().zip(&free).all(|(counts, free)| !counts || *free));
        let mut reached: Vec<bool> = vec![false; free.len()];
        if let Some(first) = counted.iter().position(|&counts| counts) {
            reached[first] = true;
            for _ in 0..free.len() {
                for i in 0..free.len() {
                    let (column, row) = (i % columns, i / columns);
                    let beside = (column > 0 && reached[i - 1])
                        || (column + 1 < columns && reached[i + 1])
                        || (row > 0 && reached[i - columns])
                        || (row + 1 < rows && reached[i + columns]);
                    reached[i] |= free[i] && beside;
                }
            }
        }
        prop_assert_eq!(counted, reached);
        if k == 1 {
            let start = cells.solid.iter().position(|&solid| !solid).unwrap();
            prop_assert!(coverage.counts(start), "the start's own cell counts");
        }
    }

    #[test]
    fn rays_see_what_samples_along_them_touch(
        cells in cell_map(), seed in 0..100u64,
        turns in prop::collection::vec(-3.0..3.0f64, 3),
    ) {
        let Some(world) = world(&cells) else { return Ok(()) };
        let cell_m = cells.cell_m;
        let coverage = Coverage::new(&world, CoverageParams { cells: square(cell_m), rule: Rule::Rays }).expect("the cell size is sound");
        let params = RobotParams { odometry: still(), ..RobotParams::default() };
        let mut witness = Witness::new(SimRobot::new(Arc::new(world), params, seed), coverage);
        let mut crossed = vec![false; cells.solid.len()];
        let mut grazed = crossed.clone();
        for turn_rad in turns {
            witness.turn(turn_rad);
            witness.forward(0.7 * cell_m);
            witness.scan();
            let in_cells = |point: &Point2| (point - cells.origin_in_world) / cell_m;
            let origin = in_cells(&Point2::from(witness.view().world_from_sensor.translation));
            for end in &witness.view().ends_in_world {
                for index in 0..cells.solid.len() {
                    let low = Vector2::new(
                        (index % cells.columns) as f64,
                        (index / cells.columns) as f64,
                    );
                    crossed[index] |= meets_box(origin, in_cells(end), low, -1e-6);
                    grazed[index] |= meets_box(origin, in_cells(end), low, 1e-6);
                }
            }
        }
        let coverage = witness.coverage();
        for index in 0..cells.solid.len() {
            let seen = coverage.first_seen_m(index).is_some();
            prop_assert!(!(coverage.counts(index) && crossed[index]) || seen);
            prop_assert!(!seen || grazed[index]);
        }
    }

    #[test]
    fn views_see_the_centres_between_their_rays(
        cells in cell_map(), turn_rad in -3.0..3.0f64, fov_deg in prop_oneof![20.0..350.0f64, Just(360.0)],
        rays in 8..60usize, k in 1..4usize,
    ) {
        let Some(world) = world(&cells) else { return Ok(()) };
        let cell_m = cells.cell_m / k as f64;
        let coverage = Coverage::new(&world, CoverageParams { cells: square(cell_m), rule: Rule::View }).expect("the cell size is sound");
        let sensor = SensorParams { fov_rad: fov_deg.to_radians(), rays, ..SensorParams::default() };
        let params = RobotParams { odometry: still(), sensor, ..RobotParams::default() };
        let mut witness = Witness::new(SimRobot::new(Arc::new(world), params, 1), coverage);
        witness.turn(turn_rad);
        witness.scan();
        let (coverage, view) = (witness.coverage(), witness.view());
        for index in 0..coverage.size().0 * coverage.size().1 {
            let inside = star_depth(view, &coverage.centre_in_world(index));
            if inside.abs() > 1e-6 && coverage.counts(index) {
                prop_assert_eq!(coverage.first_seen_m(index).is_some(), inside > 0.0);
            }
        }
    }
}

/// Whether a segment meets the unit box at `low` grown by `grow` on each side: clipping by slabs.
fn meets_box(from: Vector2, to: Vector2, low: Vector2, grow: f64) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        let (near, far) = (low[axis] - grow, low[axis] + 1.0 + grow);
        if step == 0.0 {
            if from[axis] < near || from[axis] > far {
                return false;
            }
            continue;
        }
        let (a, b) = ((near - from[axis]) / step, (far - from[axis]) / step);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    enter <= leave
}

/// How deep a point lies in a view, by its bearing: the radial test of a star-shaped region.
/// Positive inside, negative outside; near 0 within rounding of the border.
fn star_depth(view: &View, point: &Point2) -> f64 {
    let origin = Point2::from(view.world_from_sensor.translation);
    let ends = &view.ends_in_world;
    let sides = if view.full_circle { ends.len() } else { ends.len() - 1 };
    let cross = |a: Vector2, b: Vector2| a.x * b.y - a.y * b.x;
    let to = point - origin;
    let mut best = f64::NEG_INFINITY;
    for i in 0..sides {
        let (a, b) = (ends[i], ends[(i + 1) % ends.len()]);
        let left = cross((a - origin).normalize(), to);
        let right = cross(to, (b - origin).normalize());
        let across = cross((b - a).normalize(), point - a);
        best = best.max(left.min(right).min(across));
    }
    best
}

/// A corridor one cell wide along x, and a robot that looks along it.
fn corridor(length: usize) -> Witness {
    let start = Se2::new(0.5, 0.5, 0.0);
    let world = World2d::from_cells("corridor", CellMap::free(length, 1, 1.0), start)
        .expect("the start is free");
    let coverage =
        Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
    let sensor = SensorParams { rays: 1, range_m: 3.0, ..SensorParams::default() };
    let params = RobotParams { sensor, odometry: still(), ..RobotParams::default() };
    Witness::new(SimRobot::new(Arc::new(world), params, 1), coverage)
}

#[test]
fn distance_at_first_sight_is_counted_by_hand() {
    let mut witness = corridor(8);
    witness.scan();
    // The ray from x = 0.5 to 3.5 touches cells 0, 1, 2, 3, at distance 0.
    assert_eq!(witness.take_newly_seen(), vec![0, 1, 2, 3]);
    assert_eq!(witness.coverage().fraction(), 0.5);
    assert_eq!(witness.coverage().d_exp_m(), None);
    let verdict = witness.verdict(true);
    assert!(verdict.false_completion);
    assert_eq!((verdict.d_max_m, verdict.d_exp_m), (None, None));

    witness.forward(1.0);
    witness.scan();
    assert_eq!(witness.take_newly_seen(), vec![4]);
    witness.mark(VertexId(0));
    witness.forward(2.0);
    witness.scan();
    assert_eq!(witness.take_newly_seen(), vec![5, 6]);
    witness.forward(1.5);
    witness.repeat(VertexId(0), 1.5);
    assert!(witness.take_newly_seen().is_empty(), "only scans see");
    witness.turn(std::f64::consts::PI);
    witness.forward(2.0);
    witness.scan();
    assert_eq!(witness.take_newly_seen(), Vec::<usize>::new());
    witness.turn(0.0);
    let tally = witness.tally();
    assert_eq!((tally.scans, tally.collisions, tally.bumps), (4, 0, 0));
    assert_eq!(tally.distance_m, 8.0);

    witness.forward(2.0);
    witness.scan();
    assert_eq!(witness.take_newly_seen(), vec![7]);
    // (4 · 0 + 1 · 1 + 2 · 3 + 1 · 10) / 8
    assert_eq!(witness.coverage().d_exp_m(), Some(17.0 / 8.0));
    assert_eq!(witness.coverage().first_seen_m(7), Some(10.0));
    assert_eq!(
        witness.verdict(true),
        Verdict {
            believed_complete: true,
            coverage: 1.0,
            false_completion: false,
            distance_m: 10.0,
            d_max_m: Some(10.0),
            d_exp_m: Some(17.0 / 8.0),
            cells_total: 8,
            cells_reachable: 8,
        }
    );
    let unsure = witness.verdict(false);
    assert_eq!((unsure.d_max_m, unsure.d_exp_m), (None, None));
    assert!(!unsure.false_completion);
}

#[test]
fn what_the_robot_cannot_reach_does_not_count() {
    // Two rooms; no door between them.
    let mut cells = CellMap::free(7, 3, 1.0);
    for row in 0..3 {
        cells.solid[row * 7 + 3] = true;
    }
    let world = World2d::from_cells("rooms", cells, Se2::new(0.5, 0.5, 0.0)).unwrap();
    let coverage =
        Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
    assert_eq!((coverage.cells_total(), coverage.cells_reachable()), (18, 9));
}

#[test]
fn a_start_in_a_cell_that_a_wall_cuts_counts_from_the_nearest_cell_in_sight() {
    let ring = |low: f64, high: f64| {
        [(low, low), (high, low), (high, high), (low, high)]
            .map(|(x, y)| Point2::new(x, y))
            .to_vec()
    };
    // The block cuts the cells from 3 to 5; the start stands in one of them, left of the block.
    let rings = vec![ring(0.0, 8.0), ring(3.5, 4.5)];
    let world = World2d::from_polygons("block", rings, Se2::new(3.2, 4.0, 0.0)).unwrap();
    let coverage =
        Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
    assert_eq!((coverage.cells_total(), coverage.cells_reachable()), (60, 60));
}

#[test]
fn a_place_without_a_free_cell_is_never_complete() {
    let ring = vec![Point2::new(0.0, 0.0), Point2::new(1.0, 0.0), Point2::new(0.0, 1.0)];
    let world = World2d::from_polygons("wedge", vec![ring], Se2::new(0.2, 0.2, 0.0)).unwrap();
    let coverage =
        Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
    assert_eq!((coverage.cells_total(), coverage.cells_reachable()), (0, 0));
    assert_eq!((coverage.fraction(), coverage.is_complete()), (0.0, false));
    assert_eq!(coverage.d_exp_m(), None);
}

#[test]
fn a_ray_onto_a_wall_along_a_cell_border_does_not_see_behind_it() {
    let ring = |x0: f64, x1: f64| {
        [(x0, 0.0), (x1, 0.0), (x1, 5.0), (x0, 5.0)].map(|(x, y)| Point2::new(x, y)).to_vec()
    };
    // A wall from x = 3 to x = 3.1; the cells behind it are seen by no ray from the left.
    let rings = vec![ring(0.0, 8.0), ring(3.0, 3.1)];
    let world = World2d::from_polygons("wall", rings, Se2::new(0.5, 2.5, 0.0)).unwrap();
    let mut coverage =
        Coverage::new(&world, CoverageParams { cells: square(0.1), rule: Rule::Rays })
            .expect("the cell size is sound");
    let mut robot = SimRobot::new(Arc::new(world), RobotParams::default(), 1);
    robot.scan();
    coverage.see(robot.view(), 0.0);
    let seen = coverage.take_newly_seen();
    assert!(seen.len() > 100);
    assert!(seen.iter().all(|&index| coverage.centre_in_world(index).x < 3.0));
}

#[test]
fn cell_sizes_that_make_no_grid_are_refused() {
    let world = worlds::paper::maze();
    for cell_m in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-6] {
        let refused =
            Coverage::new(&world, CoverageParams { cells: square(cell_m), rule: Rule::Rays });
        assert!(matches!(refused, Err(MetricsError::CellSize { .. })), "{cell_m}");
    }
    for (columns, rows) in [(0, 5), (5, 0), (1_000_000, 1_000_000), (usize::MAX, 2)] {
        let cells = CellShape::Grid { columns, rows };
        let refused = Coverage::new(&world, CoverageParams { cells, rule: Rule::Rays });
        assert!(matches!(refused, Err(MetricsError::GridSize { .. })), "{columns} by {rows}");
    }
    // Larger than the place: one cell, which the walls cut; much larger can only be a slip.
    let coverage = |cell_m| {
        Coverage::new(&world, CoverageParams { cells: square(cell_m), rule: Rule::Rays })
            .map(|coverage| coverage.cells_total())
    };
    assert_eq!(coverage(62.0), Ok(0));
    assert_eq!(coverage(100.0), Err(MetricsError::CellBeyondPlace { cell_m: 100.0, most_m: 62.0 }));
}

#[test]
fn a_grid_of_the_thesis_counts_what_no_block_touches() {
    // 30 m by 30 m in 25 by 20 cells of 1.2 m by 1.5 m. The blocks span x from 5 to 10 and from 20
    // to 25, y from 20 to 25: columns 4 to 8 and 16 to 20, rows 13 to 16.
    let coverage = Coverage::new(
        &worlds::thesis::first(),
        CoverageParams { cells: CellShape::Grid { columns: 25, rows: 20 }, rule: Rule::Rays },
    )
    .expect("the grid is sound");
    assert_eq!(coverage.size(), (25, 20));
    assert!((coverage.cell_m() - Vector2::new(1.2, 1.5)).norm() < 1e-12);
    assert_eq!(coverage.cells_total(), 25 * 20 - 2 * 5 * 4);
    assert_eq!(coverage.cells_reachable(), coverage.cells_total());
    for (column, row, counts) in [(3, 13, true), (4, 12, true), (4, 13, false), (20, 16, false)] {
        assert_eq!(coverage.counts(row * 25 + column), counts, "{column}, {row}");
    }
    assert!((coverage.centre_in_world(13 * 25 + 4) - Point2::new(5.4, 20.25)).norm() < 1e-12);
}

/// A hall of 8 m by 8 m with at most one block in each of its quarters.
fn hall(blocks: &[Option<[f64; 4]>], squeeze: f64) -> World2d {
    let ring = |x: f64, y: f64, width: f64, height: f64| {
        [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
            .map(|(x, y)| Point2::new(x * squeeze, y))
            .to_vec()
    };
    let mut rings = vec![ring(0.0, 0.0, 8.0, 8.0)];
    for (quarter, block) in blocks.iter().enumerate() {
        let (x, y) = ((quarter % 2) as f64 * 4.0, (quarter / 2) as f64 * 4.0);
        let Some([left, low, width, height]) = *block else { continue };
        rings.push(ring(x + 0.5 + left, y + 0.5 + low, width, height));
    }
    let start = Se2::new(4.1 * squeeze, 0.25, 0.0);
    World2d::from_polygons("hall", rings, start).expect("the start is free")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn cells_that_are_not_square_see_what_square_ones_see_of_the_place_before_it_was_squeezed(
        blocks in prop::collection::vec(prop::option::of([0.0..1.5f64, 0.0..1.5, 0.1..1.5, 0.1..1.5]), 4),
        count in 1..12usize, squeeze in 0.2..5.0f64,
        ends in prop::collection::vec((-1.0..9.0f64, 0.5..9.0f64, any::<bool>()), 1..20),
    ) {
        // A straight line stays straight, and what it crosses stays crossed.
        let (even, narrow) = (hall(&blocks, 1.0), hall(&blocks, squeeze));
        let origin = even.world_from_start();
        let mut ends = ends;
        let bearing = |end: &(f64, f64, bool)| (end.1 - 0.25).atan2(end.0 - 4.1);
        ends.sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
        let view = |squeeze: f64| View {
            world_from_sensor: Se2::new(origin.translation.x * squeeze, origin.translation.y, 0.0),
            ends_in_world: ends.iter().map(|end| Point2::new(end.0 * squeeze, end.1)).collect(),
            hit: ends.iter().map(|end| end.2).collect(),
            bearing_step_rad: 0.1,
            full_circle: false,
        };
        for rule in [Rule::Rays, Rule::View] {
            let cells = square(8.0 / count as f64);
            let mut by_square = Coverage::new(&even, CoverageParams { cells, rule }).expect("sound");
            let cells = CellShape::Grid { columns: count, rows: count };
            let mut by_grid = Coverage::new(&narrow, CoverageParams { cells, rule }).expect("sound");
            prop_assert_eq!(by_square.size(), by_grid.size());
            // Where a block cuts the start's cell, the nearest is another in the squeezed place.
            prop_assume!(by_square.counts((4.1 / 8.0 * count as f64) as usize));
            by_square.see(&view(1.0), 1.0);
            by_grid.see(&view(squeeze), 1.0);
            for index in 0..count * count {
                prop_assert_eq!(by_square.counts(index), by_grid.counts(index));
                let seen = (by_square.first_seen_m(index), by_grid.first_seen_m(index));
                prop_assert_eq!(seen.0, seen.1, "{:?} {}", rule, index);
            }
        }
    }
}
