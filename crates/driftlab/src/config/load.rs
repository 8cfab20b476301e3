//! From a file and the command line to a checked config: defaults, file, `--world`, `--set`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::check::{Fault, faults, is_folder_name};
use super::document::{Spans, VARIANTS, join, keep, lay_over, moved, spans, table_at};
use super::explain::{explained, with_meaning};
use super::schema::{properties, property_at};
use super::shape::no_list_for_a_table;
use super::source::Sources;
use super::{Config, ConfigError, Origin, Place};

/// What the command line lays over a config file.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// `path=value` with a TOML value, in order.
    pub sets: Vec<String>,
    /// A map or mesh file that replaces the world, and the key of its kind: `image`, `map_server`,
    /// `moving_ai` or `mesh`.
    pub world: Option<(PathBuf, &'static str)>,
}

/// A checked config that remembers where each value came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The config; its file names are as they were written.
    pub config: Config,
    /// The file, as it was named.
    pub path: PathBuf,
    spans: BTreeMap<String, Spans>,
    sources: Sources,
    header: String,
    text: String,
    overrides: Overrides,
    notes: Vec<String>,
}

impl Loaded {
    /// Reads, merges and checks a config.
    ///
    /// Errors: the first thing wrong, in the order of the file.
    pub fn read(path: &Path, overrides: &Overrides) -> Result<Self, ConfigError> {
        let text = std::fs::read(path).and_then(|bytes| {
            let invalid = |_| std::io::Error::other("it is not UTF-8 text");
            String::from_utf8(bytes).map_err(invalid)
        });
        let text = text.map_err(|reason| ConfigError::Unreadable {
            path: path.to_owned(),
            reason,
            expected: "a TOML config".into(),
        })?;
        Self::from_text(path, &text, overrides)
    }

    /// As [`read`](Self::read), from the text of the file.
    pub fn from_text(path: &Path, text: &str, overrides: &Overrides) -> Result<Self, ConfigError> {
        let mut sources = Sources::default();
        let none = BTreeMap::new();

        let base = sources.add_file(path, text.to_owned());
        let parsed = DeTable::parse(text);
        let parsed = parsed.map_err(|error| explained(&error, base, &sources, &none))?;
        let root_span = parsed.span();
        let mut document = parsed.into_inner();
        this_schema(&document, &sources)?;
        one_variant_each(&document, &sources)?;

        let world_text = overrides.world.as_ref().map(|(file, kind)| world_text(file, kind));
        if let (Some((file, kind)), Some(world_text)) = (&overrides.world, &world_text) {
            let base = sources.add_world(file, world_text.clone());
            let parsed = DeTable::parse(world_text);
            let parsed = parsed.map_err(|error| explained(&error, base, &sources, &none))?;
            // The start and everything but the parameters of this kind belong to the old world.
            document.remove("start");
            drop_file_keys(&mut document, world_key(kind), kind);
            lay_over(&mut document, moved(parsed.into_inner(), base));
        }

        let mut notes = Vec::new();
        for set in &overrides.sets {
            let base = sources.add_set(set);
            let parsed = DeTable::parse(set);
            let parsed = parsed.map_err(|error| {
                bare_word(set, base, &sources)
                    .unwrap_or_else(|| explained(&error, base, &sources, &none))
            })?;
            if parsed.get_ref().is_empty() {
                return Err(ConfigError::Value {
                    place: sources.place(base..base + set.len()),
                    found: "no assignment".into(),
                    expected: "path=value, as in odometry.scale=0.5".into(),
                });
            }
            let over = moved(parsed.into_inner(), base);
            one_variant_each(&over, &sources)?;
            notes.extend(replaced_variants(&document, &over, set));
            drop_alternatives(&mut document, &over);
            lay_over(&mut document, over);
        }

        no_list_for_a_table(&document, &sources)?;
        let spans = spans(&document);
        let parser = toml::de::Deserializer::from(Spanned::new(root_span, document));
        let mut config =
            Config::deserialize(parser).map_err(|error| explained(&error, 0, &sources, &spans))?;
        if !spans.contains_key("name") {
            config.name = name_of(path);
        }
        if config.metrics.grid.is_some() && !spans.contains_key("metrics.cell_m") {
            config.metrics.cell_m = None;
        }
        one_kind_of_place(&config, &spans, &sources)?;
        if config.is_of_space() {
            config.camera.get_or_insert_default();
            config.planner3d.get_or_insert_default();
            config.metrics3d.get_or_insert_default();
        }
        let loaded = Self {
            config,
            path: path.to_owned(),
            spans,
            sources,
            header: header_of(text),
            text: text.to_owned(),
            overrides: overrides.clone(),
            notes,
        };
        match loaded.first(faults(&loaded.config)) {
            Some(error) => Err(error),
            None => Ok(loaded),
        }
    }

