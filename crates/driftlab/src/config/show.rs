//! Configs as text: resolved with origins, and the annotated defaults.

use std::collections::BTreeMap;

use serde_json::Value as Json;
use toml::Value;

use super::document::join;
use super::schema::{Property, is_variant_table, properties, property_at, resolved, schema, words};
use super::space::is_only_of_the_plane;
use super::{
    ActiveAreaMap, Camera, Cave3dWorld, CavesWorld, Config, CorrectedPolygonsMap, CorridorWorld,
    ExtendedMap, GlobalUnionMap3d, GridCorrectedMap, GridMap, ImageWorld, Loaded, MapServerWorld,
    MazeWorld, MeshWorld, Metrics3d, MovingAiWorld, Office3dWorld, Origin, PaperWorld,
    Pillars3dWorld, PillarsWorld, Planner3d, PolygonsWorld, RapidPlanner, RelativeMap,
    RelativeMap3d, Replay, Replay3d, Rooms3dWorld, RoomsWorld, RunSweep, Start, SurveyPlanner,
    ThesisWorld, VoxelsMap3d,
};

/// The resolved config as TOML, each value with its origin as a comment.
///
/// The text is itself a config that means the same, from the same folder.
pub fn resolved_toml(loaded: &Loaded) -> String {
    let mut lines = Vec::new();
    let table = counting_table(&loaded.config);
    write_resolved(&table, "", &|path| Some(loaded.origin(path)), &mut lines);
    aligned(&lines)
}

/// Where each value of the resolved config came from, by dotted path.
pub fn origins(loaded: &Loaded) -> BTreeMap<String, String> {
    fn walk(table: &toml::Table, path: &str, loaded: &Loaded, all: &mut BTreeMap<String, String>) {
        for (key, value) in table {
            let path = join(path, key);
            match value {
                Value::Table(inner) => walk(inner, &path, loaded, all),
                _ => drop(all.insert(path.clone(), loaded.origin(&path).to_string())),
            }
        }
    }
    let mut all = BTreeMap::new();
    walk(&counting_table(&loaded.config), "", loaded, &mut all);
    all
}

/// A config as TOML without comments, keys in the order of the schema.
///
/// # Errors
/// For a map file whose name is not UTF-8.
pub fn plain_toml(config: &Config) -> Result<String, toml::ser::Error> {
    let mut lines = Vec::new();
    let mut table = toml::Table::try_from(config)?;
    keep_what_counts(config, &mut table);
    write_resolved(&table, "", &|_| None, &mut lines);
    Ok(aligned(&lines))
}

fn counting_table(config: &Config) -> toml::Table {
    let mut table = table_of(config);
    keep_what_counts(config, &mut table);
    table
}

/// In space the tables of the plane say nothing, and are refused where they are read.
fn keep_what_counts(config: &Config, table: &mut toml::Table) {
    table.retain(|key, _| !(config.is_of_space() && is_only_of_the_plane(key)));
}

fn table_of(config: &impl serde::Serialize) -> toml::Table {
    // What was read from TOML, and the defaults, can be written as TOML.
    toml::Table::try_from(config).unwrap_or_default()
}

enum Line {
    Plain(String),
    Value(String, Option<String>),
}

fn write_resolved(
    table: &toml::Table,
    path: &str,
    origin: &dyn Fn(&str) -> Option<Origin>,
    lines: &mut Vec<Line>,
) {
    let keys = in_schema_order(table, path);
    for key in &keys {
        let value = &table[*key];
        if !value.is_table() {
            let comment = origin(&join(path, key)).map(|origin| origin.to_string());
            lines.push(Line::Value(format!("{key} = {value}"), comment));
        }
    }
    for key in &keys {
        if let Value::Table(inner) = &table[*key] {
            let path = join(path, key);
            let has_values = inner.is_empty() || inner.values().any(|value| !value.is_table());
            if has_values {
                lines.push(Line::Plain(String::new()));
                lines.push(Line::Plain(format!("[{path}]")));
            }
            write_resolved(inner, &path, origin, lines);
        }
    }
}

