//! Coverage over distance, per map with its spread.

use super::chart::{Chart, Series};
use super::{Group, Study};
use crate::table::Row;

/// Points of a drawn line.
const POINTS: usize = 200;

/// One plot for each combination of the axes' values, all maps in it: the mean over the runs, and
/// the band from the least run to the greatest.
///
/// A run that has ended keeps the coverage that it ended with.
pub(crate) fn coverage_plots(study: &Study) -> Vec<Chart> {
    let mut combinations: Vec<&Row> = Vec::new();
    for group in &study.groups {
        if !combinations.contains(&&group.axes) {
            combinations.push(&group.axes);
        }
    }
    let maps = study.maps();
    let chart = |axes: &Row| {
        let groups: Vec<&Group> = study.groups.iter().filter(|group| group.axes == *axes).collect();
        let ends = groups.iter().flat_map(|group| &group.runs).filter_map(|run| run.curve.last());
        let end_m = ends.map(|&(distance_m, _)| distance_m).fold(0.0, f64::max);
        let series =
            groups.iter().filter(|group| group.runs.iter().any(|run| !run.curve.is_empty()));
        Chart {
            title: super::setting(study, axes),
            x_label: "distance, m".into(),
            y_label: "coverage".into(),
            top: Some(1.02),
            series: series
                .map(|group| {
                    let colour = maps.iter().position(|map| *map == group.map).unwrap_or(0);
                    drawn(group, end_m, colour)
                })
                .collect(),
            ..Chart::default()
        }
    };
    combinations.into_iter().map(chart).filter(|chart| !chart.is_empty()).collect()
}

fn drawn(group: &Group, end_m: f64, colour: usize) -> Series {
    let mut series = Series { name: group.map.clone(), colour, ..Series::default() };
    let last = group.runs.iter().filter_map(|run| run.curve.last()).map(|&(end, _)| end);
    let last_m = last.fold(0.0, f64::max);
    for at in 0..=POINTS {
        let distance_m = end_m * at as f64 / POINTS as f64;
        let at_m: Vec<f64> =
            group.runs.iter().filter_map(|run| at_distance(&run.curve, distance_m)).collect();
        if at_m.is_empty() {
            continue;
        }
        let mean = at_m.iter().sum::<f64>() / at_m.len() as f64;
        let low = at_m.iter().copied().fold(f64::INFINITY, f64::min);
        let high = at_m.iter().copied().fold(0.0, f64::max);
        series.line.push((distance_m, mean));
        series.band.push((distance_m, low, high));
        // Nothing happens after the end of the last run.
        if distance_m >= last_m {
            break;
        }
    }
    series
}

/// The coverage at a distance: that of the last point up to there.
fn at_distance(curve: &[(f64, f64)], distance_m: f64) -> Option<f64> {
    let after = curve.partition_point(|&(at_m, _)| at_m <= distance_m);
    curve.get(after.saturating_sub(1)).map(|&(_, coverage)| coverage)
}

#[cfg(test)]
mod tests {
    use super::super::group::Run;
    use super::*;

    #[test]
    fn means_and_bands_hold_what_was_reached() {
        let run = |curve: &[(f64, f64)]| Run { curve: curve.to_vec(), ..Run::default() };
        let runs = vec![run(&[(0.0, 0.1), (50.0, 1.0)]), run(&[(0.0, 0.3), (100.0, 0.8)])];
        let study = Study {
            groups: vec![Group { axes: Row::new(), map: "grid".into(), runs }],
            ..Study::default()
        };
        let plots = coverage_plots(&study);
        assert_eq!(plots.len(), 1);
        let series = &plots[0].series[0];
        assert_eq!(series.line.first(), Some(&(0.0, 0.2)));
        assert_eq!(series.band[120], (60.0, 0.3, 1.0));
        assert_eq!(series.line.last(), Some(&(100.0, 0.9)));
        assert_eq!(at_distance(&[], 3.0), None);
    }
}
