//! Rooms joined by doors.

use super::draw::{Draw, Stream};
use super::range::{count, in_cells, length, map_size, refuse, share};
use crate::start::world_of_cells;
use crate::{CellMap, World2d, WorldError};

/// Rooms in rows and columns; each column has a width of its own, each row a height.
#[derive(Clone, Debug, PartialEq)]
pub struct RoomsParams {
    /// Rooms along x.
    pub columns: usize,
    /// Rooms along y.
    pub rows: usize,
    /// Least inner side of a room, metres; at least `door_m`.
    pub room_min_m: f64,
    /// Greatest inner side of a room, metres; at least `room_min_m`.
    pub room_max_m: f64,
    /// Width of the doors, metres; rounded up to whole cells.
    pub door_m: f64,
    /// Thickness of the walls, metres; rounded to whole cells.
    pub wall_m: f64,
    /// Chance that two neighbours which need no door have one, 0 to 1.
    pub extra_doors: f64,
    /// Side of a cell of the map, metres.
    pub cell_m: f64,
    /// The seed.
    pub seed: u64,
}

impl Default for RoomsParams {
    fn default() -> Self {
        Self {
            columns: 4,
            rows: 3,
            room_min_m: 5.0,
            room_max_m: 9.0,
            door_m: 2.0,
            wall_m: 0.5,
            extra_doors: 0.3,
            cell_m: 0.25,
            seed: 1,
        }
    }
}

impl RoomsParams {
    /// Checks the fields and the size of the largest map that they allow.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        count("columns", self.columns)?;
        count("rows", self.rows)?;
        length("room_min_m", self.room_min_m)?;
        length("room_max_m", self.room_max_m)?;
        let good = self.room_min_m <= self.room_max_m;
        refuse(good, "room_max_m", self.room_max_m, "at least room_min_m")?;
        length("door_m", self.door_m)?;
        length("wall_m", self.wall_m)?;
        share("extra_doors", self.extra_doors)?;
        length("cell_m", self.cell_m)?;
        let period = self.room_max_cells() as f64 + self.wall_cells() as f64;
        let side = |rooms: usize| rooms as f64 * period + self.wall_cells() as f64;
        map_size(side(self.columns), side(self.rows), self.cell_m)?;
        let good = self.door_cells() <= self.room_min_cells();
        refuse(good, "door_m", self.door_m, "at most room_min_m, both in whole cells")
    }

    fn room_min_cells(&self) -> usize {
        in_cells(self.room_min_m, self.cell_m)
    }

    fn room_max_cells(&self) -> usize {
        in_cells(self.room_max_m, self.cell_m)
    }

    fn wall_cells(&self) -> usize {
        in_cells(self.wall_m, self.cell_m)
    }

    fn door_cells(&self) -> usize {
        // Less than a millionth of a cell over is rounding, not a wish for one more.
        ((self.door_m / self.cell_m - 1e-6).ceil() as usize).max(1)
    }
}

/// The rooms; the robot starts at the most open place and heads along +x.
///
/// # Errors
/// As [`RoomsParams::check`].
pub fn rooms(params: &RoomsParams) -> Result<World2d, WorldError> {
    world_of_cells("rooms", rooms_cells(params)?, None)
}

/// The cells of the rooms. Doors first join all rooms into one tree (Kruskal's algorithm over the
/// shuffled walls), then come by chance. Linear in the cells, n log n in the rooms.
///
/// # Errors
/// As [`RoomsParams::check`].
pub fn rooms_cells(params: &RoomsParams) -> Result<CellMap, WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Rooms);
    let (least, most) = (params.room_min_cells(), params.room_max_cells());
    let wall = params.wall_cells();
    let mut sides = |rooms: usize| -> Vec<(usize, usize)> {
        let mut low = wall;
        let mut side = || {
            let cells = draw.between(least, most);
            low += cells + wall;
            (low - cells - wall, cells)
        };
        (0..rooms).map(|_| side()).collect()
    };
    // First cell and count of cells of each column and row of rooms.
    let (across, upward) = (sides(params.columns), sides(params.rows));
    let total = |sides: &[(usize, usize)]| sides.last().map_or(wall, |&(low, n)| low + n + wall);
    let mut cells = CellMap::free(total(&across), total(&upward), params.cell_m);
    cells.solid.fill(true);
    let width = cells.columns;
    let mut free = |(left, columns): (usize, usize), (low, rows): (usize, usize)| {
        for row in low..low + rows {
            cells.solid[row * width + left..row * width + left + columns].fill(false);
        }
    };
    for &x in &across {
        for &y in &upward {
            free(x, y);
        }
    }
    let door = params.door_cells();
    for (room, upper) in doors(params, &mut draw) {
        let (x, y) = (across[room % params.columns], upward[room / params.columns]);
        if upper {
            free((draw.between(x.0, x.0 + x.1 - door), door), (y.0 + y.1, wall));
        } else {
            free((x.0 + x.1, wall), (draw.between(y.0, y.0 + y.1 - door), door));
        }
    }
    Ok(cells)
}