fn in_schema_order<'t>(table: &'t toml::Table, path: &str) -> Vec<&'t str> {
    let node = if path.is_empty() {
        Some(schema())
    } else {
        property_at(path).map(|property| property.node)
    };
    let order: Vec<&str> = node
        .map(|node| properties(node).into_iter().map(|property| property.key).collect())
        .unwrap_or_default();
    let mut keys: Vec<&str> = table.keys().map(String::as_str).collect();
    keys.sort_by_key(|key| order.iter().position(|known| known == key).unwrap_or(usize::MAX));
    keys
}

fn aligned(lines: &[Line]) -> String {
    let width = |line: &Line| match line {
        Line::Value(text, Some(_)) if text.chars().count() <= 40 => text.chars().count(),
        _ => 0,
    };
    let widest = lines.iter().map(width).max().unwrap_or(0);
    let mut out = String::new();
    for line in lines {
        match line {
            Line::Plain(text) | Line::Value(text, None) => out.push_str(text),
            Line::Value(text, Some(comment)) => {
                out.push_str(&format!("{text:widest$}  # {}", comment.replace('\n', " ")));
            }
        }
        out.push('\n');
    }
    out
}

/// Every key with its default and what it means, as a config that runs.
///
/// Variants, maps and keys that are not the default stand there as comments.
pub fn defaults_toml() -> String {
    let mut out = String::from(
        "# Every key of a config, its default and its meaning. Tables that start with `#` are not\n\
         # there unless written. `driftlab config defaults` prints this page.\n",
    );
    let config = table_of(&Config { name: "defaults".into(), ..Config::default() });
    write_defaults(schema(), &config, "", &mut out);
    out
}

/// Defaults of the tables that a config may leave out; the first of each variant is live.
fn optional_tables() -> Vec<(&'static str, bool, toml::Table)> {
    vec![
        ("start", false, table_of(&Start { z_m: Some(0.0), ..Start::default() })),
        ("world.paper", true, table_of(&PaperWorld::default())),
        ("world.thesis", false, table_of(&ThesisWorld::default())),
        ("world.corridor", false, table_of(&CorridorWorld::default())),
        (
            "world.map_server",
            false,
            table_of(&MapServerWorld { yaml: "map.yaml".into(), ..MapServerWorld::default() }),
        ),
        (
            "world.moving_ai",
            false,
            table_of(&MovingAiWorld { file: "arena.map".into(), ..MovingAiWorld::default() }),
        ),
        (
            "world.image",
            false,
            table_of(&ImageWorld {
                file: "floor.png".into(),
                solid_below: Some(0.5),
                ..ImageWorld::default()
            }),
        ),
        ("world.polygons", false, table_of(&PolygonsWorld::default())),
        ("world.rooms", false, table_of(&RoomsWorld::default())),
        ("world.maze", false, table_of(&MazeWorld::default())),
        ("world.pillars", false, table_of(&PillarsWorld::default())),
        ("world.caves", false, table_of(&CavesWorld::default())),
        (
            "world3d.mesh",
            false,
            table_of(&MeshWorld { file: "house.obj".into(), ..MeshWorld::default() }),
        ),
        ("world3d.rooms", false, table_of(&Rooms3dWorld::default())),
        ("world3d.office", false, table_of(&Office3dWorld::default())),
        ("world3d.pillars", false, table_of(&Pillars3dWorld::default())),
        ("world3d.cave", false, table_of(&Cave3dWorld::default())),
        ("camera", false, table_of(&Camera::default())),
        ("map3d.relative", false, table_of(&RelativeMap3d::default())),
        ("map3d.global_union", false, table_of(&GlobalUnionMap3d::default())),
        ("map3d.voxels", false, table_of(&VoxelsMap3d::default())),
        ("planner3d", false, table_of(&Planner3d::default())),
        ("metrics3d", false, table_of(&Metrics3d::default())),
        ("map.relative", true, table_of(&RelativeMap::default())),
        ("map.grid", false, table_of(&GridMap::default())),
        ("map.grid_corrected", false, table_of(&GridCorrectedMap::default())),
        ("map.corrected_polygons", false, table_of(&CorrectedPolygonsMap::default())),
        ("map.active_area", false, table_of(&ActiveAreaMap::default())),
        ("map.extended", false, table_of(&ExtendedMap::default())),
        ("planner.rapid", true, table_of(&RapidPlanner::default())),
        ("planner.survey", false, table_of(&SurveyPlanner::default())),
        ("replay", false, table_of(&Replay::default())),
        ("replay3d", false, table_of(&Replay3d { max_m: Some(8.0), ..Replay3d::default() })),
        (
            "sweep",
            false,
            table_of(&RunSweep {
                axes: [("odometry.scale", [0.0, 0.5, 1.0].map(Value::Float).to_vec())].into(),
                ..RunSweep::default()
            }),
        ),
    ]
}

