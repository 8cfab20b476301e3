//! Places: what is solid, its border, and that no ray leaks through it.

use geometry::{Point2, Vector2};
use pose::Se2;
use proptest::prelude::*;
use worlds::{CellMap, Solid, World2d, WorldError};

prop_compose! {
    fn cell_map()(columns in 1..14usize, rows in 1..14usize, cell_m in 0.05..3.0f64)(
        solid in prop::collection::vec(prop::bool::weighted(0.3), columns * rows),
        x in -50.0..50.0f64, y in -50.0..50.0f64,
        columns in Just(columns), rows in Just(rows), cell_m in Just(cell_m),
    ) -> CellMap {
        CellMap { columns, rows, cell_m, origin_in_world: Point2::new(x, y), solid }
    }
}

fn centre(cells: &CellMap, index: usize) -> Point2 {
    let (column, row) = (index % cells.columns, index / cells.columns);
    cells.origin_in_world + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cells.cell_m
}

fn free_world(cells: CellMap) -> Option<(World2d, Point2)> {
    let free = cells.solid.iter().position(|&solid| !solid)?;
    let start = centre(&cells, free);
    let world = World2d::from_cells("random", cells, Se2::new(start.x, start.y, 0.0));
    world.ok().map(|world| (world, start))
}

/// The border of a cell map the slow way: every side between a solid and a free cell.
fn border_length_m(cells: &CellMap) -> f64 {
    let mut sides = 0;
    for row in -1..=cells.rows as i64 {
        for column in -1..=cells.columns as i64 {
            let here = cells.is_solid(column, row);
            sides += usize::from(here != cells.is_solid(column + 1, row));
            sides += usize::from(here != cells.is_solid(column, row + 1));
        }
    }
    sides as f64 * cells.cell_m
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn rays_run_through_free_space_up_to_their_hit(
        cells in cell_map(),
        angles in prop::collection::vec(0.0..7.0f64, 20),
        dx in -0.49..0.49f64, dy in -0.49..0.49f64,
    ) {
        let cell_m = cells.cell_m;
        let Some((world, start)) = free_world(cells) else { return Ok(()) };
        let origin = start + Vector2::new(dx, dy) * cell_m;
        let diagonals = (0..4).map(|i| std::f64::consts::FRAC_PI_4 * f64::from(2 * i + 1));
        let axes = (0..4).map(|i| std::f64::consts::FRAC_PI_2 * f64::from(i));
        for angle in angles.into_iter().chain(diagonals).chain(axes) {
            let direction = Vector2::new(angle.cos(), angle.sin());
            let hit_m = world.caster().cast(&origin, &direction, 1e4);
            prop_assert!(hit_m.is_some(), "a ray leaves the place");
            let hit_m = hit_m.unwrap();
            for i in 0..200 {
                // Points within rounding of a cell's side belong to neither side.
                let at = origin + direction * (hit_m * f64::from(i) / 200.0);
                let near_border = world.caster().distance_to(&at) < 1e-9;
                prop_assert!(near_border || world.is_free(&at), "a ray runs inside a wall");
            }
        }
    }

    #[test]
    fn rays_leave_no_gap_at_the_corners_of_cells(cells in cell_map()) {
        let corners: Vec<Point2> = (0..=cells.columns)
            .flat_map(|x| (0..=cells.rows).map(move |y| Vector2::new(x as f64, y as f64)))
            .map(|offset| cells.origin_in_world + offset * cells.cell_m)
            .collect();
        let Some((world, start)) = free_world(cells) else { return Ok(()) };
        for corner in corners {
            let direction = (corner - start).normalize();
            prop_assert!(world.caster().cast(&start, &direction, 1e4).is_some());
        }
    }

    #[test]
    fn the_border_is_every_side_between_solid_and_free_in_long_runs(cells in cell_map()) {
        let expected_m = border_length_m(&cells);
        let border = Solid::Cells(cells).border();
        let length_m: f64 = border.iter().map(|(a, b)| (b - a).norm()).sum();
        prop_assert!((length_m - expected_m).abs() < 1e-6 * (1.0 + expected_m));
        // Maximal runs: no segment begins where another that runs the same way ends.
        for (_, end) in &border {
            for (start, other) in &border {
                let same_way = border.iter().any(|(a, b)| {
                    b == end && ((b - a).x == 0.0) == ((other - start).x == 0.0)
                });
                prop_assert!(start != end || !same_way);
            }
        }
    }

    #[test]
    fn a_row_of_points_is_as_free_as_each_point(
        rings in prop::collection::vec(
            prop::collection::vec((-9..9i32, -9..9i32), 3..8), 1..4),
        y in -9..9i32, first_x in -9.0..9.0f64,
    ) {
        let ring = |corners: Vec<(i32, i32)>| corners.into_iter()
            .map(|(x, y)| Point2::new(f64::from(x), f64::from(y))).collect();
        let solid = Solid::Rings(rings.into_iter().map(ring).collect());
        let first = Point2::new(first_x, f64::from(y));
        let row = solid.free_in_row(&first, 0.37, 40);
        for (i, free) in row.into_iter().enumerate() {
            let at = Point2::new(first.x + i as f64 * 0.37, first.y);
            prop_assert_eq!(free, solid.is_free(&at));
        }
    }
}

