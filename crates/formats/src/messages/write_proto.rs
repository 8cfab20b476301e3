//! Messages that are written as protocol buffers: exact scans, edges, and scenes.

use std::collections::BTreeMap;

use pose::Se2;

use super::decoder::{BEARING_STEP, RANGE_MAX, RANGE_MIN};
use super::proto::Writer;
use crate::log::{
    Decision, DecisionMessage, EdgeMessage, ScanMessage, SceneEntity, Stamp, StandingMessage,
};

fn stamp(writer: &mut Writer, number: u32, stamp: Stamp) {
    let (secs, nanos) = stamp.parts();
    writer.message(number, |at| _ = at.varint(1, secs as u64).varint(2, u64::from(nanos)));
}

/// `foxglove.LaserScan`.
pub(crate) fn scan(message: &ScanMessage) -> Vec<u8> {
    let mut writer = Writer::default();
    stamp(&mut writer, 1, message.header.stamp);
    writer.text(2, &message.header.frame);
    let pose = message.frame_from_sensor.unwrap_or_default();
    writer.message(3, |at| {
        at.message(1, |at| numbers(at, pose.translation.as_slice()));
        at.message(2, |at| numbers(at, pose.rotation.coords.as_slice()));
    });
    let scan = &message.scan;
    writer.double(4, scan.first_bearing_rad).double(5, last_bearing_rad(message));
    writer.doubles(6, &scan.ranges_m);
    writer.bytes
}

fn last_bearing_rad(message: &ScanMessage) -> f64 {
    let gaps = message.scan.len().saturating_sub(1) as f64;
    message.scan.first_bearing_rad + message.scan.bearing_step_rad * gaps
}

/// What the metadata of a channel must tell so that its scans come back bit for bit.
pub(crate) fn scan_metadata(message: &ScanMessage) -> BTreeMap<String, String> {
    let pair = |key: &str, value: f64| (key.to_owned(), format!("{value:?}"));
    BTreeMap::from([
        pair(RANGE_MIN, message.range_min_m),
        pair(RANGE_MAX, message.scan.range_max_m),
        pair(BEARING_STEP, message.scan.bearing_step_rad),
    ])
}

fn numbers(writer: &mut Writer, numbers: &[f64]) {
    for (number, &value) in (1..).zip(numbers) {
        writer.double(number, value);
    }
}

fn exact(writer: &mut Writer, pose: &Se2) {
    numbers(writer, &[pose.translation.x, pose.translation.y, pose.rotation.re, pose.rotation.im]);
}

/// `driftlab.Edge`.
pub(crate) fn edge(message: &EdgeMessage) -> Vec<u8> {
    let mut writer = Writer::default();
    stamp(&mut writer, 1, message.stamp);
    writer.varint(2, u64::from(message.a)).varint(3, u64::from(message.b));
    writer.varint(4, u64::from(message.place));
    writer.message(5, |at| exact(at, &message.a_from_b));
    writer.bytes
}

/// `driftlab.Standing`.
pub(crate) fn standing(message: &StandingMessage) -> Vec<u8> {
    let mut writer = Writer::default();
    stamp(&mut writer, 1, message.stamp);
    writer.varint(2, u64::from(message.vertex));
    writer.message(3, |at| exact(at, &message.vertex_from_body));
    writer.bytes
}

/// `driftlab.Decision`.
pub(crate) fn decision(message: &DecisionMessage) -> Vec<u8> {
    let mut writer = Writer::default();
    stamp(&mut writer, 1, message.stamp);
    writer.text(2, &message.map);
    match &message.decision {
        Decision::GaveUp { vertex, vertex_from_body, goal_in_body, radius_m, everywhere } => {
            writer.varint(3, u64::from(*vertex));
            writer.message(4, |at| exact(at, vertex_from_body));
            writer.message(5, |at| numbers(at, goal_in_body));
            writer.double(6, *radius_m).varint(7, u64::from(*everywhere));
        }
        Decision::LookedAgain => _ = writer.varint(8, 1),
    }
    writer.bytes
}

/// `foxglove.SceneUpdate`: the entities replace those of the same names.
pub(crate) fn scene(at: Stamp, entities: &[SceneEntity]) -> Vec<u8> {
    const LINE_LIST: u64 = 2;
    let mut writer = Writer::default();
    for entity in entities {
        writer.message(2, |out| {
            stamp(out, 1, at);
            out.text(2, &entity.frame).text(3, &entity.id);
            // It moves with its frame.
            out.varint(5, 1);
            for dot in &entity.dots {
                out.message(9, |out| {
                    out.message(1, |out| {
                        out.message(1, |out| numbers(out, &dot.at));
                        out.message(2, |out| _ = out.double(4, 1.0));
                    });
                    out.message(2, |out| numbers(out, &[dot.diameter_m; 3]));
                    out.message(3, |out| numbers(out, &dot.rgba));
                });
            }
            for lines in &entity.lines {
                out.message(11, |out| {
                    out.varint(1, LINE_LIST);
                    out.message(2, |out| _ = out.message(2, |out| _ = out.double(4, 1.0)));
                    out.double(3, lines.width_px).varint(4, 1);
                    for end in lines.segments.iter().flatten() {
                        out.message(5, |out| numbers(out, end));
                    }
                    out.message(6, |out| numbers(out, &lines.rgba));
                });
            }
        });
    }
    writer.bytes
}
