//! The three places of the paper's experiments (\[ISRR19\] fig. 6 to 8, sec. 6), as recovered from
//! its vector figures.
//!
//! All have 1 m cells and a border of solid cells one cell wide. The starts of `open` and `maze`
//! make the first scan see as many cells as the paper's did (38 and 22). The start of
//! `forest_house` is lost; ours sees 31 cells at first, the paper's saw 30.
//!
//! Which way the robot faces at first is not told. In the maze the first scan sees 22 cells to the
//! right as to the left, but the one dead end lies to the left: who starts to the right has to come
//! back for it at the end, 250 m at the very least, and the paper's grid without drift drove 226 m.

use pose::Se2;

use crate::{CellMap, World2d};

/// Names of the paper's places, as [`by_name`] takes them.
pub const NAMES: [&str; 3] = ["open", "maze", "forest_house"];

/// The place of that name, one of [`NAMES`].
pub fn by_name(name: &str) -> Option<World2d> {
    match name {
        "open" => Some(open()),
        "maze" => Some(maze()),
        "forest_house" => Some(forest_house()),
        _ => None,
    }
}

/// An empty room of 28 m by 28 m: 784 free cells.
pub fn open() -> World2d {
    build("open", Drawing::bordered(30), Se2::new(7.5, 7.5, 0.0))
}

/// Five walls, each with a gap at one end, on the right and on the left in turn: 716 free cells.
pub fn maze() -> World2d {
    let mut drawing = Drawing::bordered(31);
    for row in [5, 15, 25] {
        drawing.fill(row, row, 0, 25);
    }
    for row in [10, 20] {
        drawing.fill(row, row, 5, 30);
    }
    build("maze", drawing, Se2::new(15.1, 3.1, std::f64::consts::PI))
}

/// Six pillars, and a house of three rooms in the lower right: 770 free cells.
pub fn forest_house() -> World2d {
    let mut drawing = Drawing::bordered(31);
    for (row, column) in [(5, 4), (5, 19), (7, 10), (14, 7), (22, 4), (25, 9)] {
        drawing.fill(row, row + 1, column, column + 1);
    }
    drawing.fill(13, 13, 14, 20);
    drawing.fill(13, 13, 24, 30);
    drawing.fill(13, 29, 14, 14);
    drawing.fill(20, 20, 14, 16);
    drawing.fill(20, 20, 20, 24);
    drawing.fill(20, 20, 28, 30);
    drawing.fill(20, 29, 22, 22);
    build("forest_house", drawing, Se2::new(7.5, 7.5, 0.0))
}

/// A square drawing with rows from the top, as the paper's figures have them.
struct Drawing {
    size: usize,
    cells: CellMap,
}

impl Drawing {
    fn bordered(size: usize) -> Self {
        let mut drawing = Self { size, cells: CellMap::free(size, size, 1.0) };
        let last = size - 1;
        drawing.fill(0, 0, 0, last);
        drawing.fill(last, last, 0, last);
        drawing.fill(0, last, 0, 0);
        drawing.fill(0, last, last, last);
        drawing
    }

    /// Fills the cells of rows `top..=bottom` and columns `left..=right`.
    fn fill(&mut self, top: usize, bottom: usize, left: usize, right: usize) {
        for row in top..=bottom {
            for column in left..=right {
                self.cells.solid[(self.size - 1 - row) * self.size + column] = true;
            }
        }
    }
}

fn build(name: &str, drawing: Drawing, world_from_start: Se2) -> World2d {
    World2d::from_cells(name, drawing.cells, world_from_start)
        .expect("the paper's drawings are full and their starts are free")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Solid;

    #[test]
    fn free_cells_are_as_many_as_in_the_paper() {
        for (world, expected) in [(open(), 784), (maze(), 716), (forest_house(), 770)] {
            let Solid::Cells(cells) = world.solid() else { panic!("drawn as cells") };
            let free = cells.solid.iter().filter(|&&solid| !solid).count();
            assert_eq!(free, expected, "{}", world.name());
        }
    }

    #[test]
    fn every_name_has_its_place() {
        for name in NAMES {
            assert_eq!(by_name(name).map(|world| world.name().to_owned()).as_deref(), Some(name));
        }
        assert!(by_name("Maze").is_none());
    }
}
