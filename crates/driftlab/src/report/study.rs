//! A folder of results, read back.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::group::{Group, groups};
use super::stats::Mean;
use crate::run::names;
use crate::sweep::file_names;
use crate::table::{Cell, Row, Table, TableError, read_parquet};

/// The key of the drift.
const DRIFT: &str = "odometry.scale";

/// The distance until no frontier was left, as it is named in results.
const NO_FRONTIER: &str = "no_frontier_m";

/// The results of one sweep, or of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Study {
    /// Its name.
    pub(crate) name: String,
    /// What its config says about itself; may be empty.
    pub(crate) about: String,
    /// Where it was read from.
    pub(crate) folder: PathBuf,
    /// The config that its runs share, by dotted key.
    pub(crate) config: BTreeMap<String, Cell>,
    /// Its runs.
    pub(crate) groups: Vec<Group>,
}

/// Why a folder cannot be reported on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// Neither a sweep's folder nor a run's.
    #[error(
        "{}: found no results, expected the folder of a sweep ({}) or of a run ({})",
        folder.display(), file_names::RESULTS, names::METRICS
    )]
    NoResults {
        /// The folder.
        folder: PathBuf,
    },
    /// A sweep over something else.
    #[error("{}: found a table without a column `{column}`, expected the results of a sweep over experiments", path.display())]
    OtherTable {
        /// The table.
        path: PathBuf,
        /// What it lacks.
        column: &'static str,
    },
    /// A table that cannot be read.
    #[error("{}: {reason}", path.display())]
    Table {
        /// The table.
        path: PathBuf,
        /// What is wrong.
        reason: TableError,
    },
    /// A plot that cannot be drawn: a bug of ours.
    #[error("the plot {plot}: {reason}")]
    Plot {
        /// What it shows.
        plot: String,
        /// What the plotter said.
        reason: String,
    },
    /// A file that is not what a run leaves.
    #[error("{}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

impl Study {
    /// Reads the folder of a sweep or of a run.
    ///
    /// # Errors
    /// A folder without results, or with files that are not what was written.
    pub(crate) fn read(folder: &Path) -> Result<Self, ReportError> {
        if folder.join(file_names::RESULTS).is_file() {
            Self::of_sweep(folder)
        } else if folder.join(names::METRICS).is_file() {
            Self::of_run(folder)
        } else {
            Err(ReportError::NoResults { folder: folder.to_owned() })
        }
    }

    fn of_sweep(folder: &Path) -> Result<Self, ReportError> {
        let results = table(folder, file_names::RESULTS)?;
        for column in ["seed", "map"] {
            if results.column(column).is_none() {
                let path = folder.join(file_names::RESULTS);
                return Err(ReportError::OtherTable { path, column });
            }
        }
        let timing = optional_table(folder, file_names::TIMING)?;
        let curves = optional_table(folder, file_names::CURVES)?;
        let (config, about) = config(&folder.join(file_names::CONFIG))?;
        Ok(Self {
            name: name(&config, folder),
            about,
            folder: folder.to_owned(),
            groups: groups(&results, &timing, &curves),
            config,
        })
    }

    fn of_run(folder: &Path) -> Result<Self, ReportError> {
        let (config, about) = config(&folder.join(names::CONFIG))?;
        let metrics = json(&folder.join(names::METRICS))?;
        let timing = json(&folder.join(names::TIMING))?;
        let seed = metrics["seed"].as_u64().unwrap_or_default();
        let rows = |report: &Value| -> Table {
            let maps = report["maps"].as_object().into_iter().flatten();
            Table::of(maps.map(|(map, numbers)| {
                let mut row = labels(seed, map);
                let numbers = numbers.as_object().into_iter().flatten();
                row.extend(numbers.map(|(name, value)| (name.clone(), Cell::from_json(value))));
                row
            }))
        };
        let steps = table(folder, names::STEPS)?;
        let columns = ["map", "distance_m", "coverage"].map(|name| steps.column(name));
        let curves = match columns {
            [Some(map), Some(distance), Some(coverage)] => {
                Table::of(steps.rows.iter().map(|row| {
                    let mut cells = labels(seed, &row[map].shown());
                    cells.push(("distance_m".to_owned(), row[distance].clone()));
                    cells.push(("coverage".to_owned(), row[coverage].clone()));
                    cells
                }))
            }
            _ => Table::default(),
        };
        Ok(Self {
            name: name(&config, folder),
            about,
            folder: folder.to_owned(),
            groups: groups(&rows(&metrics), &rows(&timing), &curves),
            config,
        })
    }

