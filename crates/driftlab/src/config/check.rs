//! Values that parse but make no sense: the ranges of the schema, and rules between keys.

use serde_json::Value as Json;
use toml::Value;
use worlds::WorldError;
use worlds::generate::{CavesParams, CorridorParams, MazeParams, PillarsParams, RoomsParams};

use super::document::join;
use super::load::properties_of;
use super::schema::{properties, resolved, schema};
use super::{Config, PolygonsWorld, World, reach, space};

/// A value outside what its key allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// Dotted path of the key.
    pub(super) path: String,
    pub(super) found: String,
    pub(super) expected: String,
}

/// Everything that is wrong with the values of a config, in no order.
pub(super) fn faults(config: &Config) -> Vec<Fault> {
    let mut faults = Vec::new();
    if i64::try_from(config.seed).is_ok() {
        match Value::try_from(config) {
            Ok(value) => in_range(&value, schema(), "", &mut faults),
            Err(error) => faults.push(fault("", error.to_string(), "a config".into())),
        }
    } else {
        faults.push(fault("seed", config.seed.to_string(), format!("at most {}", i64::MAX)));
    }
    between_keys(config, &mut faults);
    if !config.is_of_space() {
        faults.extend(reach::faults(config));
    }
    faults
}

pub(super) fn fault(path: &str, found: String, expected: String) -> Fault {
    Fault { path: path.to_owned(), found, expected }
}

fn in_range(value: &Value, node: &'static Json, path: &str, faults: &mut Vec<Fault>) {
    let limits = node;
    let node = resolved(node);
    match value {
        Value::Table(table) => {
            let known = properties(node);
            for (key, inner) in table {
                if let Some(property) = known.iter().find(|property| property.key == key) {
                    in_range(inner, property.node, &join(path, key), faults);
                }
            }
        }
        Value::Array(items) => {
            let least = node["minItems"].as_u64().unwrap_or(0);
            if (items.len() as u64) < least {
                let expected = format!("at least {least} of them");
                faults.push(fault(path, format!("{} entries", items.len()), expected));
            }
            let Some(child) = node.get("items") else { return };
            // The whole list is named: an entry has no key of its own.
            items.iter().for_each(|item| in_range(item, child, path, faults));
        }
        Value::Integer(number) => {
            limited(*number as f64, &number.to_string(), limits, path, faults)
        }
        Value::Float(number) => limited(*number, &format!("{number:?}"), limits, path, faults),
        _ => {}
    }
}

fn limited(number: f64, shown: &str, node: &'static Json, path: &str, faults: &mut Vec<Fault>) {
    let limit = |key: &str| node.get(key).and_then(Json::as_f64);
    let (least, above) = (limit("minimum"), limit("exclusiveMinimum"));
    let most = limit("maximum");
    let fits = number.is_finite()
        && least.is_none_or(|least| number >= least)
        && above.is_none_or(|above| number > above)
        && most.is_none_or(|most| number <= most);
    if fits {
        return;
    }
    let mut words = Vec::new();
    if let (Some(least), Some(most)) = (least, most)
        && least == most
    {
        faults.push(fault(path, shown.to_owned(), least.to_string()));
        return;
    }
    if let Some(above) = above {
        words.push(format!("above {above}"));
    } else if let Some(least) = least {
        words.push(format!("of at least {least}"));
    }
    if let Some(most) = most {
        words.push(format!("at most {most}"));
    }
    let expected = if words.is_empty() {
        "a finite number".to_owned()
    } else {
        format!("a number {}", words.join(" and "))
    };
    faults.push(fault(path, shown.to_owned(), expected));
}

/// Keys that no sweep varies.
const NO_AXES: [&str; 4] = ["name", "schema", "seed", "sweep"];

fn first_key(path: &str) -> &str {
    path.split('.').next().unwrap_or(path)
}

