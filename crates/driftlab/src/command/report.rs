//! `driftlab report`: tables and plots from folders of results.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use serde_json::{Map, Value, json};

use super::args::ReportArgs;
use super::failure::Failure;
use super::out::Out;
use crate::files::replace_file;
use crate::report::{Group, ReportError, Section, Study, beside, html, markdown, sections};

/// Names of the files in a report's folder.
const MARKDOWN: &str = "report.md";
const HTML: &str = "report.html";
const PLOTS: &str = "plots";

pub(super) fn report(args: &ReportArgs, out: &Out) -> Result<(), Failure> {
    let dir = args.out.clone().unwrap_or_else(|| PathBuf::from("recordings").join("report"));
    for name in [MARKDOWN, HTML] {
        let file = dir.join(name);
        if file.exists() && !args.force {
            let hint = "name another folder with --out, or --force to replace it";
            return Err(Failure::Input(anyhow!("{}: is there already; {hint}", file.display())));
        }
    }
    let studies: Result<Vec<Study>, ReportError> =
        args.folders.iter().map(|folder| Study::read(folder)).collect();
    let studies = studies.map_err(|error| Failure::Input(error.into()))?;
    let sections = sections(&studies).map_err(Failure::work)?;
    let names: Vec<&str> = studies.iter().map(|study| study.name.as_str()).collect();
    let title = names.join(", ");
    write(&dir, &title, &sections)?;
    let told: Vec<Value> = studies.iter().map(study_json).collect();
    let page = dir.join(HTML).display().to_string();
    let json = json!({
        "out": dir.display().to_string(),
        "html": page,
        "markdown": dir.join(MARKDOWN).display().to_string(),
        "studies": told,
    });
    out.summary(&json, &format!("{page}\n"))
}

/// The plots first and the pages last, so that a page names no plot that is not there.
fn write(dir: &Path, title: &str, sections: &[Section]) -> Result<(), Failure> {
    let put = |path: PathBuf, bytes: &[u8]| {
        replace_file(&path, bytes).map_err(|reason| unwritable(&path, &reason))
    };
    let plots = dir.join(PLOTS);
    fs::create_dir_all(&plots).map_err(|reason| unwritable(&plots, &reason))?;
    for plot in sections.iter().flat_map(|section| &section.plots) {
        put(plots.join(&plot.file), plot.svg.as_bytes())?;
    }
    put(dir.join(MARKDOWN), markdown(title, sections).as_bytes())?;
    put(dir.join(HTML), html(title, sections).as_bytes())
}

fn unwritable(path: &Path, reason: &std::io::Error) -> Failure {
    let expected = "expected a folder for the report";
    Failure::Input(anyhow!("{}: cannot be written ({reason}); {expected}", path.display()))
}

fn study_json(study: &Study) -> Value {
    json!({
        "name": study.name,
        "dir": study.folder.display().to_string(),
        "groups": study.groups.iter().map(|group| group_json(study, group)).collect::<Vec<_>>(),
    })
}

fn group_json(study: &Study, group: &Group) -> Value {
    let axes: Map<String, Value> =
        group.axes.iter().map(|(axis, value)| (axis.clone(), value.to_json())).collect();
    let mut names: Vec<&String> = group.runs.iter().flat_map(|run| run.results.keys()).collect();
    names.sort();
    names.dedup();
    let means = names.into_iter().filter_map(|name| {
        let mean = group.mean(name)?;
        let told = json!({ "mean": mean.mean, "deviation": mean.deviation, "runs": mean.count });
        Some((name.clone(), told))
    });
    let share = |share: Option<crate::report::Share>| {
        share.map(|share| {
            json!({ "count": share.hits, "of": share.of, "low": share.low, "high": share.high })
        })
    };
    let published = beside(study, group).into_iter().map(|one| {
        json!({
            "source": one.source,
            "what": one.what,
            "published": one.published,
            "ours": one.ours,
            "runs": one.runs,
            "difference_percent": one.difference(),
        })
    });
    json!({
        "axes": axes,
        "map": group.map,
        "runs": group.runs.len(),
        "success": share(group.success()),
        "false_completion": share(group.wrong()),
        "means": means.collect::<Map<_, _>>(),
        "step_micros_median": group.cost("step_micros_median"),
        "published": published.collect::<Vec<_>>(),
    })
}
