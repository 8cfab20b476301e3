//! The tables of a report.

use super::published::beside;
use super::stats::{Mean, Share};
use super::{Group, Study};

/// A table as people read it; the first `names` columns hold names, the others numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TextTable {
    /// One cell for each column.
    pub(crate) header: Vec<String>,
    /// The rows.
    pub(crate) rows: Vec<Vec<String>>,
    /// How many columns are names.
    pub(crate) names: usize,
}

impl TextTable {
    /// A table with a row for each group: the axes, the map, and what `of` tells.
    fn of_groups(study: &Study, columns: &[&str], of: impl Fn(&Group) -> Vec<String>) -> Self {
        let axes: Vec<String> = study.axes().into_iter().map(|(axis, _)| axis).collect();
        let mut header = axes.clone();
        header.push("map".to_owned());
        header.extend(columns.iter().map(|&column| column.to_owned()));
        let rows = study.groups.iter().map(|group| {
            let mut row: Vec<String> = axes
                .iter()
                .map(|axis| group.axis(axis).map_or_else(String::new, |value| value.shown()))
                .collect();
            row.push(group.map.clone());
            row.extend(of(group));
            row
        });
        Self { header, rows: rows.collect(), names: axes.len() + 1 }
    }
}

/// What came of the runs.
pub(crate) fn results(study: &Study) -> TextTable {
    let columns = [
        "runs",
        "complete and true",
        "95 %",
        "wrongly complete",
        "coverage",
        "least",
        "d_max m",
        "d_exp m",
        "collisions",
    ];
    TextTable::of_groups(study, &columns, |group| {
        let coverage = group.mean("coverage");
        let least = group.runs.iter().filter_map(|run| run.number("coverage")).reduce(f64::min);
        let collisions: f64 = group.runs.iter().filter_map(|run| run.number("collisions")).sum();
        vec![
            group.runs.len().to_string(),
            count(group.success()),
            interval(group.success()),
            count(group.wrong()),
            coverage.map_or_else(none, |mean| format!("{:.3}", mean.mean)),
            least.map_or_else(none, |least| format!("{least:.3}")),
            spread(group.mean("d_max_m"), group.runs.len()),
            spread(group.mean("d_exp_m"), group.runs.len()),
            format!("{collisions}"),
        ]
    })
}

/// What each map believed, how right it was and what it cost, one below the other.
pub(crate) fn summary(study: &Study) -> TextTable {
    let columns = [
        "complete and true",
        "wrongly complete",
        "coverage",
        "free space, IoU",
        "poses off by, m",
        "step, µs",
        "corrections, s",
    ];
    TextTable::of_groups(study, &columns, |group| {
        let mean = |name: &str| group.mean(name).map_or_else(none, |m| format!("{:.3}", m.mean));
        let cost = |name: &str, digits: usize| {
            group.cost(name).map_or_else(none, |cost| format!("{cost:.digits$}"))
        };
        vec![
            count(group.success()),
            count(group.wrong()),
            mean("coverage"),
            mean("free_iou"),
            mean("ate_m"),
            cost("step_micros_median", 0),
            cost("correction_secs", 3),
        ]
    })
}

/// How far the robot drove until every cell was seen, and until no frontier was left (\[Zie18\] 3.3).
pub(crate) fn times(study: &Study) -> TextTable {
    let mut columns = vec!["every cell seen, m", "no frontier left, m", "after all was seen, m"];
    let has_grid = study.groups.iter().any(|group| study.measured(group, "times_grid").is_some());
    if has_grid {
        columns.push("times the grid");
    }
    TextTable::of_groups(study, &columns, |group| {
        let after = group
            .runs
            .iter()
            .filter_map(|run| Some(run.number("no_frontier_m")? - run.number("all_seen_m")?));
        let mut row = vec![
            spread(group.mean("all_seen_m"), group.runs.len()),
            spread(group.mean("no_frontier_m"), group.runs.len()),
            spread(Mean::of(after), group.runs.len()),
        ];
        if has_grid {
            let times = study.measured(group, "times_grid");
            row.push(times.map_or_else(none, |mean| format!("{:.2}", mean.mean)));
        }
        row
    })
}

