//! The place: one table under `[world]`, whose key is the kind of place.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::{CavesWorld, CorridorWorld, MazeWorld, PillarsWorld, RoomsWorld};

/// Which place the robot explores.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum World {
    /// The three maps of \[ISRR19\] fig. 5, on squared paper with cells of 1 m.
    Paper(PaperWorld),
    /// The three polygon maps of \[Zie18\].
    Thesis(ThesisWorld),
    /// A corridor that closes on itself around a block (\[Zie18\] fig. 2.15): it has no end for a
    /// robot that does not recognise places.
    Corridor(CorridorWorld),
    /// A map_server YAML file with its PGM or PNG image.
    MapServer(MapServerWorld),
    /// A grid map of the MovingAI benchmarks (`.map`).
    MovingAi(MovingAiWorld),
    /// A plain PGM or PNG image: dark is solid.
    Image(ImageWorld),
    /// Polygons written into the config.
    Polygons(PolygonsWorld),
    /// Generated from a seed: rooms in rows and columns, joined by doors.
    Rooms(RoomsWorld),
    /// Generated from a seed: a maze.
    Maze(MazeWorld),
    /// Generated from a seed: a hall with pillars.
    Pillars(PillarsWorld),
    /// Generated from a seed: caves with ragged walls.
    Caves(CavesWorld),
}

impl World {
    /// The key of the variant.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Paper(_) => "paper",
            Self::Thesis(_) => "thesis",
            Self::Corridor(_) => "corridor",
            Self::MapServer(_) => "map_server",
            Self::MovingAi(_) => "moving_ai",
            Self::Image(_) => "image",
            Self::Polygons(_) => "polygons",
            Self::Rooms(_) => "rooms",
            Self::Maze(_) => "maze",
            Self::Pillars(_) => "pillars",
            Self::Caves(_) => "caves",
        }
    }

    /// The file that the world is read from and its key in the config, as `world.image.file`.
    pub fn file(&self) -> Option<(&'static str, &Path)> {
        match self {
            Self::MapServer(world) => Some(("world.map_server.yaml", &world.yaml)),
            Self::MovingAi(world) => Some(("world.moving_ai.file", &world.file)),
            Self::Image(world) => Some(("world.image.file", &world.file)),
            _ => None,
        }
    }

    /// Puts `base` in front of a relative file name.
    pub fn anchor_file(&mut self, base: &Path) {
        let file = match self {
            Self::MapServer(world) => &mut world.yaml,
            Self::MovingAi(world) => &mut world.file,
            Self::Image(world) => &mut world.file,
            _ => return,
        };
        *file = base.join(&*file);
    }
}

/// Parameters of `[world.paper]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PaperWorld {
    /// Which of the three.
    pub map: PaperMap,
}

impl Default for PaperWorld {
    fn default() -> Self {
        Self { map: PaperMap::Maze }
    }
}

/// The maps of \[ISRR19\].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PaperMap {
    /// 30 × 30 m without a wall inside.
    Open,
    /// 31 × 31 m, one corridor that winds through six bays.
    Maze,
    /// 31 × 31 m, six pillars and a house of four rooms.
    ForestHouse,
}

/// Parameters of `[world.thesis]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ThesisWorld {
    /// Which of the three.
    pub map: ThesisMap,
}

impl Default for ThesisWorld {
    fn default() -> Self {
        Self { map: ThesisMap::First }
    }
}

/// The maps of \[Zie18\].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ThesisMap {
    /// 30 × 30 m with two square blocks.
    First,
    /// 40 × 40 m with four blocks and a triangle.
    Second,
    /// 55.5 × 43.5 m with eleven blocks, a room with two doors, and three boxes.
    Third,
}

/// Parameters of `[world.map_server]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapServerWorld {
    /// The YAML file, relative to the config; it names the image, resolution and thresholds.
    pub yaml: PathBuf,
    /// Whether unknown ground is solid.
    #[serde(default = "yes")]
    pub unknown_is_solid: bool,
}

impl Default for MapServerWorld {
    fn default() -> Self {
        Self { yaml: PathBuf::new(), unknown_is_solid: yes() }
    }
}

/// Parameters of `[world.moving_ai]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovingAiWorld {
    /// The `.map` file, relative to the config.
    pub file: PathBuf,
    /// Side of a cell, metres.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: f64,
}

impl Default for MovingAiWorld {
    fn default() -> Self {
        Self { file: PathBuf::new(), cell_m: one() }
    }
}

fn one() -> f64 {
    1.0
}

/// Parameters of `[world.image]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageWorld {
    /// The PGM or PNG file, relative to the config.
    pub file: PathBuf,
    /// Side of a pixel, metres.
    #[serde(default = "pixel_m")]
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub resolution_m: f64,
    /// A pixel darker than this share of white is solid; left out, it is told from the image: as
    /// map_server would where it looks like one of its maps, else by Otsu's threshold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub solid_below: Option<f64>,
    /// Whether unknown ground (transparent, or grey in a map_server image) is solid.
    #[serde(default = "yes")]
    pub unknown_is_solid: bool,
}

impl Default for ImageWorld {
    fn default() -> Self {
        Self {
            file: PathBuf::new(),
            resolution_m: pixel_m(),
            solid_below: None,
            unknown_is_solid: yes(),
        }
    }
}

fn pixel_m() -> f64 {
    0.05
}

fn yes() -> bool {
    true
}

/// Parameters of `[world.polygons]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PolygonsWorld {
    /// The wall around the place: corners `[x, y]` in metres, in either sense.
    #[schemars(length(min = 3))]
    #[serde(deserialize_with = "corners")]
    pub outline: Vec<[f64; 2]>,
    /// Solid blocks inside: lists of corners `[x, y]` in metres, in either sense.
    #[serde(deserialize_with = "lists_of_corners")]
    pub blocks: Vec<Vec<[f64; 2]>>,
}

fn corners<'de, D: Deserializer<'de>>(input: D) -> Result<Vec<[f64; 2]>, D::Error> {
    // A plain `[f64; 2]` would take the first two numbers of a longer list and drop the rest.
    let lists = Vec::<Vec<f64>>::deserialize(input)?;
    let pair = |list: Vec<f64>| {
        let wrong = |list: Vec<f64>| {
            let found = format!("a corner of {} numbers", list.len());
            D::Error::custom(format!("{found}, expected two numbers, [x, y]"))
        };
        list.try_into().map_err(wrong)
    };
    lists.into_iter().map(pair).collect()
}

fn lists_of_corners<'de, D: Deserializer<'de>>(input: D) -> Result<Vec<Vec<[f64; 2]>>, D::Error> {
    struct Corners(Vec<[f64; 2]>);
    impl<'de> Deserialize<'de> for Corners {
        fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
            corners(input).map(Self)
        }
    }
    let lists = Vec::<Corners>::deserialize(input)?;
    Ok(lists.into_iter().map(|list| list.0).collect())
}

impl Default for PolygonsWorld {
    fn default() -> Self {
        Self { outline: vec![[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]], blocks: vec![] }
    }
}