fn square(low: f64, high: f64) -> Vec<Point2> {
    [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point2::new(x, y)).to_vec()
}

#[test]
fn rings_nest_by_the_even_odd_rule() {
    let rings = vec![square(0.0, 10.0), square(3.0, 7.0), square(4.0, 6.0)];
    let world = World2d::from_polygons("yard", rings, Se2::new(1.0, 1.0, 0.0)).unwrap();
    assert!(world.is_free(&Point2::new(2.0, 5.0)));
    assert!(!world.is_free(&Point2::new(3.5, 5.0)));
    assert!(world.is_free(&Point2::new(5.0, 5.0)), "a yard inside an obstacle is free");
    assert!(!world.is_free(&Point2::new(11.0, 5.0)));
    assert_eq!(world.bounds(), (Point2::new(0.0, 0.0), Point2::new(10.0, 10.0)));
    assert_eq!(world.obstacles().len(), 12);
}

#[test]
fn a_bad_place_is_refused_with_its_measures() {
    let start = Se2::new(0.5, 0.5, 0.0);
    let mut cells = CellMap::free(2, 2, 1.0);
    cells.solid.pop();
    assert_eq!(
        World2d::from_cells("short", cells, start).unwrap_err(),
        WorldError::CellCount { found: 3, expected: 4 }
    );
    let mut cells = CellMap::free(2, 2, 1.0);
    cells.solid[0] = true;
    assert_eq!(
        World2d::from_cells("full", cells, start).unwrap_err(),
        WorldError::StartNotFree { x_m: 0.5, y_m: 0.5 }
    );
    let none = CellMap::free(0, 0, 1.0);
    assert!(matches!(World2d::from_cells("none", none, start), Err(WorldError::NoArea { .. })));
    for cell_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let cells = CellMap::free(2, 2, cell_m);
        let refused = World2d::from_cells("flat", cells, start);
        assert!(matches!(refused, Err(WorldError::NoArea { .. })), "{cell_m}");
    }
    assert!(World2d::from_polygons("empty", vec![], start).is_err());
    let open = vec![Point2::new(0.0, 0.0), Point2::new(f64::NAN, 1.0), Point2::new(1.0, 0.0)];
    assert!(World2d::from_polygons("broken", vec![open], start).is_err());
}

#[test]
fn a_raster_of_sixteen_million_cells_is_no_burden() {
    let mut cells = CellMap::free(4000, 4000, 0.05);
    for row in (7..4000).step_by(40) {
        for column in (7..4000).step_by(40) {
            cells.solid[row * 4000 + column] = true;
        }
    }
    let start = Se2::new(100.0, 100.0, 0.0);
    let world = World2d::from_cells("pillars", cells, start).unwrap();
    // 4 sides for each of 100 x 100 pillars, and the outer wall.
    assert_eq!(world.obstacles().len(), 4 * 100 * 100 + 4);
    let origin = Point2::new(100.0, 100.0);
    let hit_m = world.caster().cast(&origin, &Vector2::new(1.0, 0.0), 1e3).unwrap();
    assert!((hit_m - 100.0).abs() < 1e-9, "{hit_m}");
}