/// The walls with a door: the room left of it or below it, and whether the wall is its upper one.
fn doors(params: &RoomsParams, draw: &mut Draw) -> Vec<(usize, bool)> {
    let (columns, rooms) = (params.columns, params.columns * params.rows);
    let mut walls = Vec::new();
    for room in 0..rooms {
        if room % columns + 1 < columns {
            walls.push((room, false));
        }
        if room + columns < rooms {
            walls.push((room, true));
        }
    }
    for last in (1..walls.len()).rev() {
        walls.swap(last, draw.below(last + 1));
    }
    let mut parent: Vec<usize> = (0..rooms).collect();
    walls.retain(|&(room, upper)| {
        let other = if upper { room + columns } else { room + 1 };
        let (a, b) = (root(&mut parent, room), root(&mut parent, other));
        let chance = draw.uniform();
        parent[a] = b;
        a != b || chance < params.extra_doors
    });
    walls
}

/// The root of a room's tree; halves the way to it.
fn root(parent: &mut [usize], mut room: usize) -> usize {
    while parent[room] != room {
        parent[room] = parent[parent[room]];
        room = parent[room];
    }
    room
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::start::components;
    use proptest::prelude::*;

    #[test]
    fn bad_fields_are_named() {
        let good = RoomsParams::default();
        assert_eq!(good.check(), Ok(()));
        let fields = [
            ("columns", RoomsParams { columns: 0, ..good.clone() }),
            ("rows", RoomsParams { rows: 0, ..good.clone() }),
            ("room_min_m", RoomsParams { room_min_m: f64::NAN, ..good.clone() }),
            ("room_max_m", RoomsParams { room_max_m: 4.0, ..good.clone() }),
            ("door_m", RoomsParams { door_m: 0.0, ..good.clone() }),
            ("door_m", RoomsParams { door_m: 5.5, ..good.clone() }),
            ("wall_m", RoomsParams { wall_m: -1.0, ..good.clone() }),
            ("extra_doors", RoomsParams { extra_doors: -0.1, ..good.clone() }),
            ("cell_m", RoomsParams { cell_m: 0.0, ..good.clone() }),
            ("number of cells", RoomsParams { cell_m: 1e-6, ..good }),
        ];
        for (name, params) in fields {
            let Err(WorldError::Parameter { field, .. }) = rooms_cells(&params) else {
                panic!("{name} was let pass")
            };
            assert_eq!(field, name);
        }
    }

    fn params() -> impl Strategy<Value = RoomsParams> {
        (1..5_usize, 1..5_usize, 1..6_usize, 0..4_usize, 0..5_usize, 1..3_usize, any::<u64>())
            .prop_map(|(columns, rows, door, extra, spread, wall, seed)| RoomsParams {
                columns,
                rows,
                room_min_m: (door + extra) as f64 * 0.25,
                room_max_m: (door + extra + spread) as f64 * 0.25,
                door_m: door as f64 * 0.25,
                wall_m: wall as f64 * 0.25,
                extra_doors: 0.3,
                cell_m: 0.25,
                seed,
            })
    }

    proptest! {
        #[test]
        fn rooms_hang_together_by_doors_of_their_width(params in params()) {
            let cells = rooms_cells(&params).expect("good");
            prop_assert_eq!(&cells, &rooms_cells(&params).expect("good"));
            let world = rooms(&params).expect("good");
            prop_assert!(world.is_free(&world.world_from_start().translation.into()));
            prop_assert_eq!(components(&cells).sizes.len(), 1);
            // A robot as wide as a door reaches every room: the corners at which a square of that
            // side fits hang together too.
            let door = params.door_cells() as i64;
            let mut fits = cells.clone();
            for (index, solid) in fits.solid.iter_mut().enumerate() {
                let (column, row) = ((index % cells.columns) as i64, (index / cells.columns) as i64);
                *solid = (0..door * door)
                    .any(|step| cells.is_solid(column + step % door, row + step / door));
            }
            prop_assert_eq!(components(&fits).sizes.len(), 1);
            // Without extra doors there are just as many as a tree needs.
            let tree = RoomsParams { extra_doors: 0.0, ..params.clone() };
            let mut draw = Draw::new(params.seed, Stream::Rooms);
            prop_assert_eq!(doors(&tree, &mut draw).len(), params.columns * params.rows - 1);
        }
    }
}