    /// The same config with more values set, and nothing to sweep: one combination of a sweep.
    ///
    /// # Errors
    /// The first thing wrong; what a set brings in is told at the axis that it is of, if it is of
    /// one.
    pub fn with(&self, sets: &[String]) -> Result<Self, ConfigError> {
        let mut overrides = self.overrides.clone();
        overrides.sets.extend(sets.iter().cloned());
        let loaded = Self::from_text(&self.path, &self.text, &overrides);
        let mut loaded = loaded.map_err(|error| self.at_axis(error, sets))?;
        loaded.config.sweep = None;
        Ok(loaded)
    }

    /// The error, told at the line of the axis where one of these sets brought it in.
    pub(crate) fn at_axis(&self, mut error: ConfigError, sets: &[String]) -> ConfigError {
        if let ConfigError::Value { place, .. } | ConfigError::World { place, .. } = &mut error
            && let Some(set) = sets.iter().find(|set| place.text == format!("--set {set}"))
            && let Some((key, _)) = set.split_once(" = ")
        {
            *place = self.place(&join("sweep.axes", key));
        }
        error
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    fn first(&self, faults: Vec<Fault>) -> Option<ConfigError> {
        let standing = |fault: &Fault| {
            let own = self.spans.get(&fault.path).map(|spans| spans.value.start);
            own.unwrap_or(usize::MAX)
        };
        let fault = faults.into_iter().min_by_key(standing)?;
        let missing = fault.path.is_empty() || fault.found.starts_with("no ");
        let key = if missing { String::new() } else { format!(" for `{}`", fault.path) };
        // What is missing is told where it could be added: at the end of the file.
        let end = self.text.trim_end().len();
        let place = if missing && !self.spans.contains_key(&fault.path) {
            self.sources.place(end..end)
        } else {
            self.place(&fault.path)
        };
        Some(ConfigError::Value {
            place,
            found: format!("{}{key}", fault.found),
            expected: with_meaning(&fault.expected, &fault.path),
        })
    }

    /// What the file says about itself: its first comment, without the `#`.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// What the command line did that its author may not have meant, one line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Where the value of a dotted key was written; for one that was not, its table or the file.
    pub fn place(&self, path: &str) -> Place {
        let mut path = path;
        loop {
            if let Some(spans) = self.spans.get(path) {
                return self.sources.place(spans.value.clone());
            }
            match path.rsplit_once('.') {
                Some((parent, _)) => path = parent,
                None => return Place::file(&self.path),
            }
        }
    }

    /// Who gave the value of a dotted key.
    pub fn origin(&self, path: &str) -> Origin {
        match self.spans.get(path) {
            Some(spans) => self.sources.origin(spans.value.start),
            None => Origin::Default,
        }
    }

    /// The config with the file names of its world made absolute: they are relative to the config.
    pub fn anchored(&self) -> Config {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let folder = std::path::absolute(folder.join(".")).unwrap_or_else(|_| folder.to_owned());
        let mut config = self.config.clone();
        if let Some(world) = &mut config.world {
            world.anchor_file(&folder);
        }
        if let Some(world) = &mut config.world3d {
            world.anchor_file(&folder);
        }
        config
    }
}

/// The first comment of a config, without the line for editors.
fn header_of(text: &str) -> String {
    let comments = text.lines().filter(|line| !line.starts_with("#:"));
    let comments = comments.skip_while(|line| line.trim().is_empty());
    let lines: Vec<&str> = comments
        .map_while(|line| line.strip_prefix('#'))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .collect();
    lines.join("\n").trim().to_owned()
}

fn world_text(file: &Path, kind: &str) -> String {
    let absolute = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let key = if kind == "map_server" { "yaml" } else { "file" };
    let quoted = toml::Value::String(absolute.to_string_lossy().into_owned());
    format!("[{}.{kind}]\n{key} = {quoted}\n", world_key(kind))
}

/// The table of places that has this kind.
fn world_key(kind: &str) -> &'static str {
    if kind == "mesh" { "world3d" } else { "world" }
}

fn drop_file_keys(document: &mut DeTable<'_>, world: &str, kind: &str) {
    let Some(world) = document.get_mut(world) else { return };
    let DeValue::Table(variants) = world.get_mut() else { return };
    keep(variants, |variant| variant == kind);
    for (_, parameters) in variants.iter_mut() {
        if let DeValue::Table(table) = parameters.get_mut() {
            table.remove("file");
            table.remove("yaml");
        }
    }
}

/// The variants that `over` replaces by others, told: the parameters of the old one go with it.
fn replaced_variants(document: &DeTable<'_>, over: &DeTable<'_>, set: &str) -> Vec<String> {
    let mut notes = Vec::new();
    for name in VARIANTS {
        let (Some(old), Some(new)) = (table_at(document, name), table_at(over, name)) else {
            continue;
        };
        let key = |table: &DeTable<'_>| table.keys().next().map(|key| key.get_ref().to_string());
        if let (Some(old), Some(new)) = (key(old), key(new))
            && old != new
        {
            notes.push(format!("--set {set}: {name}.{new} replaces the config's {name}.{old}"));
        }
    }
    notes
}

