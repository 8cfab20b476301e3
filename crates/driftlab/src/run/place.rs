//! From the `[world]` table to a place: map files are decoded here and told apart from the truth
//! that `worlds` makes of them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use formats::{FormatError, GrayImage, map_yaml, moving_ai, pgm, png};
use geometry::Point2;
use pose::Se2;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use worlds::raster::{Raster, RasterParams, ShadeRule, cells_of_image, cells_of_tiles};
use worlds::start::{check_start, world_of_cells, world_of_rings};
use worlds::{World2d, WorldError, generate, paper, thesis};

use super::Input;
use crate::config::{
    Config, ConfigError, ImageWorld, Loaded, MapServerWorld, MovingAiWorld, PaperMap,
    PolygonsWorld, Start, ThesisMap, World, never_ends,
};

/// The random stream of the start's jitter; far from those of robots and generators.
const JITTER_STREAM: u64 = 0x2000;

/// How often a jittered start that falls into a wall is drawn again.
pub(crate) const JITTER_TRIES: usize = 1000;

/// The place of an experiment, and the files that it was read from.
#[derive(Clone, Debug)]
pub struct Place {
    /// The place, with the robot's start.
    pub world: Arc<World2d>,
    /// The map files.
    pub inputs: Vec<Input>,
    /// What the readers let pass, one line each.
    pub warnings: Vec<String>,
}

/// Builds the place that a config names.
///
/// # Errors
/// [`ConfigError`] with the line of the config, and for a broken map file the position in it.
pub fn build_place(loaded: &Loaded) -> Result<Place, ConfigError> {
    let config = loaded.anchored();
    let Some(world) = &config.world else {
        // Loading refuses a config without one.
        return Err(ConfigError::World {
            place: loaded.place(""),
            message:
                "no world, expected exactly one table under [world]; a log is for `driftlab replay`"
                    .into(),
        });
    };
    let mut files = Files::default();
    let built = build(world, &config, &mut files);
    let built = built.and_then(|world| jittered(world, &config));
    match built {
        Ok(world) => {
            check_body(&world, loaded)?;
            let Files { inputs, warnings } = files;
            Ok(Place { world: Arc::new(world), inputs, warnings })
        }
        Err(Trouble::File { path, message }) => {
            let (key, named) = world.file().unwrap_or(("world", Path::new("")));
            let place = loaded.place(key);
            // The command line names the file where the message starts: once is enough.
            let told = place.line_column.is_none() && path == named;
            let file = if told { String::new() } else { format!("{}: ", path.display()) };
            Err(ConfigError::World { place, message: format!("{file}{message}") })
        }
        Err(Trouble::World(error)) => {
            let mut message = error.to_string();
            let key = match &error {
                WorldError::OneShade { .. } => {
                    message = format!("{message}: `world.image.solid_below`");
                    format!("world.{}", world.key())
                }
                WorldError::StartNotFree { .. } | WorldError::StartBlocked { .. } => "start".into(),
                WorldError::Parameter { field, .. } if field.starts_with("start") => "start".into(),
                WorldError::Parameter { field, .. } => format!("world.{}.{field}", world.key()),
                _ => format!("world.{}", world.key()),
            };
            let place = loaded.place(&key);
            let named = world.file().filter(|_| place.line_column.is_some());
            let file = named.map_or_else(String::new, |(_, file)| format!("{}: ", file.display()));
            Err(ConfigError::World { place, message: format!("{file}{message}") })
        }
    }
}

/// How far a place is from the nearest wall, metres.
fn room_m(world: &World2d, at: &Point2) -> f64 {
    world.caster().distance_to(at)
}

/// The body has to fit where it starts.
fn check_body(world: &World2d, loaded: &Loaded) -> Result<(), ConfigError> {
    let radius_m = loaded.config.robot.radius_m;
    let at = Point2::from(world.world_from_start().translation);
    let room_m = room_m(world, &at);
    if room_m == 0.0 {
        let message = format!("the start ({:.3} m, {:.3} m) stands on a wall", at.x, at.y);
        return Err(ConfigError::World { place: loaded.place("start"), message });
    }
    if radius_m < room_m {
        return Ok(());
    }
    Err(ConfigError::Value {
        place: loaded.place("robot.radius_m"),
        found: format!("{radius_m:?} for `robot.radius_m`"),
        expected: format!(
            "below {room_m:.3}: so near to a wall is the start ({:.3} m, {:.3} m)",
            at.x, at.y
        ),
    })
}

