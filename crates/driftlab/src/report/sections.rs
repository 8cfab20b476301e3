//! What a report consists of.

use super::chart::Chart;
use super::curves::coverage_plots;
use super::over_axes::{QUANTITIES, axis_plots, times_plot};
use super::page::{Plot, Section};
use super::published::{reasons, steers};
use super::tables::{accuracy, costs, published, results, summary, times};
use super::{ReportError, Study};

/// More plots of one kind than that are not looked at.
const MOST_PLOTS: usize = 36;

/// The sections of all studies, one after the other.
///
/// # Errors
/// A plot that cannot be drawn.
pub(crate) fn sections(studies: &[Study]) -> Result<Vec<Section>, ReportError> {
    let mut all = Vec::new();
    for (at, study) in studies.iter().enumerate() {
        one_study(study, &format!("{}-{}", at + 1, study.name), &mut all)?;
    }
    Ok(all)
}

fn one_study(study: &Study, stem: &str, all: &mut Vec<Section>) -> Result<(), ReportError> {
    let part = |title: &str, text: &str| Section {
        title: title.to_owned(),
        level: 2,
        text: text.to_owned(),
        ..Section::default()
    };
    let runs: usize = study.groups.iter().map(|group| group.runs.len()).sum();
    let mut text = study.about.clone();
    if !text.is_empty() {
        text.push_str("\n\n");
    }
    text.push_str(&format!("{runs} runs, from {}.", study.folder.display()));
    all.push(Section { title: study.name.clone(), level: 1, text, ..Section::default() });

    let told = "What each map believed at the end, how right it was, and what it cost: means over the \
                runs, and medians of the costs. More of each below.";
    all.push(Section { table: Some(summary(study)), ..part("In one table", told) });

    let told = "Means over the runs ± one standard deviation. Distances count only for runs that \
                ended complete and true; where these are not all, their number stands in brackets. \
                95 %: Wilson's interval of the share that ended so.";
    let mut told = told.to_owned();
    if let Some(drive) = study.groups.first().and_then(|group| steers(study, group)) {
        told.push_str(&format!(
            " One robot, steered by `{drive}`: every other map is fed the same scans, and is complete \
             only if it has nothing left where that one stops. Distances are those at which that was so."
        ));
    }
    all.push(Section { table: Some(results(study)), ..part("Results", &told) });
    if let Some(table) = published(study) {
        let told = "Means beside the published ones; the difference is ours less theirs, as a share \
                    of theirs. `success` is the share of runs that ended complete and true.";
        all.push(Section { table: Some(table), ..part("Beside the published numbers", told) });
        let why = reasons(study).join("\n\n");
        if !why.is_empty() {
            all.push(part("Why ours differ", &why));
        }
    }
    for quantity in &QUANTITIES {
        let title = format!("{} over the axes", quantity.label);
        add_plots(&title, "", axis_plots(study, quantity), stem, all)?;
    }
    let told = "The mean over the runs, and the band from the least to the greatest. A run that \
                has ended keeps its coverage. The robot drives at 1 m/s: metres are seconds.";
    add_plots("Coverage over distance", told, coverage_plots(study), stem, all)?;

    let told = "Until every cell was seen, and until no frontier was left; means over the runs in \
                which it came to that. Between the two the robot looks for what is not there.";
    all.push(Section { table: Some(times(study)), ..part("All seen, and nothing left", told) });
    let plot = times_plot(study);
    if !plot.is_empty() && plot.places.len() <= MOST_PLOTS {
        add_plots("All seen, and nothing left, drawn", "", vec![plot], stem, all)?;
    }
    if let Some(table) = accuracy(study) {
        let told = "How right the map and its poses were at the end.";
        all.push(Section { table: Some(table), ..part("Accuracy", told) });
    }
    let told = "Medians over the runs. A step is what the map and the policy take, without the \
                simulator. A correction is the optimisation and all that the map does anew for it; it \
                is part of the step in which it happens.";
    all.push(Section { table: Some(costs(study)), ..part("Cost", told) });
    Ok(())
}

fn add_plots(
    title: &str,
    text: &str,
    charts: Vec<Chart>,
    stem: &str,
    all: &mut Vec<Section>,
) -> Result<(), ReportError> {
    if charts.is_empty() {
        return Ok(());
    }
    let mut text = text.to_owned();
    if charts.len() > MOST_PLOTS {
        text.push_str(&format!(" The first {MOST_PLOTS} of {} plots.", charts.len()));
    }
    let mut plots = Vec::new();
    for (at, chart) in charts.iter().take(MOST_PLOTS).enumerate() {
        let word: String = title
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' })
            .collect();
        let file = format!("{stem}-{word}-{:02}.svg", at + 1);
        let about = format!("{title}: {}", chart.title);
        let svg = chart.to_svg();
        let svg = svg.map_err(|reason| ReportError::Plot { plot: about.clone(), reason })?;
        plots.push(Plot { file, about, svg });
    }
    all.push(Section { title: title.to_owned(), level: 2, text, plots, ..Section::default() });
    Ok(())
}