/// A size of the evaluation cells that the command line gives replaces the file's, whichever of the
/// two keys either uses.
fn drop_alternatives(document: &mut DeTable<'_>, over: &DeTable<'_>) {
    let Some(new) = table_at(over, "metrics") else { return };
    let Some(DeValue::Table(old)) = document.get_mut("metrics").map(Spanned::get_mut) else {
        return;
    };
    for (one, other) in [("grid", "cell_m"), ("cell_m", "grid")] {
        if new.contains_key(one) {
            old.remove(other);
        }
    }
}

/// The tables of the plane and those of space are not mixed: what one of them says would not count.
fn one_kind_of_place(
    config: &Config,
    spans: &BTreeMap<String, Spans>,
    sources: &Sources,
) -> Result<(), ConfigError> {
    let of_space = ["world3d", "map3d", "camera", "planner3d", "metrics3d"];
    let is_of_space = config.is_of_space();
    let is_foreign = |key: &str| match is_of_space {
        true => super::space::is_only_of_the_plane(key),
        false => of_space.contains(&key),
    };
    let mut foreign: Vec<(&String, &Spans)> =
        spans.iter().filter(|(key, _)| is_foreign(key)).collect();
    foreign.sort_by_key(|(_, spans)| spans.key.start);
    let Some((key, spans)) = foreign.first() else { return Ok(()) };
    let expected = match is_of_space {
        true => format!(
            "tables of space only beside [world3d] or [map3d]: {}",
            of_space.map(|key| format!("[{key}]")).join(", ")
        ),
        false => "tables of the plane only, or a place of space under [world3d]".to_owned(),
    };
    Err(ConfigError::Value {
        place: sources.place(spans.key.clone()),
        found: format!("[{key}]"),
        expected,
    })
}

/// A config of another layout is told first: its keys mean something else.
fn this_schema(document: &DeTable<'_>, sources: &Sources) -> Result<(), ConfigError> {
    let Some(value) = document.get("schema") else { return Ok(()) };
    match value.get_ref() {
        DeValue::Integer(number) if number.as_str() != "1" => Err(ConfigError::Value {
            place: sources.place(value.span()),
            found: format!("{number} for `schema`"),
            expected: "1, the layout of configs that this driftlab reads".into(),
        }),
        _ => Ok(()),
    }
}

fn one_variant_each(document: &DeTable<'_>, sources: &Sources) -> Result<(), ConfigError> {
    for name in VARIANTS {
        let Some(table) = table_at(document, name) else { continue };
        if let (true, Some(spans)) = (table.is_empty(), document.get(name).map(Spanned::span)) {
            let kinds = properties_of(name).join(", ");
            return Err(ConfigError::Value {
                place: sources.place(spans),
                found: format!("no table under [{name}]"),
                expected: format!("exactly one of {kinds}"),
            });
        }
        let mut keys: Vec<_> = table.iter().map(|(key, value)| (key, value.span())).collect();
        keys.sort_by_key(|(key, _)| key.span().start);
        if let [(first, _), (second, _), ..] = keys[..] {
            let line = match sources.origin(first.span().start) {
                Origin::File { line, .. } => format!(" of line {line}"),
                _ => String::new(),
            };
            return Err(ConfigError::Value {
                place: sources.place(second.span()),
                found: format!("a second {name} `{name}.{second}`", second = second.get_ref()),
                expected: format!(
                    "exactly one table under [{name}], beside `{name}.{first}`{line} no other",
                    first = first.get_ref()
                ),
            });
        }
    }
    Ok(())
}

/// The keys under a top-level table, as `world.maze`.
pub(super) fn properties_of(name: &str) -> Vec<String> {
    let node = property_at(name).map(|property| property.node);
    let all = node.map(properties).unwrap_or_default();
    all.into_iter().map(|property| join(name, property.key)).collect()
}

/// A word that somebody forgot to quote: `--set record.level=off`.
fn bare_word(set: &str, base: usize, sources: &Sources) -> Option<ConfigError> {
    let (path, value) = set.split_once('=')?;
    let value = value.trim();
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    if !value.starts_with(|c: char| c.is_ascii_alphabetic() || c == '.' || c == '/')
        || !value.chars().all(plain)
    {
        return None;
    }
    let start = base + set.find(value)?;
    Some(ConfigError::Value {
        place: sources.place(start..start + value.len()),
        found: format!("the bare word {value}"),
        expected: format!("a TOML value; text needs quotes: --set '{}=\"{value}\"'", path.trim()),
    })
}

fn name_of(path: &Path) -> String {
    let stem =
        path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let name: String = stem
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' })
        .collect();
    let name = name.trim_start_matches(['.', '-']).to_owned();
    if is_folder_name(&name) { name } else { "run".into() }
}
