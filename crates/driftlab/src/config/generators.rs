//! Places made by rule: their tables under `[world]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use worlds::generate::{CavesParams, CorridorParams, MazeParams, PillarsParams, RoomsParams};

/// Parameters of `[world.corridor]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CorridorWorld {
    /// Outer extent from west to east, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub width_m: f64,
    /// Outer extent from south to north, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// Width of the corridor, metres; below half of either extent.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub corridor_m: f64,
}

impl Default for CorridorWorld {
    fn default() -> Self {
        let CorridorParams { width_m, height_m, corridor_m } = CorridorParams::default();
        Self { width_m, height_m, corridor_m }
    }
}

/// Parameters of `[world.rooms]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RoomsWorld {
    /// Rooms from west to east.
    #[schemars(range(min = 1, max = 10_000))]
    pub columns: u32,
    /// Rooms from south to north.
    #[schemars(range(min = 1, max = 10_000))]
    pub rows: u32,
    /// Least inner side of a room, metres; at least `door_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_min_m: f64,
    /// Greatest inner side of a room, metres; at least `room_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub room_max_m: f64,
    /// Width of the doors, metres; rounded up to whole cells.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub door_m: f64,
    /// Thickness of the walls, metres; rounded to whole cells.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub wall_m: f64,
    /// Chance that two neighbours which need no door have one.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub extra_doors: f64,
    /// Side of a cell of the drawing, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

impl Default for RoomsWorld {
    fn default() -> Self {
        let good = RoomsParams::default();
        Self {
            columns: good.columns as u32,
            rows: good.rows as u32,
            room_min_m: good.room_min_m,
            room_max_m: good.room_max_m,
            door_m: good.door_m,
            wall_m: good.wall_m,
            extra_doors: good.extra_doors,
            cell_m: good.cell_m,
            seed: good.seed,
        }
    }
}

/// Parameters of `[world.maze]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MazeWorld {
    /// Places from west to east.
    #[schemars(range(min = 1, max = 10_000))]
    pub columns: u32,
    /// Places from south to north.
    #[schemars(range(min = 1, max = 10_000))]
    pub rows: u32,
    /// Width of the corridors, metres; rounded to whole cells.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub corridor_m: f64,
    /// Thickness of the walls, metres; rounded to whole cells.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub wall_m: f64,
    /// Chance that a wall which the maze does not need is open: 0 leaves one way between any two
    /// places, 1 leaves only pillars.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub loops: f64,
    /// Side of a cell of the drawing, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

impl Default for MazeWorld {
    fn default() -> Self {
        let good = MazeParams::default();
        Self {
            columns: good.columns as u32,
            rows: good.rows as u32,
            corridor_m: good.corridor_m,
            wall_m: good.wall_m,
            loops: good.loops,
            cell_m: good.cell_m,
            seed: good.seed,
        }
    }
}

/// Parameters of `[world.pillars]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PillarsWorld {
    /// Inner extent of the hall from west to east, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub width_m: f64,
    /// Inner extent of the hall from south to north, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// How many pillars.
    #[schemars(range(max = 100_000))]
    pub count: u32,
    /// Least side or diameter of a pillar, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub size_min_m: f64,
    /// Greatest side or diameter of a pillar, metres; at least `size_min_m`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub size_max_m: f64,
    /// Least gap between two pillars, and between them and the walls, metres.
    #[schemars(range(min = 0.0))]
    pub gap_m: f64,
    /// What a pillar looks like from above.
    pub shape: Pillar,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

/// What a pillar looks like from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pillar {
    /// A square with its sides along the walls.
    Square,
    /// A square turned at random.
    Turned,
    /// A circle, drawn with 24 corners.
    Round,
    /// Each pillar has one of the other shapes.
    Mixed,
}

impl Default for PillarsWorld {
    fn default() -> Self {
        let good = PillarsParams::default();
        Self {
            width_m: good.width_m,
            height_m: good.height_m,
            count: good.count as u32,
            size_min_m: good.size_min_m,
            size_max_m: good.size_max_m,
            gap_m: good.gap_m,
            shape: Pillar::Square,
            seed: good.seed,
        }
    }
}

/// Parameters of `[world.caves]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CavesWorld {
    /// Extent from west to east, metres, the solid border included.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub width_m: f64,
    /// Extent from south to north, metres, the solid border included.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: f64,
    /// Share of cells that are solid at first; above about 0.5 the caves fall apart.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub solid_share: f64,
    /// How often the noise is smoothed.
    #[schemars(range(max = 100))]
    pub rounds: u32,
    /// Side of a cell of the drawing, metres.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
    /// Seed of the place: the robot's noise has its own.
    #[schemars(extend("maximum" = i64::MAX))]
    pub seed: u64,
}

impl Default for CavesWorld {
    fn default() -> Self {
        let good = CavesParams::default();
        Self {
            width_m: good.width_m,
            height_m: good.height_m,
            solid_share: good.solid_share,
            rounds: good.rounds as u32,
            cell_m: good.cell_m,
            seed: good.seed,
        }
    }
}
