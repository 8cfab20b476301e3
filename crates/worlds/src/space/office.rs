//! Storeys over each other, joined by stairs at both ends.

use geometry::Point3;

use super::World3d;
use super::blocks::Blocks;
use crate::WorldError;
use crate::generate::draw::{Draw, Stream};
use crate::generate::range::{count, length, refuse};

/// An office of several storeys: on each a corridor with rooms along one side, and a stairwell at each
/// end, so that every two storeys close a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Office3dParams {
    /// Number of storeys.
    pub storeys: usize,
    /// Rooms on each storey.
    pub rooms: usize,
    /// Least width of a room along the corridor, metres.
    pub room_min_m: f64,
    /// Greatest width of a room along the corridor, metres.
    pub room_max_m: f64,
    /// Depth of the rooms, metres.
    pub room_depth_m: f64,
    /// Height of a storey inside, metres.
    pub height_m: f64,
    /// Thickness of the slabs between storeys, metres.
    pub slab_m: f64,
    /// Width of the corridors, metres.
    pub corridor_m: f64,
    /// Width of the stairwells, metres: stairs in one half, a landing in the other.
    pub stairwell_m: f64,
    /// Steps of one flight of stairs.
    pub steps: usize,
    /// Thickness of the walls, metres.
    pub wall_m: f64,
    /// Width of the doors, metres.
    pub door_m: f64,
    /// Height of the doors, metres.
    pub door_height_m: f64,
    /// The seed.
    pub seed: u64,
}

impl Default for Office3dParams {
    /// Two storeys with three rooms each, about 600 m³.
    fn default() -> Self {
        Self {
            storeys: 2,
            rooms: 3,
            room_min_m: 3.8,
            room_max_m: 4.6,
            room_depth_m: 4.5,
            height_m: 2.8,
            slab_m: 0.3,
            corridor_m: 2.0,
            stairwell_m: 3.2,
            steps: 10,
            wall_m: 0.3,
            door_m: 1.2,
            door_height_m: 2.2,
            seed: 1,
        }
    }
}

impl Office3dParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        count("storeys", self.storeys)?;
        refuse(self.storeys <= 32, "storeys", self.storeys as f64, "1 to 32")?;
        count("rooms", self.rooms)?;
        refuse(self.rooms <= 64, "rooms", self.rooms as f64, "1 to 64")?;
        count("steps", self.steps)?;
        refuse(self.steps <= 100, "steps", self.steps as f64, "1 to 100")?;
        length("room_min_m", self.room_min_m)?;
        length("room_max_m", self.room_max_m)?;
        let good = self.room_min_m <= self.room_max_m && self.room_max_m <= 1e3;
        refuse(good, "room_max_m", self.room_max_m, "at least room_min_m, at most 1000 m")?;
        length("room_depth_m", self.room_depth_m)?;
        length("height_m", self.height_m)?;
        length("slab_m", self.slab_m)?;
        length("corridor_m", self.corridor_m)?;
        length("stairwell_m", self.stairwell_m)?;
        length("wall_m", self.wall_m)?;
        length("door_m", self.door_m)?;
        refuse(self.door_m <= self.room_min_m, "door_m", self.door_m, "at most room_min_m")?;
        length("door_height_m", self.door_height_m)?;
        let good = self.door_height_m <= self.height_m;
        refuse(good, "door_height_m", self.door_height_m, "at most height_m")
    }
}

/// The office; the robot starts in the middle of the lowest corridor, halfway up, and heads along it.
///
/// # Errors
/// As [`Office3dParams::check`].
pub fn office(params: &Office3dParams) -> Result<World3d, WorldError> {
    let (blocks, start) = blocks_of(params)?;
    let (vertices, triangles) = blocks.border();
    World3d::from_mesh("office", vertices, triangles, Some((start, 0.0)))
}

