//! What a recording holds.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use explore::{GraphEvent, PlannerEvent};
use maps2d::correction::CorrectionEvent;
use maps2d::grid::GridEvent;
use maps2d::polygons::PolygonEvent;
use maps2d::relative::ConsolidationEvent;
use maps2d::volume::VolumeEvent;
use rerun::log::Chunk;
use serde_json::{Value, json};

use super::read::read;
use crate::columns::VARIANT;
use crate::recording::METRICS;
use crate::{Family, InstrumentError};

/// The event families with the names of all variants that their algorithms declare.
pub fn declared_events() -> [(Family, &'static [&'static str]); 7] {
    [
        (Family::Sensing, VolumeEvent::VARIANTS),
        (Family::PoseGraph, GraphEvent::VARIANTS),
        (Family::Consolidation, ConsolidationEvent::VARIANTS),
        (Family::Grid, GridEvent::VARIANTS),
        (Family::Planner, PlannerEvent::VARIANTS),
        (Family::Correction, CorrectionEvent::VARIANTS),
        (Family::Polygons, PolygonEvent::VARIANTS),
    ]
}

/// One entity of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntityInfo {
    /// Its path.
    pub path: String,
    /// Rows in time.
    pub rows: u64,
    /// Rows that hold at all times.
    pub static_rows: u64,
    /// Its size in the file, bytes.
    pub bytes: u64,
    /// Its components.
    pub components: Vec<String>,
}

/// One timeline of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimelineInfo {
    /// Its name.
    pub name: String,
    /// `sequence`, `duration_ns` or `timestamp_ns`.
    pub kind: &'static str,
    /// The first time on it.
    pub first: i64,
    /// The last time on it.
    pub last: i64,
}

/// How often an event happened.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EventCount {
    /// Whose event: the path before `events`, such as `/relative`.
    pub map: String,
    /// The family, as in its path.
    pub family: String,
    /// The variant.
    pub variant: String,
    /// How often.
    pub count: u64,
}

/// What a recording holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// The file.
    pub path: PathBuf,
    /// Its size, bytes.
    pub bytes: u64,
    /// What is wrong with the file; everything else was read before the damage.
    pub damage: Option<String>,
    /// Whether it opens with a layout of its own.
    pub has_layout: bool,
    /// All entities, by path.
    pub entities: Vec<EntityInfo>,
    /// All timelines, by name.
    pub timelines: Vec<TimelineInfo>,
    /// All events, by map, family and variant.
    pub events: Vec<EventCount>,
    /// The final metrics; `None` in a recording of a run that did not end.
    pub metrics: Option<Value>,
}

impl Inspection {
    /// The same as JSON, with the names of the fields as keys.
    pub fn to_json(&self) -> Value {
        let entities = self.entities.iter().map(|entity| {
            json!({
                "path": entity.path,
                "rows": entity.rows,
                "static_rows": entity.static_rows,
                "bytes": entity.bytes,
                "components": entity.components,
            })
        });
        let timelines = self.timelines.iter().map(|timeline| {
            json!({
                "name": timeline.name,
                "kind": timeline.kind,
                "first": timeline.first,
                "last": timeline.last,
            })
        });
        let events = self.events.iter().map(|event| {
            json!({
                "map": event.map,
                "family": event.family,
                "variant": event.variant,
                "count": event.count,
            })
        });
        json!({
            "path": self.path.display().to_string(),
            "bytes": self.bytes,
            "damage": self.damage,
            "has_layout": self.has_layout,
            "rows": self.entities.iter().map(|entity| entity.rows).sum::<u64>(),
            "entities": entities.collect::<Vec<_>>(),
            "timelines": timelines.collect::<Vec<_>>(),
            "events": events.collect::<Vec<_>>(),
            "metrics": self.metrics,
        })
    }
}

#[derive(Default)]
struct EntityTally {
    rows: u64,
    static_rows: u64,
    bytes: u64,
    components: BTreeSet<String>,
}

#[derive(Default)]
struct Tally {
    entities: BTreeMap<String, EntityTally>,
    timelines: BTreeMap<String, (&'static str, i64, i64)>,
    events: BTreeMap<(String, String, String), u64>,
    metrics: Option<Value>,
}

impl Tally {
    fn add(&mut self, chunk: &Chunk, bytes: u64) {
        let path = chunk.entity_path().to_string();
        let entity = self.entities.entry(path.clone()).or_default();
        let rows = chunk.num_rows() as u64;
        if chunk.is_static() {
            entity.static_rows += rows;
        } else {
            entity.rows += rows;
        }
        entity.bytes += bytes;
        let components = chunk.components_identifiers().map(|component| component.to_string());
        entity.components.extend(components);
        let mut timelines: Vec<_> = chunk.timelines().iter().collect();
        timelines.sort_by_key(|(name, _)| name.to_string());
        for (name, times) in timelines {
            let kind = match times.timeline().typ() {
                rerun::time::TimeType::Sequence => "sequence",
                rerun::time::TimeType::DurationNs => "duration_ns",
                rerun::time::TimeType::TimestampNs => "timestamp_ns",
            };
            let raw = times.times_raw();
            let (Some(first), Some(last)) = (raw.iter().min(), raw.iter().max()) else { continue };
            let known = self.timelines.entry(name.to_string()).or_insert((kind, *first, *last));
            known.1 = known.1.min(*first);
            known.2 = known.2.max(*last);
        }
        if let Some((map, family)) = path.rsplit_once("/events/") {
            for text in chunk.iter_slices::<String>(VARIANT.component).flatten() {
                let key = (map.to_owned(), family.to_owned(), text.to_string());
                *self.events.entry(key).or_default() += 1;
            }
        }
        if path.strip_prefix('/') == Some(METRICS) {
            let text = rerun::TextDocument::descriptor_text().component;
            for text in chunk.iter_slices::<String>(text).flatten() {
                self.metrics = serde_json::from_str(text.as_str()).ok();
            }
        }
    }
}

/// Reads a recording and tells what it holds; damage ends the reading, and is told.
///
/// Cost: one pass through the file.
///
/// # Errors
/// A file that cannot be opened, or in which nothing can be read.
pub fn inspect(path: &Path) -> Result<Inspection, InstrumentError> {
    let mut tally = Tally::default();
    let reading = read(path, |chunk, bytes| tally.add(chunk, bytes))?;
    let entities = tally.entities.into_iter().map(|(path, entity)| {
        let EntityTally { rows, static_rows, bytes, components } = entity;
        let components = components.into_iter().collect();
        EntityInfo { path, rows, static_rows, bytes, components }
    });
    let timelines = tally.timelines.into_iter().map(|(name, (kind, first, last))| TimelineInfo {
        name,
        kind,
        first,
        last,
    });
    let events = tally.events.into_iter().map(|((map, family, variant), count)| EventCount {
        map,
        family,
        variant,
        count,
    });
    Ok(Inspection {
        path: path.to_owned(),
        bytes: reading.bytes,
        damage: reading.damage,
        has_layout: reading.has_layout,
        entities: entities.collect(),
        timelines: timelines.collect(),
        events: events.collect(),
        metrics: tally.metrics,
    })
}
