//! `driftlab inspect`: what a recording holds.

use std::collections::BTreeMap;

use anyhow::Error;
use instrument::{Difference, Inspection, InstrumentError};
use serde_json::{Value, json};

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
    let quarrel = inspection.metrics.as_ref().and_then(|metrics| metrics.get("disagreement"));
    json["disagreement"] = quarrel.cloned().unwrap_or(Value::Null);
    let quarrels = inspection.metrics.as_ref().and_then(|metrics| metrics.get("disagreements"));
    json["disagreements"] = quarrels.cloned().unwrap_or_else(|| json!([]));
    let mut text = shown(&inspection);
    if let Some(other) = &args.diff {
        let other = recording(other)?;
        let differences = instrument::diff(&file, &other).map_err(unreadable)?;
        let metrics = instrument::inspect(&other).map_err(unreadable)?.metrics;
        let unlike = unlike_metrics(inspection.metrics.as_ref(), metrics.as_ref());
        text = shown_differences(&differences, &unlike);
        json["differences"] = differences.iter().map(told).collect();
        json["first_difference"] = Difference::first(&differences).map_or(Value::Null, told);
        let unlike = unlike.into_iter().map(|one| {
            let Unlike { name, a, b, difference } = one;
            (name, json!({ "a": a, "b": b, "difference": difference }))
        });
        json["metric_differences"] = Value::Object(unlike.collect());
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

/// One difference in JSON.
fn told(difference: &Difference) -> Value {
    let place = difference.place();
    json!({
        "entity": difference.entity,
        "component": difference.component,
        "what": difference.what,
        "timeline": place.map(|(name, _)| name),
        "at": place.map(|(_, at)| at),
        "times": difference.times.iter().cloned().collect::<BTreeMap<_, _>>(),
    })
}

/// A final metric that two recordings tell differently.
struct Unlike {
    /// Its path, such as `relative.d_max_m`.
    name: String,
    a: Value,
    b: Value,
    /// The second less the first, where both are numbers.
    difference: Option<f64>,
}

/// The final metrics that differ, in the order in which the first recording has them.
fn unlike_metrics(a: Option<&Value>, b: Option<&Value>) -> Vec<Unlike> {
    let flat = |metrics: Option<&Value>| {
        let mut all = Vec::new();
        let maps = metrics.and_then(|metrics| metrics["maps"].as_object());
        for (map, numbers) in maps.into_iter().flatten() {
            for (name, value) in numbers.as_object().into_iter().flatten() {
                all.push((format!("{map}.{name}"), value.clone()));
            }
        }
        all
    };
    let (a, b) = (flat(a), flat(b));
    let of = |all: &[(String, Value)], name: &str| {
        all.iter().find(|(own, _)| own == name).map_or(Value::Null, |(_, value)| value.clone())
    };
    let only_b = b.iter().filter(|(name, _)| !a.iter().any(|(own, _)| own == name));
    let names = a.iter().chain(only_b).map(|(name, _)| name.clone());
    let unlike = names.map(|name| {
        let (a, b) = (of(&a, &name), of(&b, &name));
        let difference = a.as_f64().zip(b.as_f64()).map(|(a, b)| b - a);
        Unlike { name, a, b, difference }
    });
    unlike.filter(|one| one.a != one.b).collect()
}

fn shown_differences(differences: &[Difference], metrics: &[Unlike]) -> String {
    let Some(first) = Difference::first(differences) else {
        return "the recordings say the same\n".to_owned();
    };
    let at = first.place().map_or_else(String::new, |(name, at)| format!(" at {name} {at}"));
    let mut text = format!("first difference{at}: {} {}\n", first.entity, first.component);
    if !metrics.is_empty() {
        let shown = |value: &Value| match value.as_f64() {
            Some(number) if value.is_f64() => format!("{number:.4}"),
            _ => value.to_string(),
        };
        let rows: Vec<Vec<String>> = metrics
            .iter()
            .map(|one| {
                let difference = one.difference.map_or_else(String::new, |by| format!("{by:+.4}"));
                vec![one.name.clone(), shown(&one.a), shown(&one.b), difference]
            })
            .collect();
        text.push_str("\nFinal metrics that differ\n");
        text.push_str(&table(&["metric", "this", "other", "difference"], &rows, 1));
    }
    let rows: Vec<Vec<String>> = differences
        .iter()
        .map(|difference| {
            let path = format!("{} {}", difference.entity, difference.component);
            vec![path, difference.what.clone()]
        })
        .collect();
    text.push_str("\nDifferences\n");
    text.push_str(&table(&["where", "difference"], &rows, 2));
    text
}