fn blocks_of(params: &Office3dParams) -> Result<(Blocks, Point3), WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Office3d);
    let mut blocks = Blocks::default();
    let (wall, height, corridor) = (params.wall_m, params.height_m, params.corridor_m);
    let storey_m = height + params.slab_m;
    let widths: Vec<f64> = (0..params.rooms)
        .map(|_| draw.uniform_between(params.room_min_m, params.room_max_m))
        .collect();
    // The corridor spans the rooms; the stairwells lie beyond its ends, as deep as corridor and rooms.
    let (left, right) = (0.0, widths.iter().sum::<f64>() + wall * (params.rooms - 1) as f64);
    let depth = corridor + wall + params.room_depth_m;
    let wells = [(left - params.stairwell_m, left), (right, right + params.stairwell_m)];
    for storey in 0..params.storeys {
        let floor = storey as f64 * storey_m;
        blocks.carve([wells[0].0, 0.0, floor], [wells[1].1, corridor, floor + height]);
        for (x0, x1) in wells {
            blocks.carve([x0, 0.0, floor], [x1, depth, floor + height]);
        }
        let mut x = left;
        for (room, width) in widths.iter().enumerate() {
            let (y0, y1) = (corridor + wall, depth);
            blocks.carve([x, y0, floor], [x + width, y1, floor + height]);
            let door = x + (width - params.door_m) * draw.uniform_between(0.15, 0.85);
            let top = floor + params.door_height_m;
            blocks.carve([door, corridor, floor], [door + params.door_m, y0, top]);
            // A window to the neighbour, now and then.
            let chance = draw.uniform();
            let at = y0 + (params.room_depth_m - params.door_m) * draw.uniform_between(0.2, 0.8);
            if room + 1 < params.rooms && chance < 0.5 {
                let (sill, lintel) = (floor + 0.35 * height, floor + 0.75 * height);
                blocks.carve([x + width, at, sill], [x + width + wall, at + params.door_m, lintel]);
            }
            x += width + wall;
        }
    }
    for lower in 1..params.storeys {
        for (x0, x1) in wells {
            stairs(&mut blocks, params, (lower - 1, x0, x1, depth), storey_m);
        }
    }
    Ok((blocks, Point3::new(0.5 * (left + right), 0.5 * corridor, 0.5 * height)))
}

/// One flight of stairs in one half of a stairwell, and the hole in the slab above it. The halves
/// alternate from storey to storey, so that no stairs stand on a hole.
fn stairs(
    blocks: &mut Blocks,
    params: &Office3dParams,
    (storey, x0, x1, depth): (usize, f64, f64, f64),
    storey_m: f64,
) {
    let floor = storey as f64 * storey_m;
    let middle = 0.5 * (x0 + x1);
    let (x0, x1) = if storey.is_multiple_of(2) { (x0, middle) } else { (middle, x1) };
    // The stairs begin before the rooms and leave a landing at the far end.
    let (first, last) = (0.5 * params.corridor_m, depth - 1.0_f64.min(0.2 * depth));
    let (rise, run) = (storey_m / params.steps as f64, (last - first) / params.steps as f64);
    blocks.carve([x0, first, floor + params.height_m], [x1, last, floor + storey_m]);
    // The last step is the floor above.
    for step in 1..params.steps {
        let y = first + run * step as f64;
        blocks.fill([x0, y, floor], [x1, y + run, floor + rise * step as f64]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn storeys_are_joined_by_the_holes_of_the_stairs() {
        for seed in 0..10 {
            let params = Office3dParams { seed, storeys: 3, ..Office3dParams::default() };
            let (blocks, _) = blocks_of(&params).expect("good");
            assert!(blocks.free_m3() > 600.0, "{}", blocks.free_m3());
            let world = office(&params).expect("good");
            let storey_m = params.height_m + params.slab_m;
            // Straight up through the hole, one half of the well; blocked in the other half.
            let well_x = -0.75 * params.stairwell_m;
            let up = |x: f64| {
                let from = Point3::new(x, 3.0, 2.6);
                world.caster().blocked(&from, &Point3::new(x, 3.0, storey_m + 0.4))
            };
            assert!(!up(well_x), "seed {seed}");
            assert!(up(well_x + 0.5 * params.stairwell_m), "seed {seed}");
        }
        let two = blocks_of(&Office3dParams::default()).expect("good").0;
        assert!(two.free_m3() > 400.0);
    }
}
