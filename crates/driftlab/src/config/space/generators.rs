//! Places of space made by rule: their tables under `[world3d]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use worlds::space::{Cave3dParams, Office3dParams, Pillars3dParams, Rooms3dParams};

/// Both ways between a table and the parameters below: counts are `u32` here and `usize` there.
macro_rules! same_fields {
    ($table:ident, $params:ident, counts: [$($count:ident),*], plain: [$($plain:ident),*]) => {
        impl Default for $table {
            fn default() -> Self {
                let good = $params::default();
                Self { $($count: good.$count as u32,)* $($plain: good.$plain,)* }
            }
        }

        impl From<&$table> for $params {
            fn from(table: &$table) -> Self {
                Self { $($count: table.$count as usize,)* $($plain: table.$plain,)* }
            }
        }
    };
}

/// Parameters of `[world3d.rooms]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rooms3dWorld {
    /// Rooms along the corridor, on each side.
    #[schemars(range(min = 1, max = 64))]
    pub columns: u32,
    /// Least inner side of a room, metres; at least `door_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_min_m: f64,
    /// Greatest inner side of a room, metres; at least `room_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_max_m: f64,
    /// Height of the rooms, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// Width of the corridor, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub corridor_m: f64,
    /// Thickness of the walls, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub wall_m: f64,
    /// Width of the doors, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub door_m: f64,
    /// Height of the doors, metres; at most `height_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub door_height_m: f64,
    /// At least so many doors between neighbouring rooms; each closes a loop.
    #[schemars(range(max = 64))]
    pub loops: u32,
    /// Chance of a window between neighbours without a door, and to the corridor.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub windows: f64,
    /// Blocks of furniture in each room.
    #[schemars(range(max = 64))]
    pub furniture: u32,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

same_fields!(
    Rooms3dWorld,
    Rooms3dParams,
    counts: [columns, loops, furniture],
    plain: [
        room_min_m, room_max_m, height_m, corridor_m, wall_m, door_m, door_height_m, windows, seed
    ]
);

/// Parameters of `[world3d.office]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Office3dWorld {
    /// Number of storeys.
    #[schemars(range(min = 1, max = 32))]
    pub storeys: u32,
    /// Rooms on each storey.
    #[schemars(range(min = 1, max = 64))]
    pub rooms: u32,
    /// Least width of a room along the corridor, metres; at least `door_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_min_m: f64,
    /// Greatest width of a room along the corridor, metres; at least `room_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_max_m: f64,
    /// Depth of the rooms, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_depth_m: f64,
    /// Height of a storey inside, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// Thickness of the slabs between storeys, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub slab_m: f64,
    /// Width of the corridors, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub corridor_m: f64,
    /// Width of the stairwells, metres: stairs in one half, a landing in the other.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub stairwell_m: f64,
    /// Steps of one flight of stairs.
    #[schemars(range(min = 1, max = 100))]
    pub steps: u32,
    /// Thickness of the walls, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub wall_m: f64,
    /// Width of the doors, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub door_m: f64,
    /// Height of the doors, metres; at most `height_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub door_height_m: f64,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

same_fields!(
    Office3dWorld,
    Office3dParams,
    counts: [storeys, rooms, steps],
    plain: [
        room_min_m, room_max_m, room_depth_m, height_m, slab_m, corridor_m, stairwell_m, wall_m,
        door_m, door_height_m, seed
    ]
);

/// Parameters of `[world3d.pillars]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Pillars3dWorld {
    /// Inner side from west to east, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub width_m: f64,
    /// Inner side from south to north, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub depth_m: f64,
    /// Height, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// Pillars and stumps together.
    #[schemars(range(max = 10_000))]
    pub pillars: u32,
    /// Share of them that are stumps, which one can fly over.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub stumps: f64,
    /// Least radius, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius_min_m: f64,
    /// Greatest radius, metres; at least `radius_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius_max_m: f64,
    /// Least gap between two of them, and to the walls, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub gap_m: f64,
    /// Sides of each.
    #[schemars(range(min = 3, max = 64))]
    pub sides: u32,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

same_fields!(
    Pillars3dWorld,
    Pillars3dParams,
    counts: [pillars, sides],
    plain: [width_m, depth_m, height_m, stumps, radius_min_m, radius_max_m, gap_m, seed]
);

/// Parameters of `[world3d.cave]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Cave3dWorld {
    /// Number of chambers; three and more close a loop.
    #[schemars(range(min = 1, max = 64))]
    pub chambers: u32,
    /// Radius of the ring on which they lie, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub ring_m: f64,
    /// Least half-width of a chamber, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub chamber_min_m: f64,
    /// Greatest half-width of a chamber, metres; at least `chamber_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub chamber_max_m: f64,
    /// Height of a chamber as a share of its width.
    #[schemars(range(max = 100.0), extend("exclusiveMinimum" = 0.0))]
    pub flatness: f64,
    /// Radius of the tunnels, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub tunnel_m: f64,
    /// How far chambers lie above and below each other, metres.
    #[schemars(range(min = 0.0))]
    pub rise_m: f64,
    /// How uneven the walls are, metres; below half of `tunnel_m`.
    #[schemars(range(min = 0.0))]
    pub unevenness_m: f64,
    /// Side of the lattice that cuts the walls into triangles, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

same_fields!(
    Cave3dWorld,
    Cave3dParams,
    counts: [chambers],
    plain: [
        ring_m, chamber_min_m, chamber_max_m, flatness, tunnel_m, rise_m, unevenness_m, cell_m, seed
    ]
);
