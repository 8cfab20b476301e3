//! What was measured, over the values of an axis.

use super::chart::{Bar, Chart, Series};
use super::stats::{Mean, Share};
use super::{Group, Study};
use crate::table::{Cell, Row};

/// How a number is drawn.
pub(crate) struct Quantity {
    /// What the y axis says.
    pub(crate) label: &'static str,
    /// The top of the plot, if it is always the same.
    pub(crate) top: Option<f64>,
    /// The value of a group with its interval.
    pub(crate) of: fn(&Group) -> Option<(f64, f64, f64)>,
}

/// What is drawn over each axis.
pub(crate) const QUANTITIES: [Quantity; 7] = [
    Quantity { label: "d_max, m", top: None, of: |group| group.mean("d_max_m").map(one_deviation) },
    Quantity { label: "d_exp, m", top: None, of: |group| group.mean("d_exp_m").map(one_deviation) },
    Quantity {
        label: "complete and true",
        top: Some(1.05),
        of: |group| group.success().map(|share| interval(&share)),
    },
    Quantity {
        label: "wrongly complete",
        top: Some(1.05),
        of: |group| group.wrong().map(|share| interval(&share)),
    },
    Quantity {
        label: "free space, IoU",
        top: Some(1.05),
        of: |group| group.mean("free_iou").map(one_deviation),
    },
    Quantity {
        label: "poses off by (ATE), m",
        top: None,
        of: |group| group.mean("ate_m").map(one_deviation),
    },
    Quantity {
        label: "median step, µs",
        top: None,
        of: |group| group.cost("step_micros_median").map(|cost| (cost, cost, cost)),
    },
];

fn one_deviation(mean: Mean) -> (f64, f64, f64) {
    (mean.mean, (mean.mean - mean.deviation).max(0.0), mean.mean + mean.deviation)
}

fn interval(share: &Share) -> (f64, f64, f64) {
    (share.share(), share.low, share.high)
}

/// For each axis of numbers one plot for each combination of the other axes' values.
pub(crate) fn axis_plots(study: &Study, quantity: &Quantity) -> Vec<Chart> {
    let axes = study.axes();
    let numeric = axes.iter().filter(|(_, values)| values.iter().all(|v| v.number().is_some()));
    let mut charts = Vec::new();
    for (axis, values) in numeric {
        let mut others: Vec<Row> = Vec::new();
        for group in &study.groups {
            let rest = without(&group.axes, axis);
            if !others.contains(&rest) {
                others.push(rest);
            }
        }
        for rest in others {
            charts.push(chart(study, quantity, axis, values, &rest));
        }
    }
    charts.retain(|chart| !chart.is_empty());
    charts
}

fn without(axes: &Row, axis: &str) -> Row {
    axes.iter().filter(|(name, _)| name != axis).cloned().collect()
}

fn chart(study: &Study, quantity: &Quantity, axis: &str, values: &[Cell], rest: &Row) -> Chart {
    let numbers: Vec<f64> = values.iter().filter_map(Cell::number).collect();
    let (low, high) = numbers
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    let maps = study.maps();
    let series = maps.iter().enumerate().map(|(colour, map)| {
        // Maps stand a little beside each other, so that their intervals can be told apart.
        let shift = 0.012 * (high - low) * (colour as f64 - (maps.len() - 1) as f64 / 2.0);
        let own = study
            .groups
            .iter()
            .filter(|group| group.map == *map && without(&group.axes, axis) == *rest);
        let bars = own.filter_map(|group| {
            let x = group.axis(axis)?.number()? + shift;
            let (y, low, high) = (quantity.of)(group)?;
            Some(Bar { x, y, low, high })
        });
        Series { name: map.clone(), colour, bars: bars.collect(), ..Series::default() }
    });
    Chart {
        title: super::setting(study, rest),
        x_label: axis.to_owned(),
        y_label: quantity.label.to_owned(),
        top: quantity.top,
        series: series.filter(|one| !one.bars.is_empty()).collect(),
        ..Chart::default()
    }
}

/// Until every cell was seen (rings) and until no frontier was left (discs): one plot, a place for
/// each combination of the axes' values.
pub(crate) fn times_plot(study: &Study) -> Chart {
    let mut places: Vec<&Row> = Vec::new();
    for group in &study.groups {
        if !places.contains(&&group.axes) {
            places.push(&group.axes);
        }
    }
    let maps = study.maps();
    let mut series = Vec::new();
    for (colour, map) in maps.iter().enumerate() {
        let shift = 0.7 / maps.len() as f64 * (colour as f64 - (maps.len() - 1) as f64 / 2.0);
        for (name, hollow) in [("all_seen_m", true), ("no_frontier_m", false)] {
            let own = study.groups.iter().filter(|group| group.map == *map);
            let bars: Vec<Bar> = own
                .filter_map(|group| {
                    let x = places.iter().position(|axes| **axes == group.axes)? as f64 + shift;
                    let (y, low, high) = one_deviation(group.mean(name)?);
                    Some(Bar { x, y, low, high })
                })
                .collect();
            let name = format!("{map}, {}", if hollow { "all seen" } else { "no frontier" });
            if !bars.is_empty() {
                series.push(Series { name, colour, bars, hollow, ..Series::default() });
            }
        }
    }
    Chart {
        title: "until every cell was seen, until no frontier was left".into(),
        y_label: "distance, m".into(),
        places: places.iter().map(|axes| super::short_setting(study, axes)).collect(),
        series,
        ..Chart::default()
    }
}
