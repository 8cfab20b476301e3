//! Rooms on both sides of a corridor.

use geometry::Point3;

use super::World3d;
use super::blocks::Blocks;
use crate::WorldError;
use crate::generate::draw::{Draw, Stream};
use crate::generate::range::{count, length, refuse, share};

/// Two rows of rooms with a corridor between them, one storey.
///
/// Each room has a door to the corridor; neighbours are joined by doors too, at least as many as asked
/// for, so that the place has loops; other neighbours may see each other through windows without glass.
#[derive(Clone, Debug, PartialEq)]
pub struct Rooms3dParams {
    /// Rooms along the corridor, on each side.
    pub columns: usize,
    /// Least inner side of a room, metres.
    pub room_min_m: f64,
    /// Greatest inner side of a room, metres; at least `room_min_m`.
    pub room_max_m: f64,
    /// Height of the rooms, metres.
    pub height_m: f64,
    /// Width of the corridor, metres.
    pub corridor_m: f64,
    /// Thickness of the walls, metres.
    pub wall_m: f64,
    /// Width of the doors, metres; at most `room_min_m`.
    pub door_m: f64,
    /// Height of the doors, metres; at most `height_m`.
    pub door_height_m: f64,
    /// At least so many doors between neighbouring rooms; each closes a loop.
    pub loops: usize,
    /// Chance of a window between neighbours without a door, and to the corridor, 0 to 1.
    pub windows: f64,
    /// Blocks of furniture in each room.
    pub furniture: usize,
    /// The seed.
    pub seed: u64,
}

impl Default for Rooms3dParams {
    /// Six rooms and a corridor, about 450 m³.
    fn default() -> Self {
        Self {
            columns: 3,
            room_min_m: 4.5,
            room_max_m: 5.5,
            height_m: 2.8,
            corridor_m: 2.0,
            wall_m: 0.3,
            door_m: 1.2,
            door_height_m: 2.2,
            loops: 2,
            windows: 0.5,
            furniture: 1,
            seed: 1,
        }
    }
}

impl Rooms3dParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        count("columns", self.columns)?;
        refuse(self.columns <= 64, "columns", self.columns as f64, "1 to 64")?;
        length("room_min_m", self.room_min_m)?;
        length("room_max_m", self.room_max_m)?;
        let good = self.room_min_m <= self.room_max_m && self.room_max_m <= 1e3;
        refuse(good, "room_max_m", self.room_max_m, "at least room_min_m, at most 1000 m")?;
        length("height_m", self.height_m)?;
        length("corridor_m", self.corridor_m)?;
        length("wall_m", self.wall_m)?;
        length("door_m", self.door_m)?;
        refuse(self.door_m <= self.room_min_m, "door_m", self.door_m, "at most room_min_m")?;
        length("door_height_m", self.door_height_m)?;
        let good = self.door_height_m <= self.height_m;
        refuse(good, "door_height_m", self.door_height_m, "at most height_m")?;
        refuse(self.furniture <= 64, "furniture", self.furniture as f64, "0 to 64")?;
        share("windows", self.windows)
    }
}

/// The rooms; the robot starts in the middle of the corridor, halfway up, and heads along it.
///
/// # Errors
/// As [`Rooms3dParams::check`].
pub fn rooms(params: &Rooms3dParams) -> Result<World3d, WorldError> {
    let (blocks, start) = blocks_of(params)?;
    let (vertices, triangles) = blocks.border();
    World3d::from_mesh("rooms", vertices, triangles, Some((start, 0.0)))
}

