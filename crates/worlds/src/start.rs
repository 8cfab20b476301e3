//! Where a robot starts when nobody says so, and whether it can start where somebody does.

mod components;
mod distance;

use geometry::{Point2, Vector2};
use pose::Se2;

use crate::{CellMap, Solid, World2d, WorldError};

pub use components::{Components, components};
pub use distance::squared_distances;

/// Cells along the longer side of a place drawn as rings, when its start is looked for.
const RING_CELLS: usize = 512;

/// The most open place of a map: the centre of a cell, heading along +x.
///
/// Among the cells of the largest free component (4-neighbours; the first one where two are equal)
/// it is the one farthest from any solid cell, the outside of the map included; the least index
/// where two are equal. Linear in the cells.
///
/// # Errors
/// [`WorldError::NoFreeSpace`] where every cell is solid.
pub fn automatic_start(cells: &CellMap) -> Result<Se2, WorldError> {
    let components = components(cells);
    let Some(largest) = components.largest() else { return Err(WorldError::NoFreeSpace) };
    let distances = squared_distances(cells);
    let mut best = (0, 0);
    for (index, &distance) in distances.iter().enumerate() {
        if components.labels[index] == largest && distance > best.0 {
            best = (distance, index);
        }
    }
    let at = centre(cells, best.1);
    Ok(Se2::new(at.x, at.y, 0.0))
}

/// The most open place among rings (even-odd rule, as in [`World2d::from_polygons`]), found as
/// [`automatic_start`] does on a grid of 512 cells along the longer side.
///
/// # Errors
/// [`WorldError::NoArea`] where the rings span no area, [`WorldError::NoFreeSpace`] where no cell's
/// centre is free.
pub fn automatic_start_in_rings(rings: &[Vec<Point2>]) -> Result<Se2, WorldError> {
    let points = || rings.iter().flatten();
    let low = points().fold(Point2::new(f64::INFINITY, f64::INFINITY), |low, p| low.inf(p));
    let high = points().fold(-Point2::new(f64::INFINITY, f64::INFINITY), |high, p| high.sup(p));
    let (width_m, height_m) = (high.x - low.x, high.y - low.y);
    let longer_m = width_m.max(height_m);
    let shorter_m = width_m.min(height_m);
    let finite = points().all(|p| p.x.is_finite() && p.y.is_finite()) && longer_m.is_finite();
    if !finite || shorter_m <= 0.0 {
        return Err(WorldError::NoArea { width_m, height_m });
    }
    let cell_m = longer_m / RING_CELLS as f64;
    let count = |side_m: f64| ((side_m / cell_m).ceil() as usize).clamp(1, RING_CELLS);
    let mut cells = CellMap::free(count(width_m), count(height_m), cell_m);
    cells.origin_in_world = low;
    let solid = Solid::Rings(rings.to_vec());
    for row in 0..cells.rows {
        let first = centre(&cells, row * cells.columns);
        for (column, free) in solid.free_in_row(&first, cell_m, cells.columns).iter().enumerate() {
            cells.solid[row * cells.columns + column] = !free;
        }
    }
    automatic_start(&cells)
}

/// A world of cells with the given start, else with the automatic one.
///
/// # Errors
/// As [`World2d::from_cells`], [`automatic_start`] and [`check_start`].
pub fn world_of_cells(
    name: impl Into<String>,
    cells: CellMap,
    world_from_start: Option<Se2>,
) -> Result<World2d, WorldError> {
    let expected = cells.columns.saturating_mul(cells.rows);
    if cells.solid.len() != expected {
        return Err(WorldError::CellCount { found: cells.solid.len(), expected });
    }
    let automatic = automatic_start(&cells)?;
    placed(World2d::from_cells(name, cells, automatic)?, world_from_start)
}

/// A world of rings with the given start, else with the automatic one.
///
/// # Errors
/// As [`World2d::from_polygons`], [`automatic_start_in_rings`] and [`check_start`].
pub fn world_of_rings(
    name: impl Into<String>,
    rings: Vec<Vec<Point2>>,
    world_from_start: Option<Se2>,
) -> Result<World2d, WorldError> {
    let automatic = automatic_start_in_rings(&rings)?;
    placed(World2d::from_polygons(name, rings, automatic)?, world_from_start)
}

fn placed(world: World2d, world_from_start: Option<Se2>) -> Result<World2d, WorldError> {
    let Some(start) = world_from_start else { return Ok(world) };
    check_start(&world, &start)?;
    world.with_start(start)
}

/// Checks that a robot can start there.
///
/// # Errors
/// [`WorldError::StartBlocked`] names the nearest free point, up to 10 cm off the wall where there
/// is room; [`WorldError::Parameter`] where the start is not finite.
pub fn check_start(world: &World2d, world_from_start: &Se2) -> Result<(), WorldError> {
    let at = Point2::from(world_from_start.translation);
    for (field, found) in
        [("start x", at.x), ("start y", at.y), ("start heading", world_from_start.angle())]
    {
        if !found.is_finite() {
            return Err(WorldError::Parameter { field, found, expected: "a finite number" });
        }
    }
    if world.is_free(&at) {
        return Ok(());
    }
    let free = nearest_free(world, &at).ok_or(WorldError::NoFreeSpace)?;
    Err(WorldError::StartBlocked { x_m: at.x, y_m: at.y, free_x_m: free.x, free_y_m: free.y })
}