fn between_keys(config: &Config, faults: &mut Vec<Fault>) {
    if !is_folder_name(&config.name) {
        faults.push(fault("name", format!("{:?}", config.name), FOLDER_NAME.into()));
    }
    let maps = config.map_keys();
    if maps.is_empty() {
        let table = if config.is_of_space() { "map3d" } else { "map" };
        let kinds = properties_of(table).join(", ");
        faults.push(fault(table, "no map".into(), format!("at least one table of {kinds}")));
    }
    let drive = config.compare.drive.as_str();
    if drive != "each" && !maps.contains(&drive) {
        let names: Vec<String> = maps.iter().map(|key| format!("\"{key}\"")).collect();
        let expected = format!("\"each\" or a map of this config: {}", names.join(", "));
        faults.push(fault("compare.drive", format!("{drive:?}"), expected));
    }
    let (world, has_world) = match config.is_of_space() {
        true => ("world3d", config.world3d.is_some() || config.replay3d.is_some()),
        false => ("world", config.world.is_some() || config.replay.is_some()),
    };
    if !has_world {
        let kinds = properties_of(world).join(", ");
        faults.push(fault("", "no world".into(), format!("exactly one table of {kinds}")));
    }
    let axes = config.sweep.iter().flat_map(|sweep| sweep.axes.iter());
    for (axis, _) in axes.filter(|(axis, _)| NO_AXES.contains(&first_key(axis))) {
        let found = format!("the axis `{axis}`");
        let expected = "a key that makes a difference; seeds are counted up by `sweep.seeds`";
        faults.push(fault(&join("sweep.axes", axis), found, expected.into()));
    }
    if let (Some([columns, rows]), Some(_)) = (config.metrics.grid, config.metrics.cell_m) {
        let found = format!("[{columns}, {rows}] beside `metrics.cell_m`");
        faults.push(fault("metrics.grid", found, "one of the two".into()));
    }
    if config.is_of_space() {
        space::faults(config, faults);
    }
    let generator = config.world.as_ref().map(check_generator);
    if let Some((key, Err(WorldError::Parameter { field, found, expected }))) = generator {
        let path = join(key, field);
        // What the range of the key itself refuses is told with that range.
        if !faults.iter().any(|fault| fault.path == path) {
            faults.push(fault(&path, found.to_string(), expected.into()));
        }
    }
    if let Some(World::Polygons(world)) = &config.world {
        blocks(world, faults);
    }
}

/// Blocks have an area, and lie in the place: what reaches beyond the wall would open ground there.
fn blocks(world: &PolygonsWorld, faults: &mut Vec<Fault>) {
    let path = "world.polygons.blocks";
    if let Some(block) = world.blocks.iter().find(|block| block.len() < 3) {
        let found = format!("a block of {} corners", block.len());
        faults.push(fault(path, found, "3 corners or more".into()));
    }
    let extent = |axis: usize| {
        let all = || world.outline.iter().map(move |corner| corner[axis]);
        (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max))
    };
    let extents = [extent(0), extent(1)];
    let is_out = |corner: &&[f64; 2]| {
        extents.iter().zip(corner.iter()).any(|((least, most), x)| x < least || x > most)
    };
    if let Some([x, y]) = world.blocks.iter().flatten().find(is_out) {
        let expected = "corners within the extent of `world.polygons.outline`";
        faults.push(fault(path, format!("the corner [{x}, {y}]"), expected.into()));
    }
}

/// The key of a generated world, and whether its values go together.
fn check_generator(world: &World) -> (&'static str, Result<(), WorldError>) {
    match world {
        World::Corridor(world) => ("world.corridor", CorridorParams::from(world).check()),
        World::Rooms(world) => ("world.rooms", RoomsParams::from(world).check()),
        World::Maze(world) => ("world.maze", MazeParams::from(world).check()),
        World::Pillars(world) => ("world.pillars", PillarsParams::from(world).check()),
        World::Caves(world) => ("world.caves", CavesParams::from(world).check()),
        _ => ("world", Ok(())),
    }
}

/// What [`is_folder_name`] expects.
pub(super) const FOLDER_NAME: &str =
    "letters, digits, `.`, `_` or `-`, not starting with `.` or `-`";

/// Whether a name can be a folder of its own on every system.
pub(super) fn is_folder_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
    !name.is_empty() && name.chars().all(plain) && !name.starts_with(['.', '-'])
}

#[cfg(test)]
mod tests {
    use super::super::{MazeWorld, PaperWorld, RelativeMap};
    use super::*;

    fn good() -> Config {
        let mut config =
            Config { world: Some(World::Paper(PaperWorld::default())), ..Config::default() };
        config.map.relative = Some(RelativeMap::default());
        config
    }

    fn paths(config: &Config) -> Vec<String> {
        faults(config).into_iter().map(|fault| fault.path).collect()
    }

    #[test]
    fn the_defaults_with_a_world_are_good() {
        assert_eq!(faults(&good()), []);
    }

    #[test]
    fn each_impossible_value_is_found_at_its_key() {
        let mut config = good();
        config.sensor.rays = 2;
        config.sensor.fov_deg = 360.5;
        config.odometry.scale = f64::NAN;
        config.places.recall = 1.5;
        config.name = "../up".into();
        config.compare.drive = "grid".into();
        config.world = Some(World::Maze(MazeWorld { columns: 0, ..MazeWorld::default() }));
        let mut found = paths(&config);
        found.sort();
        let expected = [
            "compare.drive",
            "name",
            "odometry.scale",
            "places.recall",
            "sensor.fov_deg",
            "sensor.rays",
            "world.maze.columns",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn a_seed_that_toml_cannot_write_is_refused() {
        assert_eq!(paths(&Config { seed: u64::MAX, ..good() }), ["seed"]);
    }

    #[test]
    fn a_full_circle_is_allowed_and_no_view_is_not() {
        let mut config = good();
        config.sensor.fov_deg = 360.0;
        assert_eq!(faults(&config), []);
        config.sensor.fov_deg = 0.0;
        assert_eq!(faults(&config)[0].expected, "a number of at least 0.000001 and at most 360");
    }
}