    /// The value of a key in a group: its axis's, else that of the config.
    pub(crate) fn value<'a>(&'a self, group: &'a Group, key: &str) -> Option<&'a Cell> {
        group.axis(key).or_else(|| self.config.get(key))
    }

    /// The mean of what was measured; `times_grid` is that of `no_frontier_m` as a multiple of the
    /// grid's at the same setting, which of all drifts takes the least.
    pub(crate) fn measured(&self, group: &Group, name: &str) -> Option<Mean> {
        if name != "times_grid" {
            return group.mean(name);
        }
        let same = |other: &Group| {
            group.axes.iter().all(|(axis, value)| axis == DRIFT || other.axis(axis) == Some(value))
        };
        let drift = |group: &Group| group.axis(DRIFT).and_then(Cell::number).unwrap_or(0.0);
        let grids = self.groups.iter().filter(|other| other.map == "grid" && same(other));
        let grid = grids.min_by(|a, b| drift(a).total_cmp(&drift(b)))?.mean(NO_FRONTIER)?.mean;
        Mean::of(group.runs.iter().filter_map(|run| run.number(NO_FRONTIER)).map(|m| m / grid))
    }

    /// The axes with more than one value, in order, each with its values in order of appearance.
    pub(crate) fn axes(&self) -> Vec<(String, Vec<Cell>)> {
        let mut axes: Vec<(String, Vec<Cell>)> = Vec::new();
        for group in &self.groups {
            for (axis, value) in &group.axes {
                match axes.iter_mut().find(|(known, _)| known == axis) {
                    Some((_, values)) if values.contains(value) => {}
                    Some((_, values)) => values.push(value.clone()),
                    None => axes.push((axis.clone(), vec![value.clone()])),
                }
            }
        }
        axes.retain(|(_, values)| values.len() > 1);
        axes
    }

    /// The names of the maps, in order of appearance.
    pub(crate) fn maps(&self) -> Vec<String> {
        let mut maps: Vec<String> = Vec::new();
        for group in &self.groups {
            if !maps.contains(&group.map) {
                maps.push(group.map.clone());
            }
        }
        maps
    }
}

fn labels(seed: u64, map: &str) -> Row {
    vec![("seed".to_owned(), seed.into()), ("map".to_owned(), map.into())]
}

fn table(folder: &Path, name: &str) -> Result<Table, ReportError> {
    let path = folder.join(name);
    read_parquet(&path).map_err(|reason| ReportError::Table { path, reason })
}

fn optional_table(folder: &Path, name: &str) -> Result<Table, ReportError> {
    if folder.join(name).exists() { table(folder, name) } else { Ok(Table::default()) }
}

fn text(path: &Path) -> Result<String, ReportError> {
    let wrong = |reason: std::io::Error| ReportError::File {
        path: path.to_owned(),
        reason: format!("cannot be read ({reason})"),
    };
    fs::read_to_string(path).map_err(wrong)
}

fn json(path: &Path) -> Result<Value, ReportError> {
    serde_json::from_str(&text(path)?)
        .map_err(|error| ReportError::File { path: path.to_owned(), reason: error.to_string() })
}

/// The keys of a config, and the comment that it starts with.
fn config(path: &Path) -> Result<(BTreeMap<String, Cell>, String), ReportError> {
    let text = text(path)?;
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| ReportError::File {
        path: path.to_owned(),
        reason: error.message().to_owned(),
    })?;
    let mut keys = BTreeMap::new();
    flatten(&table, "", &mut keys);
    let comment = text.lines().map_while(|line| line.strip_prefix('#'));
    let comment: Vec<&str> = comment.map(str::trim).collect();
    Ok((keys, comment.join("\n").trim().to_owned()))
}

fn flatten(table: &toml::Table, prefix: &str, keys: &mut BTreeMap<String, Cell>) {
    for (key, value) in table {
        let path = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
        match value {
            toml::Value::Table(inner) => flatten(inner, &path, keys),
            plain => drop(keys.insert(path, Cell::from_toml(plain))),
        }
    }
}

fn name(config: &BTreeMap<String, Cell>, folder: &Path) -> String {
    match config.get("name") {
        Some(Cell::Text(name)) => name.clone(),
        _ => folder.file_name().unwrap_or_default().to_string_lossy().into_owned(),
    }
}
