//! A maze.

use pose::Se2;

use super::draw::{Draw, Stream};
use super::range::{count, in_cells, length, map_size, share};
use crate::{CellMap, World2d, WorldError};

/// A maze of square places with corridors between them.
#[derive(Clone, Debug, PartialEq)]
pub struct MazeParams {
    /// Places along x.
    pub columns: usize,
    /// Places along y.
    pub rows: usize,
    /// Width of the corridors, metres; rounded to whole cells.
    pub corridor_m: f64,
    /// Thickness of the walls, metres; rounded to whole cells.
    pub wall_m: f64,
    /// Chance that a wall which the maze needs not is open: 0 leaves one way between any two
    /// places, 1 leaves only pillars.
    pub loops: f64,
    /// Side of a cell of the map, metres.
    pub cell_m: f64,
    /// The seed.
    pub seed: u64,
}

impl Default for MazeParams {
    fn default() -> Self {
        Self {
            columns: 10,
            rows: 10,
            corridor_m: 3.0,
            wall_m: 0.5,
            loops: 0.0,
            cell_m: 0.5,
            seed: 1,
        }
    }
}

impl MazeParams {
    /// Checks the fields and the size of the map.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        count("columns", self.columns)?;
        count("rows", self.rows)?;
        length("corridor_m", self.corridor_m)?;
        length("wall_m", self.wall_m)?;
        share("loops", self.loops)?;
        length("cell_m", self.cell_m)?;
        let period = self.corridor_cells() as f64 + self.wall_cells() as f64;
        let wall = self.wall_cells() as f64;
        let side = |places: usize| places as f64 * period + wall;
        map_size(side(self.columns), side(self.rows), self.cell_m)
    }

    fn corridor_cells(&self) -> usize {
        in_cells(self.corridor_m, self.cell_m)
    }

    fn wall_cells(&self) -> usize {
        in_cells(self.wall_m, self.cell_m)
    }
}

/// The maze; the robot starts in the middle of the lower-left place and heads along +x.
///
/// # Errors
/// As [`MazeParams::check`].
pub fn maze(params: &MazeParams) -> Result<World2d, WorldError> {
    let cells = maze_cells(params)?;
    let low_m = params.wall_cells() as f64 * cells.cell_m;
    let middle_m = low_m + params.corridor_cells() as f64 * cells.cell_m / 2.0;
    World2d::from_cells("maze", cells, Se2::new(middle_m, middle_m, 0.0))
}

/// The cells of the maze: a random depth-first walk that opens a wall wherever it meets a new
/// place, then the extra openings. Linear in the cells, without recursion.
///
/// # Errors
/// As [`MazeParams::check`].
pub fn maze_cells(params: &MazeParams) -> Result<CellMap, WorldError> {
    params.check()?;
    let (columns, rows) = (params.columns, params.rows);
    let mut draw = Draw::new(params.seed, Stream::Maze);
    let mut openings = Openings::closed(columns * rows);
    walk(columns, rows, &mut openings, &mut draw);
    if params.loops > 0.0 {
        for place in 0..columns * rows {
            let right = place % columns + 1 < columns;
            let up = place / columns + 1 < rows;
            // Both chances are drawn for every place, so that they do not depend on the walk.
            let (try_right, try_up) = (draw.uniform(), draw.uniform());
            openings.right[place] |= right && try_right < params.loops;
            openings.up[place] |= up && try_up < params.loops;
        }
    }
    Ok(carve(params, &openings))
}

/// Which walls between neighbouring places are open.
struct Openings {
    right: Vec<bool>,
    up: Vec<bool>,
}

impl Openings {
    fn closed(places: usize) -> Self {
        Self { right: vec![false; places], up: vec![false; places] }
    }
}

