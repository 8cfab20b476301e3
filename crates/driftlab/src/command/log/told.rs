//! What is said of every log.

use formats::log::{Stamp, Topic};
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::out::Out;
use super::super::table::table;
use crate::logs::LogSource;

/// Time from the first message to the last.
pub(super) fn span(topics: &[Topic]) -> Option<(Stamp, Stamp)> {
    let first = topics.iter().filter_map(|topic| topic.first).min()?;
    let last = topics.iter().filter_map(|topic| topic.last).max()?;
    Some((first, last))
}

/// `topics`, `start`, `end`, `damaged_at` of a log that was read to its end.
pub(super) fn json(source: &LogSource) -> Value {
    let topics: Vec<Value> = source
        .topics()
        .iter()
        .map(|topic| {
            json!({
                "name": topic.name,
                "schema": topic.schema,
                "encoding": topic.encoding,
                "messages": topic.messages,
                "kind": topic.kind.map(|kind| kind.to_string()),
                "copy_of": topic.copy_of,
                "refused": topic.refused,
                "rate_hz": topic.rate_hz(),
            })
        })
        .collect();
    let span = span(source.topics());
    json!({
        "topics": topics,
        "start": span.map(|(start, _)| start.secs()),
        "end": span.map(|(_, end)| end.secs()),
        "damaged_at": source.damage().map(|damage| damage.at),
        "damage": source.damage().map(|damage| damage.what.clone()),
    })
}

/// The same for people.
pub(super) fn text(source: &LogSource) -> String {
    let header = ["topic", "type", "encoding", "read as", "messages", "refused", "Hz", "from s"];
    let start = span(source.topics()).map(|(start, _)| start);
    let rows: Vec<Vec<String>> = source
        .topics()
        .iter()
        .map(|topic| {
            let read_as = match (&topic.kind, &topic.copy_of) {
                (Some(_), Some(other)) => format!("copy of {other}"),
                (Some(kind), None) => kind.to_string(),
                (None, _) => "-".to_owned(),
            };
            let number = |number: Option<f64>, digits| {
                number.map_or_else(|| "-".to_owned(), |number| format!("{number:.digits$}"))
            };
            let after = topic.first.zip(start).map(|(first, start)| first.secs_since(start));
            vec![
                topic.name.clone(),
                topic.schema.clone(),
                topic.encoding.clone(),
                read_as,
                topic.messages.to_string(),
                topic.refused.to_string(),
                number(topic.rate_hz(), 2),
                number(after, 3),
            ]
        })
        .collect();
    let time = match span(source.topics()) {
        Some((start, end)) => {
            format!("{:.3} s, from {start} to {end}", end.secs_since(start))
        }
        None => "no message".to_owned(),
    };
    let damage = match source.damage() {
        Some(damage) => format!("at {damage}"),
        None => "none".to_owned(),
    };
    format!("{}\ntime    {time}\ndamage  {damage}\n", table(&header, &rows, 4))
}

/// What was odd, on standard error.
pub(super) fn warn(name: &str, source: &LogSource, out: &Out) {
    for warning in source.warnings() {
        out.note(&format!("warning: {name}: {warning}"));
    }
}

/// Reads a log to its end and drops what it says.
pub(super) fn exhaust(source: &mut LogSource) -> Result<(), Failure> {
    while source.next_message()?.is_some() {}
    Ok(source.expect_topics()?)
}