/// Why a place could not be built.
enum Trouble {
    File { path: PathBuf, message: String },
    World(WorldError),
}

impl From<WorldError> for Trouble {
    fn from(error: WorldError) -> Self {
        Self::World(error)
    }
}

#[derive(Default)]
struct Files {
    inputs: Vec<Input>,
    warnings: Vec<String>,
}

impl Files {
    fn read(&mut self, path: &Path, expected: &str) -> Result<Vec<u8>, Trouble> {
        if never_ends(path) {
            let message = format!("is no ordinary file; expected {expected}");
            return Err(Trouble::File { path: path.to_owned(), message });
        }
        let bytes = fs::read(path).map_err(|reason| Trouble::File {
            path: path.to_owned(),
            message: format!("cannot be read ({reason}); expected {expected}"),
        })?;
        self.inputs.push(Input::new(path, &bytes));
        Ok(bytes)
    }

    fn image(&mut self, path: &Path) -> Result<GrayImage, Trouble> {
        let bytes = self.read(path, "a PGM or PNG image")?;
        let extension = path.extension().and_then(|extension| extension.to_str());
        let image = match formats::sniff(&bytes, extension) {
            formats::Kind::Png => png::read(&bytes),
            formats::Kind::Pgm => pgm::read(&bytes),
            _ => {
                let message = "found no image, expected PGM (P2, P5) or PNG".into();
                return Err(Trouble::File { path: path.to_owned(), message });
            }
        };
        image.map_err(at(path))
    }
}

fn at(path: &Path) -> impl Fn(FormatError) -> Trouble {
    let path = path.to_owned();
    move |error| Trouble::File { path: path.clone(), message: error.to_string() }
}

fn build(world: &World, config: &Config, files: &mut Files) -> Result<World2d, Trouble> {
    let start = config.start.as_ref().map(start_pose);
    match world {
        World::MapServer(world) => map_server(world, start, files),
        World::MovingAi(world) => moving_ai_map(world, start, files),
        World::Image(world) => plain_image(world, start, files),
        World::Polygons(world) => polygons(world, start),
        World::Paper(world) => with_start(
            match world.map {
                PaperMap::Open => paper::open(),
                PaperMap::Maze => paper::maze(),
                PaperMap::ForestHouse => paper::forest_house(),
            },
            start,
        ),
        World::Thesis(world) => with_start(
            match world.map {
                ThesisMap::First => thesis::first(),
                ThesisMap::Second => thesis::second(),
                ThesisMap::Third => thesis::third(),
            },
            start,
        ),
        World::Corridor(world) => with_start(generate::corridor(&world.into())?, start),
        World::Rooms(world) => with_start(generate::rooms(&world.into())?, start),
        World::Maze(world) => with_start(generate::maze(&world.into())?, start),
        World::Pillars(world) => with_start(generate::pillars(&world.into())?, start),
        World::Caves(world) => with_start(generate::caves(&world.into())?, start),
    }
}

fn start_pose(start: &Start) -> Se2 {
    Se2::new(start.x_m, start.y_m, start.heading_deg.to_radians())
}

fn with_start(world: World2d, start: Option<Se2>) -> Result<World2d, Trouble> {
    let Some(start) = start else { return Ok(world) };
    check_start(&world, &start)?;
    Ok(world.with_start(start)?)
}