/// Examples of keys that a config may leave out, in tables that it may not.
fn optional_keys() -> [(&'static str, Value); 1] {
    [("metrics.grid", Value::Array(vec![Value::Integer(25), Value::Integer(20)]))]
}

fn write_defaults(node: &'static Json, defaults: &toml::Table, path: &str, out: &mut String) {
    let is_table =
        |child: &'static Json| !properties(child).is_empty() && resolved(child)["type"] != "string";
    for property in properties(node) {
        if is_table(property.node) {
            continue;
        }
        let path = join(path, property.key);
        let example = optional_keys().into_iter().find(|(name, _)| *name == path);
        match (defaults.get(property.key), example) {
            (Some(value), _) => write_key(&property, value, true, out),
            (None, Some((_, value))) => write_key(&property, &value, false, out),
            (None, None) => {}
        }
    }
    for Property { key, node: child, about } in properties(node) {
        if !is_table(child) {
            continue;
        }
        let path = join(path, key);
        let optional = optional_tables().into_iter().find(|(name, _, _)| *name == path);
        let own = defaults.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let only_tables = properties(child).iter().all(|inner| is_table(inner.node));
        let comment = about.replace('\n', " ");
        match optional {
            Some((_, live, table)) => {
                let hash = if live { "" } else { "# " };
                out.push_str(&format!("\n{}{hash}[{path}]\n", commented(&comment)));
                for property in properties(child) {
                    if let Some(value) = table.get(property.key) {
                        write_key(&property, value, live, out);
                    }
                }
            }
            None if only_tables || is_variant_table(child) => {
                out.push_str(&format!("\n{}", commented(&format!("[{path}]: {comment}"))));
                write_defaults(child, &own, &path, out);
            }
            None => {
                out.push_str(&format!("\n{}[{path}]\n", commented(&comment)));
                write_defaults(child, &own, &path, out);
            }
        }
    }
}

fn write_key(property: &Property, value: &Value, live: bool, out: &mut String) {
    let Property { key, node, about } = property;
    out.push_str(&commented(&about.replace('\n', " ")));
    for (word, meaning) in words(node) {
        let meaning = meaning.replace('\n', " ");
        let separator = if meaning.is_empty() { "" } else { ": " };
        out.push_str(&commented(&format!("  \"{word}\"{separator}{meaning}")));
    }
    let hash = if live { "" } else { "# " };
    out.push_str(&format!("{hash}{key} = {value}\n"));
}

/// A text as comment lines of at most 100 characters.
fn commented(text: &str) -> String {
    let indent = text.len() - text.trim_start().len();
    let mut lines = vec![" ".repeat(indent)];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("starts with one line");
        if !line.trim().is_empty() && line.chars().count() + word.chars().count() + 3 > 100 {
            lines.push(format!("{}{word}", " ".repeat(indent)));
        } else {
            if !line.trim().is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.iter().map(|line| format!("# {line}\n")).collect()
}
