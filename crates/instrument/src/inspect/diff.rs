//! Whether two recordings say the same, whatever order and chunks their rows came in.

use std::collections::BTreeMap;
use std::path::Path;

use sha2::{Digest as _, Sha256};

use super::content;
use super::read::read;
use crate::InstrumentError;

/// One row of one component: where on the timelines, and a hash of what it says.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Row {
    times: Vec<(String, i64)>,
    says: [u8; 32],
}

/// All rows by entity and component; those of equal times in the order in which they were written.
type Rows = BTreeMap<(String, String), Vec<Row>>;

/// One difference between two recordings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The entity.
    pub entity: String,
    /// The component of it.
    pub component: String,
    /// What differs, in words.
    pub what: String,
    /// Where the first row that differs stands on each timeline; empty for what holds at all times.
    pub times: Vec<(String, i64)>,
}

/// The timelines by which differences are put in order, the first that they have.
const ORDER: [&str; 4] = ["step", "iteration", "event", "sim_time"];

impl Difference {
    /// Where it stands: the name of the timeline that counts, and the time on it.
    pub fn place(&self) -> Option<(&str, i64)> {
        let on = |name: &str| self.times.iter().find(|(own, _)| own == name);
        let place = ORDER.iter().find_map(|name| on(name)).or(self.times.first());
        place.map(|(name, at)| (name.as_str(), *at))
    }

    /// The first of some differences in time: by step, then by event. What holds at all times, such
    /// as the config, comes first only where nothing else differs.
    pub fn first(differences: &[Self]) -> Option<&Self> {
        let event = |one: &Self| one.times.iter().find(|(name, _)| name == "event").map(|at| at.1);
        differences.iter().min_by_key(|one| {
            let at = one.place().map(|(_, at)| at);
            (at.is_none(), at, event(one).unwrap_or(i64::MAX))
        })
    }
}

fn rows(path: &Path) -> Result<Rows, InstrumentError> {
    let mut all = Rows::new();
    read(path, |chunk, _| {
        let entity = chunk.entity_path().to_string();
        // Start time and the like: of the file, not of the experiment.
        if entity.starts_with("/__properties") {
            return;
        }
        let mut timelines: Vec<_> = chunk.timelines().iter().collect();
        timelines.sort_by_key(|(name, _)| name.to_string());
        let mut columns: Vec<_> = chunk.components().values().collect();
        columns.sort_by_key(|column| column.descriptor.component.to_string());
        for column in columns {
            let component = column.descriptor.component.to_string();
            let list = &column.list_array;
            let rows = all.entry((entity.clone(), component)).or_default();
            for i in (0..chunk.num_rows())
                .filter(|&i| !rerun::external::arrow::array::Array::is_null(list, i))
            {
                let times =
                    timelines.iter().map(|(name, times)| (name.to_string(), times.times_raw()[i]));
                let mut hash = Sha256::new();
                content::add(&list.value(i), &mut hash);
                rows.push(Row { times: times.collect(), says: hash.finalize().into() });
            }
        }
    })?;
    for rows in all.values_mut() {
        rows.sort_by(|a, b| a.times.cmp(&b.times));
    }
    Ok(all)
}

/// How two recordings differ in what they say: rows by entity, component and time.
///
/// Chunks, row ids, the layout, names and start times do not count. The list is empty where nothing
/// differs; it holds at most one entry per component, which tells of the first row that differs.
///
/// # Errors
/// Files that cannot be read at all. Damaged files are compared as far as they can be read.
pub fn diff(a: &Path, b: &Path) -> Result<Vec<Difference>, InstrumentError> {
    let (a, b) = (rows(a)?, rows(b)?);
    let mut differences = Vec::new();
    let keys: std::collections::BTreeSet<_> = a.keys().chain(b.keys()).collect();
    let none = Vec::new();
    for key in keys {
        let (left, right) = (a.get(key).unwrap_or(&none), b.get(key).unwrap_or(&none));
        let (what, row) = match left.iter().zip(right).find(|(l, r)| l != r) {
            Some((l, r)) if l.times == r.times => {
                (format!("other content at {}", when(l)), Some(l))
            }
            Some((l, r)) => {
                let first = if l.times <= r.times { l } else { r };
                (format!("rows part at {} and {}", when(l), when(r)), Some(first))
            }
            None if left.len() == right.len() => continue,
            None => {
                let longer = if left.len() > right.len() { left } else { right };
                let what = format!("{} rows against {}", left.len(), right.len());
                (what, longer.get(left.len().min(right.len())))
            }
        };
        let (entity, component) = key.clone();
        let times = row.map_or_else(Vec::new, |row| row.times.clone());
        differences.push(Difference { entity, component, what, times });
    }
    Ok(differences)
}

fn when(row: &Row) -> String {
    if row.times.is_empty() {
        return "all times".to_owned();
    }
    let times: Vec<String> = row.times.iter().map(|(name, at)| format!("{name} {at}")).collect();
    times.join(", ")
}

/// A hash of everything that a recording says: equal where [`diff`] finds nothing.
///
/// # Errors
/// A file that cannot be read at all.
pub fn fingerprint(path: &Path) -> Result<String, InstrumentError> {
    let mut hash = Sha256::new();
    for ((entity, component), rows) in rows(path)? {
        hash.update(format!("{entity}\n{component}\n{}\n", rows.len()));
        for row in rows {
            hash.update(format!("{:?}", row.times));
            hash.update(row.says);
        }
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
