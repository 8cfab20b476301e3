//! Which views the recording of a plan opens with.

use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View};
use super::parts::{night, send_written};
use crate::recording::{ABOUT, RESULT};

/// The views of space: a title, and the entities that each shows.
const SPACES: [(&str, &[&str]); 2] = [
    ("search: closed green, way violet", &["search", "graph", "ends", "space/frontier", "input"]),
    ("path: way violet, shortened green", &["path", "ends", "input"]),
];

/// Sends the layout: the search above the path on the left; texts, plots and events on the right.
pub(crate) fn send_plan(stream: &RecordingStream) -> Result<(), String> {
    send_written(stream, write)
}

fn write(layout: &mut Layout<'_>) -> RecordingStreamResult<()> {
    let dark = night();
    let mut spaces = Vec::new();
    for (title, entities) in SPACES {
        spaces.push(layout.view(&View {
            class: "3D",
            name: title.to_owned(),
            origin: "/".to_owned(),
            contents: entities.iter().map(|entity| format!("+ /{entity}/**")).collect(),
            properties: vec![("Background", &dark)],
        })?);
    }
    let space = layout.container(ContainerKind::Vertical, &spaces, &[1.0, 1.0])?;
    let texts = layout.texts(&[("read me", ABOUT), ("result", RESULT)])?;
    let plots = layout.plot(
        "metres",
        Corner2D::LeftTop,
        ["cost_m", "total_m", "length_m"].map(|name| format!("/plots/plan/{name}")),
    )?;
    let contents = vec!["+ $origin/**".to_owned()];
    let events = layout.log("/events", contents, [TextLogColumnKind::Body])?;
    let side =
        layout.container(ContainerKind::Vertical, &[texts, plots, events], &[1.2, 0.8, 1.0])?;
    layout.container(ContainerKind::Horizontal, &[space, side], &[2.2, 1.0])?;
    layout.finish("event", 20.0, false)
}