fn walk(columns: usize, rows: usize, openings: &mut Openings, draw: &mut Draw) {
    let mut seen = vec![false; columns * rows];
    let mut way = vec![0];
    seen[0] = true;
    while let Some(&place) = way.last() {
        let (column, row) = (place % columns, place / columns);
        let neighbours = [
            (column + 1 < columns).then(|| place + 1),
            (row + 1 < rows).then(|| place + columns),
            (column > 0).then(|| place - 1),
            (row > 0).then(|| place - columns),
        ];
        let mut fresh = [0; 4];
        let mut found = 0;
        for neighbour in neighbours.into_iter().flatten().filter(|&neighbour| !seen[neighbour]) {
            fresh[found] = neighbour;
            found += 1;
        }
        if found == 0 {
            way.pop();
            continue;
        }
        let next = fresh[draw.below(found)];
        let lower = place.min(next);
        if place.abs_diff(next) == 1 && columns > 1 {
            openings.right[lower] = true;
        } else {
            openings.up[lower] = true;
        }
        seen[next] = true;
        way.push(next);
    }
}

fn carve(params: &MazeParams, openings: &Openings) -> CellMap {
    let (corridor, wall) = (params.corridor_cells(), params.wall_cells());
    let period = corridor + wall;
    let side = |places: usize| places * period + wall;
    let mut cells = CellMap::free(side(params.columns), side(params.rows), params.cell_m);
    cells.solid.fill(true);
    let width = cells.columns;
    let mut free = |left: usize, low: usize, columns: usize, rows: usize| {
        for row in low..low + rows {
            cells.solid[row * width + left..row * width + left + columns].fill(false);
        }
    };
    for place in 0..params.columns * params.rows {
        let left = wall + place % params.columns * period;
        let low = wall + place / params.columns * period;
        let right = if openings.right[place] { wall } else { 0 };
        free(left, low, corridor + right, corridor);
        if openings.up[place] {
            free(left, low + corridor, corridor, wall);
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::start::components;
    use proptest::prelude::*;

    #[test]
    fn large_mazes_need_no_stack() {
        let params = MazeParams { columns: 512, rows: 512, corridor_m: 0.5, ..Default::default() };
        let cells = maze_cells(&params).expect("good");
        assert_eq!((cells.columns, cells.rows), (1025, 1025));
        assert_eq!(components(&cells).sizes, [512 * 512 * 2 - 1]);
    }

    #[test]
    fn bad_fields_are_named() {
        let good = MazeParams::default();
        let fields = [
            ("columns", MazeParams { columns: 0, ..good.clone() }),
            ("rows", MazeParams { rows: 0, ..good.clone() }),
            ("corridor_m", MazeParams { corridor_m: 0.0, ..good.clone() }),
            ("wall_m", MazeParams { wall_m: f64::INFINITY, ..good.clone() }),
            ("loops", MazeParams { loops: 1.1, ..good.clone() }),
            ("cell_m", MazeParams { cell_m: -0.5, ..good.clone() }),
            ("number of cells", MazeParams { columns: usize::MAX, ..good.clone() }),
            ("number of cells", MazeParams { cell_m: 1e-300, ..good }),
        ];
        for (name, params) in fields {
            let Err(WorldError::Parameter { field, .. }) = maze_cells(&params) else {
                panic!("{name} was let pass")
            };
            assert_eq!(field, name);
        }
    }

    proptest! {
        #[test]
        fn one_way_between_any_two_places(
            columns in 1..9_usize,
            rows in 1..9_usize,
            corridor in 1..4_usize,
            wall in 1..3_usize,
            seed in any::<u64>(),
        ) {
            let params = MazeParams {
                columns,
                rows,
                corridor_m: corridor as f64 * 0.5,
                wall_m: wall as f64 * 0.5,
                seed,
                ..Default::default()
            };
            let cells = maze_cells(&params).expect("good");
            prop_assert_eq!(&cells, &maze_cells(&params).expect("good"));
            let free = cells.solid.iter().filter(|&&solid| !solid).count();
            prop_assert_eq!(components(&cells).sizes, vec![free]);
            // A tree over n places has n - 1 openings, each as wide as the corridor.
            let places = columns * rows;
            let expected = places * corridor * corridor + (places - 1) * corridor * wall;
            prop_assert_eq!(free, expected);
            prop_assert!(maze(&params).is_ok());
            let open = maze_cells(&MazeParams { loops: 1.0, ..params }).expect("good");
            let free = open.solid.iter().filter(|&&solid| !solid).count();
            let walls = columns * (rows - 1) + rows * (columns - 1);
            prop_assert_eq!(free, places * corridor * corridor + walls * corridor * wall);
        }
    }
}