/// A free point close behind the wall that is nearest to a solid point; O(w log w) in the walls.
fn nearest_free(world: &World2d, solid: &Point2) -> Option<Point2> {
    let nearest_on = |(a, b): &(Point2, Point2)| {
        let along = b - a;
        let share = ((solid - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        a + along * share
    };
    let mut walls: Vec<(f64, Point2)> = world
        .obstacles()
        .iter()
        .map(nearest_on)
        .map(|point| ((point - solid).norm(), point))
        .collect();
    walls.sort_by(|a, b| a.0.total_cmp(&b.0));
    let turned = |step: u32| {
        Se2::from_angle(f64::from(step) * std::f64::consts::FRAC_PI_8).rotation * Vector2::x()
    };
    walls.iter().find_map(|(distance_m, wall)| {
        // Straight through the wall where it has a far side there, else any way off it.
        let through = (*distance_m > 0.0).then(|| (wall - solid) / *distance_m);
        [0.1, 0.01, 0.001].iter().find_map(|&off_m| {
            let directions = through.into_iter().chain((0..16).map(turned));
            directions.map(|way| wall + way * off_m).find(|point| world.is_free(point))
        })
    })
}

fn centre(cells: &CellMap, index: usize) -> Point2 {
    let (column, row) = (index % cells.columns, index / cells.columns);
    cells.origin_in_world + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cells.cell_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(start: Se2) -> (f64, f64, f64) {
        (start.translation.x, start.translation.y, start.angle())
    }

    #[test]
    fn the_middle_of_the_larger_room() {
        // A wall at column 3 parts 3 x 5 cells from 5 x 5 cells of 2 m.
        let mut cells = CellMap::free(9, 5, 2.0);
        (0..5).for_each(|row| cells.solid[row * 9 + 3] = true);
        assert_eq!(automatic_start(&cells).map(at), Ok((13.0, 5.0, 0.0)));
        let world = world_of_cells("rooms", cells.clone(), Some(Se2::new(1.0, 1.0, 1.0)));
        assert_eq!(world.map(|world| at(world.world_from_start())), Ok((1.0, 1.0, 1.0)));
        cells.solid.fill(true);
        assert_eq!(automatic_start(&cells), Err(WorldError::NoFreeSpace));
    }

    #[test]
    fn a_blocked_start_names_the_nearest_free_point() {
        let mut cells = CellMap::free(10, 10, 1.0);
        (0..100).filter(|i| i % 10 >= 6).for_each(|i| cells.solid[i] = true);
        let error = world_of_cells("half", cells.clone(), Some(Se2::new(7.0, 4.5, 0.0)));
        let error = error.expect_err("solid");
        assert_eq!(
            error.to_string(),
            "the start (7 m, 4.5 m) is inside an obstacle: the nearest free point is (5.900 m, 4.500 m)"
        );
        let error = world_of_cells("half", cells.clone(), Some(Se2::new(-5.0, -5.0, 0.0)));
        let Err(WorldError::StartBlocked { free_x_m, free_y_m, .. }) = error else {
            panic!("outside")
        };
        assert!((0.0..0.2).contains(&free_x_m) && (0.0..0.2).contains(&free_y_m));
        let error = world_of_cells("half", cells, Some(Se2::new(f64::NAN, 0.0, 0.0)));
        assert!(matches!(error, Err(WorldError::Parameter { field: "start x", .. })));
    }

    #[test]
    fn rings_have_their_most_open_place() {
        let square = |x: f64, y: f64, side: f64| {
            vec![
                Point2::new(x, y),
                Point2::new(x + side, y),
                Point2::new(x + side, y + side),
                Point2::new(x, y + side),
            ]
        };
        let start = automatic_start_in_rings(&[square(-4.0, 2.0, 8.0)]).expect("free");
        assert!(start.translation.x.abs() < 0.02 && (start.translation.y - 6.0).abs() < 0.02);
        let world =
            world_of_rings("yard", vec![square(0.0, 0.0, 9.0), square(0.0, 0.0, 4.0)], None);
        let (x, y, _) = at(world.expect("free").world_from_start());
        // Farthest from both walls and the block's corner: 9 - x = (x - 4) * √2.
        assert!((x - 6.071).abs() < 0.03 && (y - 6.071).abs() < 0.03, "{x} {y}");
        assert!(automatic_start_in_rings(&[]).is_err());
        assert!(automatic_start_in_rings(&[vec![Point2::origin(); 3]]).is_err());
    }

    proptest! {
        #[test]
        fn no_free_cell_of_the_component_is_more_open(
            solid in prop::collection::vec(prop::bool::weighted(0.3), 8 * 6)
        ) {
            let cells = CellMap { solid, ..CellMap::free(8, 6, 0.5) };
            prop_assume!(cells.solid.contains(&false));
            let start = automatic_start(&cells).expect("a free cell");
            let (column, row) = cells.cell_of(&Point2::from(start.translation));
            let chosen = row as usize * 8 + column as usize;
            prop_assert!(!cells.solid[chosen]);
            let parts = components(&cells);
            let size = |label: u32| parts.labels.iter().filter(|&&other| other == label).count();
            let distances = squared_distances(&cells);
            for index in (0..48).filter(|&index| !cells.solid[index]) {
                prop_assert!(size(parts.labels[index]) <= size(parts.labels[chosen]));
                if parts.labels[index] == parts.labels[chosen] {
                    prop_assert!(distances[index] <= distances[chosen]);
                }
            }
        }
    }
}
