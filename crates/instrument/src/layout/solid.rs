//! Which views the recording of work on a mesh opens with.

use rerun::external::re_sdk_types::blueprint::components::ContainerKind;
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View};
use super::parts::{night, send_written};
use crate::recording::{ABOUT, RESULT};

/// Sends the layout: space on the left; text and events on the right. `panels` are the 3D views: a
/// title, and the entities that each shows.
pub(crate) fn send_solid(
    stream: &RecordingStream,
    panels: &[(&str, &[&str])],
) -> Result<(), String> {
    send_written(stream, |layout| write(layout, panels))
}

fn write(layout: &mut Layout<'_>, panels: &[(&str, &[&str])]) -> RecordingStreamResult<()> {
    let dark = night();
    let mut spaces = Vec::new();
    for (title, entities) in panels {
        spaces.push(layout.view(&View {
            class: "3D",
            name: (*title).to_owned(),
            origin: "/".to_owned(),
            contents: entities.iter().map(|entity| format!("+ /{entity}/**")).collect(),
            properties: vec![("Background", &dark)],
        })?);
    }
    let shares = vec![1.0; spaces.len()];
    let space = layout.container(ContainerKind::Vertical, &spaces, &shares)?;
    let texts = layout.texts(&[("read me", ABOUT), ("result", RESULT)])?;
    let contents = vec!["+ $origin/**".to_owned()];
    let events = layout.log("/events", contents, [TextLogColumnKind::Body])?;
    let side = layout.container(ContainerKind::Vertical, &[texts, events], &[1.0, 1.0])?;
    layout.container(ContainerKind::Horizontal, &[space, side], &[2.4, 1.0])?;
    layout.finish("event", 2.0, false)
}
