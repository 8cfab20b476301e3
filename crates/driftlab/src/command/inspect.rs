//! `driftlab inspect`: what a recording holds.

use anyhow::Error;
use instrument::{Difference, Inspection, InstrumentError};
use serde_json::json;

use super::args::InspectArgs;
use super::failure::Failure;
use super::out::Out;
use super::table::table;
use super::view::recording;

pub(super) fn inspect(args: &InspectArgs, out: &Out) -> Result<(), Failure> {
    let file = recording(&args.file)?;
    let inspection = instrument::inspect(&file).map_err(unreadable)?;
    if let Some(damage) = &inspection.damage {
        out.note(&format!("warning: {}: {damage}; read up to there", file.display()));
    }
    let mut json = inspection.to_json();
    let mut text = shown(&inspection);
    if let Some(other) = &args.diff {
        let differences = instrument::diff(&file, &recording(other)?).map_err(unreadable)?;
        text = shown_differences(&differences);
        let entries = differences.iter().map(|difference| {
            json!({
                "entity": difference.entity,
                "component": difference.component,
                "what": difference.what,
            })
        });
        json["differences"] = entries.collect();
    }
    out.result(&json, &text)
}

/// A file that is no recording is bad input.
fn unreadable(error: InstrumentError) -> Failure {
    Failure::Input(Error::from(error))
}

fn shown(inspection: &Inspection) -> String {
    let mut text = format!("{}, {} bytes\n", inspection.path.display(), inspection.bytes);
    text.push_str(if inspection.has_layout { "opens with its layout\n" } else { "no layout\n" });

    text.push_str("\nTimelines\n");
    let rows: Vec<Vec<String>> = inspection
        .timelines
        .iter()
        .map(|line| {
            let kind = line.kind.to_owned();
            vec![line.name.clone(), kind, line.first.to_string(), line.last.to_string()]
        })
        .collect();
    text.push_str(&table(&["timeline", "kind", "first", "last"], &rows, 1));

    text.push_str("\nEntities\n");
    let rows: Vec<Vec<String>> = inspection
        .entities
        .iter()
        .map(|entity| {
            vec![entity.path.clone(), entity.rows.to_string(), entity.static_rows.to_string()]
        })
        .collect();
    text.push_str(&table(&["entity", "rows", "static"], &rows, 1));

    text.push_str("\nEvents\n");
    let rows: Vec<Vec<String>> = inspection
        .events
        .iter()
        .map(|event| {
            let name = format!("{} {} {}", event.map, event.family, event.variant);
            vec![name, event.count.to_string()]
        })
        .collect();
    text.push_str(&table(&["event", "count"], &rows, 1));

    match &inspection.metrics {
        Some(metrics) => text.push_str(&format!("\nFinal metrics\n{metrics:#}\n")),
        None => text.push_str("\nNo final metrics: the run did not end\n"),
    }
    text
}

fn shown_differences(differences: &[Difference]) -> String {
    if differences.is_empty() {
        return "the recordings say the same\n".to_owned();
    }
    let rows: Vec<Vec<String>> = differences
        .iter()
        .map(|difference| {
            let path = format!("{} {}", difference.entity, difference.component);
            vec![path, difference.what.clone()]
        })
        .collect();
    table(&["where", "difference"], &rows, 1)
}
