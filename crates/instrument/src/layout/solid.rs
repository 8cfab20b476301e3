//! Which views the recording of work on a mesh opens with.

use rerun::external::re_sdk_types::blueprint::archetypes::{Background, TextLogColumns};
use rerun::external::re_sdk_types::blueprint::components::{BackgroundKind, ContainerKind};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};

use super::arrange::{Layout, View};
use crate::recording::{ABOUT, RESULT, send_layout};

/// Sends the layout: space on the left; text and events on the right. `panels` are the 3D views: a
/// title, and the entities that each shows.
pub(crate) fn send_solid(
    stream: &RecordingStream,
    panels: &[(&str, &[&str])],
) -> Result<(), String> {
    let store = RecordingStreamBuilder::new("driftlab").blueprint().memory();
    let (blueprint, storage) = store.map_err(|e| e.to_string())?;
    blueprint.set_time_sequence("blueprint", 0);
    write(&blueprint, panels).map_err(|e| e.to_string())?;
    send_layout(stream, storage.take());
    Ok(())
}

fn write(stream: &RecordingStream, panels: &[(&str, &[&str])]) -> RecordingStreamResult<()> {
    let mut layout = Layout { stream, count: 0 };
    let night = rerun::Color::from_rgb(16, 18, 24);
    let dark = Background::new(BackgroundKind::SolidColor).with_color(night);
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
    let mut texts = Vec::new();
    for (name, origin) in [("read me", ABOUT), ("result", RESULT)] {
        texts.push(layout.view(&View {
            class: "TextDocument",
            name: name.to_owned(),
            origin: format!("/{origin}"),
            contents: vec!["+ $origin".to_owned()],
            properties: vec![],
        })?);
    }
    let texts = layout.container(ContainerKind::Tabs, &texts, &[])?;
    let columns = TextLogColumns::update_fields().with_text_log_columns(
        [TextLogColumnKind::Body].map(|kind| TextLogColumn { visible: true.into(), kind }),
    );
    let events = layout.view(&View {
        class: "TextLog",
        name: "events".to_owned(),
        origin: "/events".to_owned(),
        contents: vec!["+ $origin/**".to_owned()],
        properties: vec![("TextLogColumns", &columns)],
    })?;
    let side = layout.container(ContainerKind::Vertical, &[texts, events], &[1.0, 1.0])?;
    layout.container(ContainerKind::Horizontal, &[space, side], &[2.4, 1.0])?;
    layout.finish("event", 2.0, false)
}