fn blocks_of(params: &Rooms3dParams) -> Result<(Blocks, Point3), WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Rooms3d);
    let mut blocks = Blocks::default();
    let (wall, height) = (params.wall_m, params.height_m);
    let mut side = || draw.uniform_between(params.room_min_m, params.room_max_m);
    let depths = [side(), side()];
    let widths: Vec<f64> = (0..params.columns).map(|_| side()).collect();
    let lefts: Vec<f64> = widths
        .iter()
        .scan(0.0, |left, width| {
            let at = *left;
            *left += width + wall;
            Some(at)
        })
        .collect();
    let end = lefts[params.columns - 1] + widths[params.columns - 1];
    // y of the low and the high side of the corridor.
    let (low, high) = (depths[0] + wall, depths[0] + wall + params.corridor_m);
    blocks.carve([0.0, low, 0.0], [end, high, height]);
    let rows = [
        (0.0, depths[0], depths[0], low),
        (high + wall, high + wall + depths[1], high, high + wall),
    ];
    let (sill, lintel) = (0.35 * height, 0.75 * height);
    let mut neighbours: Vec<(usize, usize)> = Vec::new();
    for (row, &(y0, y1, door0, door1)) in rows.iter().enumerate() {
        for (column, (&x0, &width)) in lefts.iter().zip(&widths).enumerate() {
            blocks.carve([x0, y0, 0.0], [x0 + width, y1, height]);
            let margin = width - params.door_m;
            let door = x0 + margin * draw.uniform_between(0.15, 0.85);
            blocks.carve([door, door0, 0.0], [door + params.door_m, door1, params.door_height_m]);
            if column + 1 < params.columns {
                neighbours.push((row, column));
            }
        }
    }
    // Which neighbours get a door: so many by a shuffle, the others maybe a window.
    for i in (1..neighbours.len()).rev() {
        neighbours.swap(i, draw.below(i + 1));
    }
    for (i, &(row, column)) in neighbours.iter().enumerate() {
        let (y0, y1, _, _) = rows[row];
        let (x0, x1) = (lefts[column] + widths[column], lefts[column + 1]);
        let at = y0 + (y1 - y0 - params.door_m) * draw.uniform_between(0.15, 0.85);
        let chance = draw.uniform();
        if i < params.loops {
            blocks.carve([x0, at, 0.0], [x1, at + params.door_m, params.door_height_m]);
        } else if chance < params.windows {
            blocks.carve([x0, at, sill], [x1, at + params.door_m, lintel]);
        }
    }
    furnish(&mut blocks, &mut draw, params, &rows, (&lefts, &widths));
    Ok((blocks, Point3::new(0.5 * end, 0.5 * (low + high), 0.5 * height)))
}

/// Blocks on the floor, well away from all walls, so that a robot gets around each.
fn furnish(
    blocks: &mut Blocks,
    draw: &mut Draw,
    params: &Rooms3dParams,
    rows: &[(f64, f64, f64, f64); 2],
    (lefts, widths): (&[f64], &[f64]),
) {
    let gap = 1.2 * params.door_m;
    for &(y0, y1, _, _) in rows {
        for (&x0, &width) in lefts.iter().zip(widths) {
            for _ in 0..params.furniture {
                let size = [
                    draw.uniform_between(0.6, 1.2),
                    draw.uniform_between(0.6, 1.2),
                    draw.uniform_between(0.2, 0.45) * params.height_m,
                ];
                let (room_x, room_y) = (width - size[0] - 2.0 * gap, y1 - y0 - size[1] - 2.0 * gap);
                let (u, v) = (draw.uniform(), draw.uniform());
                if room_x > 0.0 && room_y > 0.0 {
                    let (x, y) = (x0 + gap + u * room_x, y0 + gap + v * room_y);
                    blocks.fill([x, y, 0.0], [x + size[0], y + size[1], size[2]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_as_large_as_told_and_the_same_for_the_same_seed() {
        for seed in 0..20 {
            let params = Rooms3dParams { seed, ..Rooms3dParams::default() };
            let (blocks, _) = blocks_of(&params).expect("good");
            assert!(blocks.free_m3() > 400.0, "seed {seed}: {}", blocks.free_m3());
            let (a, b) = (rooms(&params).expect("good"), rooms(&params).expect("good"));
            assert_eq!((a.vertices(), a.triangles()), (b.vertices(), b.triangles()));
            let start = Point3::from(a.world_from_start().translation);
            assert!(a.caster().distance_to(&start) > 0.9);
        }
        let bad = Rooms3dParams { door_m: 9.0, ..Rooms3dParams::default() };
        assert!(matches!(rooms(&bad), Err(WorldError::Parameter { field: "door_m", .. })));
    }
}