/// Numbers drawn evenly from minus to plus `jitter_m`, by the stream of the start's jitter.
pub(crate) fn jitter(seed: u64, jitter_m: f64) -> impl FnMut() -> f64 {
    let mut draw = ChaCha8Rng::seed_from_u64(seed);
    draw.set_stream(JITTER_STREAM);
    move || {
        let share = (draw.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        jitter_m * (2.0 * share - 1.0)
    }
}

/// The world with its start moved by up to the jitter along each axis, to a free place.
fn jittered(world: World2d, config: &Config) -> Result<World2d, Trouble> {
    let jitter_m = config.start_jitter_m;
    if jitter_m == 0.0 {
        return Ok(world);
    }
    let mut even = jitter(config.seed, jitter_m);
    let start = world.world_from_start();
    let from = Point2::from(start.translation);
    let fits = |at: &Point2| room_m(&world, at) > config.robot.radius_m;
    let mut error = WorldError::NoFreeSpace;
    for _ in 0..JITTER_TRIES {
        let mut moved = start;
        moved.translation.x += even();
        moved.translation.y += even();
        let to = Point2::from(moved.translation);
        // A start beyond a thin wall would be in another room.
        if world.caster().blocked(&from, &to) {
            continue;
        }
        // Nor is one of use where the body does not fit, if it fits at the start itself.
        if !fits(&to) && fits(&from) {
            continue;
        }
        match world.with_start(moved) {
            Ok(world) => return Ok(world),
            Err(reason) => error = reason,
        }
    }
    Err(error.into())
}

fn map_server(
    world: &MapServerWorld,
    start: Option<Se2>,
    files: &mut Files,
) -> Result<World2d, Trouble> {
    let path = &world.yaml;
    let bytes = files.read(path, "a map_server YAML file")?;
    let yaml = formats::text(&bytes).and_then(map_yaml::read).map_err(at(path))?;
    let told = yaml.warnings.iter().map(|warning| format!("{}: {warning}", path.display()));
    files.warnings.extend(told);
    let image_path = path.parent().unwrap_or(Path::new("")).join(&yaml.image);
    let image = files.image(&image_path)?;
    let (occupied_thresh, free_thresh) = (yaml.occupied_thresh, yaml.free_thresh);
    let rule = match yaml.mode {
        map_yaml::MapMode::Raw => ShadeRule::MapServerRaw { occupied_thresh, free_thresh },
        map_yaml::MapMode::Trinary | map_yaml::MapMode::Scale => {
            ShadeRule::MapServer { occupied_thresh, free_thresh, negate: yaml.negate }
        }
    };
    let params = RasterParams {
        resolution_m: yaml.resolution_m,
        origin_in_world: Point2::new(yaml.origin[0], yaml.origin[1]),
        rule,
        unknown_is_solid: world.unknown_is_solid,
    };
    image_world(path, &image, &params, start)
}

fn plain_image(
    world: &ImageWorld,
    start: Option<Se2>,
    files: &mut Files,
) -> Result<World2d, Trouble> {
    let image = files.image(&world.file)?;
    let rule = match world.solid_below {
        Some(solid_below) => ShadeRule::Dark { solid_below },
        None => ShadeRule::Automatic,
    };
    let params = RasterParams {
        resolution_m: world.resolution_m,
        origin_in_world: Point2::origin(),
        rule,
        unknown_is_solid: world.unknown_is_solid,
    };
    image_world(&world.file, &image, &params, start)
}

fn image_world(
    path: &Path,
    image: &GrayImage,
    params: &RasterParams,
    start: Option<Se2>,
) -> Result<World2d, Trouble> {
    let shades = image.levels_u8();
    let raster = Raster {
        columns: image.columns(),
        rows: image.rows(),
        shades: &shades,
        transparent: image.transparent(),
    };
    Ok(world_of_cells(name_of(path), cells_of_image(&raster, params)?, start)?)
}

fn moving_ai_map(
    world: &MovingAiWorld,
    start: Option<Se2>,
    files: &mut Files,
) -> Result<World2d, Trouble> {
    let path = &world.file;
    let bytes = files.read(path, "a MovingAI .map file")?;
    let map = formats::text(&bytes).and_then(moving_ai::read).map_err(at(path))?;
    let cells = cells_of_tiles(map.columns, map.rows, &map.blocked(), world.cell_m)?;
    Ok(world_of_cells(name_of(path), cells, start)?)
}

fn polygons(world: &PolygonsWorld, start: Option<Se2>) -> Result<World2d, Trouble> {
    let ring = |corners: &Vec<[f64; 2]>| {
        corners.iter().map(|&[x, y]| Point2::new(x, y)).collect::<Vec<_>>()
    };
    let rings = std::iter::once(&world.outline).chain(&world.blocks).map(ring).collect();
    Ok(world_of_rings("polygons", rings, start)?)
}

fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Overrides;

    fn place(folder: &Path, text: &str) -> Result<Place, String> {
        let text = format!("{text}\n[map.grid]\n");
        let loaded = Loaded::from_text(&folder.join("a.toml"), &text, &Overrides::default());
        let loaded = loaded.unwrap_or_else(|error| panic!("{error}"));
        build_place(&loaded)
            .map_err(|error| error.to_string().replace(&folder.display().to_string(), "DIR"))
    }

    #[test]
    fn every_kind_of_world_can_be_built() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        put("a.map", "type octile\nheight 2\nwidth 3\nmap\n@..\n...\n");
        put("a.pgm", "P2 3 2 255\n0 254 254 254 254 254\n");
        put("a.yaml", "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0]\n");
        let worlds = [
            "[world.paper]\nmap = \"open\"",
            "[world.thesis]\nmap = \"third\"",
            "[world.corridor]",
            "[world.map_server]\nyaml = \"a.yaml\"",
            "[world.moving_ai]\nfile = \"a.map\"",
            "[world.image]\nfile = \"a.pgm\"\nsolid_below = 0.5",
            "[world.polygons]",
            "[world.rooms]",
            "[world.maze]",
            "[world.pillars]",
            "[world.caves]",
        ];
        for text in worlds {
            let place = place(folder.path(), text).unwrap_or_else(|error| panic!("{error}"));
            let files = text.matches("\"a.").count() + usize::from(text.contains("yaml"));
            assert_eq!(place.inputs.len(), files, "{text}");
        }
        let server = place(folder.path(), "[world.map_server]\nyaml = \"a.yaml\"").unwrap();
        assert_eq!(server.world.bounds().0, Point2::new(1.0, 2.0));
        assert!(!server.world.is_free(&Point2::new(1.2, 2.8)), "the top left pixel is black");
        assert_eq!(server.warnings.len(), 3, "{:?}", server.warnings);
    }

    #[test]
    fn what_is_wrong_with_a_map_file_is_told_with_both_places() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        put("short.map", "type octile\nheight 2\nwidth 3\nmap\n@..\n..\n");
        put("none.yaml", "image: none.pgm\nresolution: 0.5\norigin: [1, 2, 0]\n");
        put("bad.yaml", "image: none.pgm\nresolution: small\norigin: [1, 2, 0]\n");
        put("short.pgm", "P2 3 2 255\n0 254\n");
        put("gray.pgm", "P2 2 1 255\n90 90\n");
        put("full.pgm", "P2 3 1 255\n0 0 9\n");
        put("text.png", "no image");
        let mut page = String::new();
        for text in [
            "[world.moving_ai]\nfile = \"short.map\"",
            "[world.moving_ai]\nfile = \"gone.map\"",
            "[world.map_server]\nyaml = \"none.yaml\"",
            "[world.map_server]\nyaml = \"bad.yaml\"",
            "[world.image]\nfile = \"short.pgm\"",
            "[world.image]\nfile = \"gray.pgm\"",
            "[world.image]\nfile = \"full.pgm\"\nsolid_below = 0.5",
            "[world.image]\nfile = \"text.png\"",
            "[world.pillars]\ncount = 10000",
            "[start]\nx_m = 5.5\ny_m = 0.2\n[world.paper]\nmap = \"open\"",
            "[world.polygons]\noutline = [[0, 0], [1, 0], [2, 0]]",
            "[world.polygons]\noutline = [[0, 0], [1e10, 0], [0, 1e10]]",
            "[robot]\nradius_m = 2.5\n[world.paper]\nmap = \"maze\"",
            "[start]\nx_m = 1.0\ny_m = 5.0\n[world.paper]\nmap = \"open\"",
        ] {
            let error = place(folder.path(), text).unwrap_err();
            page.push_str(&format!("{text}\n--> {error}\n\n"));
        }
        insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(page) });
    }

    #[test]
    fn the_jitter_follows_the_seed_and_stays_small() {
        let start = |seed: u64| {
            let text =
                format!("seed = {seed}\nstart_jitter_m = 0.01\n[world.paper]\nmap = \"maze\"");
            let place = place(Path::new("."), &text).unwrap();
            place.world.world_from_start().translation
        };
        assert_eq!(start(1), start(1));
        assert_ne!(start(1), start(2));
        let origin = paper::maze().world_from_start().translation;
        for seed in 0..20 {
            assert!((start(seed) - origin).amax() <= 0.01);
        }
    }
}