/// What a step and a run cost: medians over the runs.
pub(crate) fn costs(study: &Study) -> TextTable {
    let columns =
        ["step, µs", "step p99, µs", "correction, µs", "corrections, s", "map, kB", "run, s"];
    TextTable::of_groups(study, &columns, |group| {
        let told = |name: &str, scale: f64, digits: usize| {
            group.cost(name).map_or_else(none, |cost| format!("{:.digits$}", cost * scale))
        };
        vec![
            told("step_micros_median", 1.0, 0),
            told("step_micros_p99", 1.0, 0),
            told("correction_micros_median", 1.0, 0),
            told("correction_secs", 1.0, 3),
            told("map_bytes_peak", 1e-3, 0),
            told("wall_secs", 1.0, 2),
        ]
    })
}

/// Numbers that tell how right a map and its poses are, and what a column calls them.
const ACCURACY: [(&str, &str); 5] = [
    ("free_iou", "free space, IoU"),
    ("free_wrong_share", "taken for free wrongly"),
    ("wall_distance_m", "walls off by, m"),
    ("ate_m", "poses off by (ATE), m"),
    ("map_invalid", "map invalid, times"),
];

/// How right the maps and their poses were; `None` where no group tells.
pub(crate) fn accuracy(study: &Study) -> Option<TextTable> {
    let told =
        |&(name, _): &(&str, &str)| study.groups.iter().any(|group| group.mean(name).is_some());
    let (names, titles): (Vec<&str>, Vec<&str>) = ACCURACY.into_iter().filter(told).unzip();
    (!names.is_empty()).then(|| {
        TextTable::of_groups(study, &titles, |group| {
            let told = |name: &&str| {
                let mean = group.mean(name);
                mean.map_or_else(none, |mean| plus_minus(mean, 3))
            };
            names.iter().map(told).collect()
        })
    })
}

/// Published numbers beside ours; `None` where nothing was published.
pub(crate) fn published(study: &Study) -> Option<TextTable> {
    let axes: Vec<String> = study.axes().into_iter().map(|(axis, _)| axis).collect();
    let mut header = axes.clone();
    let columns = ["map", "what", "source", "published", "ours", "runs", "difference"];
    header.extend(columns.map(str::to_owned));
    let mut rows = Vec::new();
    for group in &study.groups {
        for one in beside(study, group) {
            let mut row: Vec<String> = axes
                .iter()
                .map(|axis| group.axis(axis).map_or_else(String::new, |value| value.shown()))
                .collect();
            let digits = if one.what.ends_with("_m") { 1 } else { 2 };
            row.extend([
                group.map.clone(),
                one.what.clone(),
                one.source.clone(),
                format!("{:.digits$}", one.published),
                one.ours.map_or_else(none, |ours| format!("{ours:.digits$}")),
                one.runs.to_string(),
                one.difference().map_or_else(none, |share| format!("{share:+.0} %")),
            ]);
            rows.push(row);
        }
    }
    (!rows.is_empty()).then(|| TextTable { header, rows, names: axes.len() + 3 })
}

fn none() -> String {
    "–".to_owned()
}

fn count(share: Option<Share>) -> String {
    share.map_or_else(none, |share| format!("{}/{}", share.hits, share.of))
}

fn interval(share: Option<Share>) -> String {
    share.map_or_else(none, |share| format!("{:.2}–{:.2}", share.low, share.high))
}

/// Mean and deviation; with the number of samples where not all runs gave one.
fn spread(mean: Option<Mean>, runs: usize) -> String {
    match mean {
        None => none(),
        Some(mean) if mean.count == runs => plus_minus(mean, 1),
        Some(mean) => format!("{} ({})", plus_minus(mean, 1), mean.count),
    }
}

/// Mean and deviation; one sample has none.
fn plus_minus(mean: Mean, digits: usize) -> String {
    let Mean { count, mean, deviation } = mean;
    if count > 1 {
        format!("{mean:.digits$} ± {deviation:.digits$}")
    } else {
        format!("{mean:.digits$}")
    }
}
