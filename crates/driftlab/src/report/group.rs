//! Runs that differ in nothing but their seed.

use std::collections::BTreeMap;

use super::stats::{Mean, Share, median};
use crate::table::{Cell, Row, Table};

/// The column after the axes.
const SEED: &str = "seed";

/// The column that names the map.
const MAP: &str = "map";

/// The runs of one map at one combination of the axes' values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Group {
    /// The values of the axes, in their order.
    pub(crate) axes: Row,
    /// The name of the map.
    pub(crate) map: String,
    /// Its runs, by seed.
    pub(crate) runs: Vec<Run>,
}

/// One map of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Run {
    /// Its seed.
    pub(crate) seed: u64,
    /// What was measured, by name.
    pub(crate) results: BTreeMap<String, Cell>,
    /// What it cost, by name.
    pub(crate) timing: BTreeMap<String, Cell>,
    /// Distance, metres, and coverage, in steps: it holds until the next.
    pub(crate) curve: Vec<(f64, f64)>,
}

impl Run {
    /// A number that was measured, if it was.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.results.get(name).and_then(Cell::number)
    }

    /// Whether a flag is set.
    fn is(&self, name: &str) -> bool {
        self.results.get(name) == Some(&Cell::Flag(true))
    }

    /// Whether the robot believed that it was done, and it was so.
    pub(crate) fn succeeded(&self) -> bool {
        self.is("believed_complete") && !self.is("false_completion")
    }

    /// Whether it believed so wrongly.
    pub(crate) fn was_wrong(&self) -> bool {
        self.is("false_completion")
    }
}

impl Group {
    /// Mean and spread of what was measured, over the runs that have it.
    pub(crate) fn mean(&self, name: &str) -> Option<Mean> {
        Mean::of(self.runs.iter().filter_map(|run| run.number(name)))
    }

    /// The middle of a cost over the runs.
    pub(crate) fn cost(&self, name: &str) -> Option<f64> {
        median(self.runs.iter().filter_map(|run| run.timing.get(name)?.number()).collect())
    }

    /// The share of runs that ended complete and true.
    pub(crate) fn success(&self) -> Option<Share> {
        Share::of(self.runs.iter().filter(|run| run.succeeded()).count(), self.runs.len())
    }

    /// The share of runs that believed wrongly that they were complete.
    pub(crate) fn wrong(&self) -> Option<Share> {
        Share::of(self.runs.iter().filter(|run| run.was_wrong()).count(), self.runs.len())
    }

    /// The value of an axis.
    pub(crate) fn axis(&self, name: &str) -> Option<&Cell> {
        self.axes.iter().find(|(axis, _)| axis == name).map(|(_, value)| value)
    }
}

/// The groups of a sweep's tables, in the order of their first rows.
///
/// Axes are the columns before `seed`. Rows of the tables belong together by axes, seed and map.
pub(crate) fn groups(results: &Table, timing: &Table, curves: &Table) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut places: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    for row in rows(results) {
        let key = format!("{}\n{:?}", row.map, row.axes);
        let group = match places.get(&key) {
            Some(&(group, _)) => group,
            None => {
                groups.push(Group { axes: row.axes.clone(), map: row.map.clone(), runs: vec![] });
                groups.len() - 1
            }
        };
        places.insert(key.clone(), (group, 0));
        places.insert(format!("{key}\n{}", row.seed), (group, groups[group].runs.len()));
        groups[group].runs.push(Run { seed: row.seed, results: row.rest, ..Run::default() });
    }
    let place =
        |row: &Told| places.get(&format!("{}\n{:?}\n{}", row.map, row.axes, row.seed)).copied();
    for row in rows(timing) {
        if let Some((group, run)) = place(&row) {
            groups[group].runs[run].timing = row.rest;
        }
    }
    for row in rows(curves) {
        let number = |name: &str| row.rest.get(name).and_then(Cell::number);
        if let (Some((group, run)), Some(at), Some(coverage)) =
            (place(&row), number("distance_m"), number("coverage"))
        {
            groups[group].runs[run].curve.push((at, coverage));
        }
    }
    groups
}

/// A row, taken apart.
struct Told {
    axes: Row,
    seed: u64,
    map: String,
    rest: BTreeMap<String, Cell>,
}

fn rows(table: &Table) -> impl Iterator<Item = Told> {
    let seed = table.column(SEED).unwrap_or(0);
    table.rows.iter().map(move |row| {
        let named = || table.names.iter().cloned().zip(row.iter().cloned());
        let mut rest: BTreeMap<String, Cell> = named().skip(seed + 1).collect();
        let map = match rest.remove(MAP) {
            Some(Cell::Text(map)) => map,
            _ => String::new(),
        };
        let seed_of = |cell: &Cell| if let Cell::Count(seed) = cell { *seed } else { 0 };
        let axes = named().take(seed).collect();
        Told { axes, seed: row.get(seed).map_or(0, seed_of), map, rest }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(scale: f64, seed: u64, map: &str, more: &[(&str, Cell)]) -> Row {
        let mut row: Row = vec![
            ("odometry.scale".into(), scale.into()),
            (SEED.into(), seed.into()),
            (MAP.into(), map.into()),
        ];
        row.extend(more.iter().map(|(name, cell)| ((*name).to_owned(), cell.clone())));
        row
    }

    fn result(scale: f64, seed: u64, map: &str, d_max_m: Option<f64>) -> Row {
        let told = d_max_m.map_or(Cell::Null, Cell::Number);
        let flags = [
            ("believed_complete", Cell::Flag(true)),
            ("false_completion", Cell::Flag(d_max_m.is_none())),
            ("d_max_m", told),
        ];
        row(scale, seed, map, &flags)
    }

    #[test]
    fn runs_are_gathered_over_their_seeds() {
        let results = Table::of([
            result(0.5, 1, "relative", Some(300.0)),
            result(0.5, 1, "grid", None),
            result(0.5, 2, "relative", Some(340.0)),
            result(0.5, 2, "grid", Some(200.0)),
            result(1.0, 1, "relative", Some(400.0)),
        ]);
        let timing = Table::of([
            row(0.5, 2, "relative", &[("wall_secs", 2.0.into())]),
            row(0.5, 1, "relative", &[("wall_secs", 1.0.into())]),
        ]);
        let curves = Table::of([
            row(0.5, 2, "grid", &[("distance_m", 0.0.into()), ("coverage", 0.1.into())]),
            row(0.5, 2, "grid", &[("distance_m", 5.0.into()), ("coverage", 1.0.into())]),
        ]);
        let groups = groups(&results, &timing, &curves);
        let told: Vec<(&str, usize)> =
            groups.iter().map(|group| (group.map.as_str(), group.runs.len())).collect();
        assert_eq!(told, [("relative", 2), ("grid", 2), ("relative", 1)]);
        assert_eq!(groups[0].mean("d_max_m").map(|mean| mean.mean), Some(320.0));
        assert_eq!(groups[0].cost("wall_secs"), Some(2.0));
        assert_eq!(groups[1].mean("d_max_m").map(|mean| mean.count), Some(1));
        assert_eq!(groups[1].success().map(|share| (share.hits, share.of)), Some((1, 2)));
        assert_eq!(groups[1].wrong().map(|share| share.hits), Some(1));
        assert_eq!(groups[1].runs[1].curve, [(0.0, 0.1), (5.0, 1.0)]);
        assert_eq!(groups[2].axis("odometry.scale"), Some(&Cell::Number(1.0)));
        assert_eq!(groups[2].axis("seed"), None);
    }
}
