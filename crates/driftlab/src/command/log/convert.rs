//! `driftlab log convert`: any log as MCAP.

use std::collections::BTreeMap;
use std::io::BufWriter;

use anyhow::anyhow;
use formats::log::{Content, Header, Message, Transform, plain};
use formats::mcap::McapWriter;
use serde_json::json;

use super::super::failure::Failure;
use super::super::files::{apart, free};
use super::super::out::Out;
use super::args::ConvertArgs;
use super::told;
use crate::files::PartialFile;
use crate::logs::LogSource;

pub(super) fn convert(args: &ConvertArgs, out: &Out) -> Result<(), Failure> {
    let extension = args.output.extension().and_then(|extension| extension.to_str());
    if !extension.is_some_and(|extension| extension.eq_ignore_ascii_case("mcap")) {
        let output = args.output.display();
        return Err(Failure::Input(anyhow!("{output}: expected a name that ends with .mcap")));
    }
    let mut source = LogSource::open(&args.input)?;
    apart(&args.output, [args.input.as_path()])?;
    free(&args.output, args.force)?;
    let refused =
        |error: std::io::Error| Failure::Work(anyhow!("{}: {error}", args.output.display()));
    let unwritable =
        |error: formats::FormatError| Failure::Work(anyhow!("{}: {error}", args.output.display()));

    let waiting = PartialFile::create(&args.output).map_err(refused)?;
    let file = BufWriter::new(waiting.handle().map_err(refused)?);
    let mut writer = McapWriter::new(file).map_err(unwritable)?;
    let mut written: BTreeMap<String, u64> = BTreeMap::new();
    while let Some(message) = source.next_message()? {
        let topic = &source.topics()[message.topic];
        // What is said more exactly elsewhere is made anew from there.
        if topic.copy_of.is_some() {
            continue;
        }
        let name = topic
            .name
            .strip_prefix("/exact/")
            .map_or_else(|| topic.name.clone(), |rest| format!("/{rest}"));
        let encoding = topic.encoding.clone();
        writer.write_message(&name, &message).map_err(unwritable)?;
        if !source.is_recording()
            && let Some(transform) = transform_of(&message, &encoding)
        {
            writer
                .write("/tf", message.logged, &Content::Transforms(vec![transform]))
                .map_err(unwritable)?;
        }
        *written.entry(name).or_default() += 1;
    }
    source.expect_topics()?;
    let messages: u64 = written.values().sum();
    let name = args.input.display().to_string();
    told::warn(&name, &source, out);
    if messages == 0 {
        let types: Vec<&str> = source.topics().iter().map(|topic| topic.schema.as_str()).collect();
        return Err(Failure::Input(anyhow!(
            "{name}: found messages of {} only, expected one of a type that is read",
            types.join(", ")
        )));
    }
    let left_out = source.topics().iter().filter(|topic| topic.kind.is_none());
    let left_out: Vec<&str> = left_out.map(|topic| topic.name.as_str()).collect();
    if !left_out.is_empty() {
        const SHOWN: usize = 4;
        let shown = source.topics().iter().filter(|topic| topic.kind.is_none()).take(SHOWN);
        let shown: Vec<String> =
            shown.map(|topic| format!("{} ({})", topic.name, topic.schema)).collect();
        let more = match left_out.len().saturating_sub(SHOWN) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let shown = shown.join(", ");
        out.note(&format!("warning: {name}: left out, their types are not read: {shown}{more}"));
    }
    drop(writer.finish().map_err(unwritable)?);
    waiting.finish().map_err(refused)?;

    let file = args.output.display().to_string();
    let damaged_at = source.damage().map(|damage| damage.at);
    let text = format!("{file}: {messages} messages on {} topics\n", written.len());
    let json = json!({
        "file": file, "messages": messages, "topics": written, "left_out": left_out,
        "damaged_at": damaged_at,
    });
    out.summary(&json, &text)
}

/// A pose of a log that has no transforms, as one: viewers place everything by them.
fn transform_of(message: &Message, encoding: &str) -> Option<Transform> {
    let child = if encoding == "tum" { plain::BASE } else { "camera" };
    let (header, child, parent_from_child) = match &message.content {
        Content::Odometry(odometry) => {
            (&odometry.header, &*odometry.child_frame, odometry.odom_from_body)
        }
        Content::Pose(pose) => (&pose.header, child, pose.frame_from_body),
        _ => return None,
    };
    let header: Header = header.clone();
    Some(Transform { header, child_frame: child.into(), parent_from_child })
}
