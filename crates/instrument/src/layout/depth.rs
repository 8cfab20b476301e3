//! Which views the recording of a depth image opens with.

use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, PlotLegend, TextLogColumns,
};
use rerun::external::re_sdk_types::blueprint::components::{
    BackgroundKind, ContainerKind, Corner2D,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};

use super::arrange::{Layout, View};
use crate::recording::{ABOUT, send_layout};

/// Sends the layout: the polyhedron on the left; the image, plots and events on the right.
pub(crate) fn send_depth(stream: &RecordingStream) -> Result<(), String> {
    let store = RecordingStreamBuilder::new("driftlab").blueprint().memory();
    let (blueprint, storage) = store.map_err(|e| e.to_string())?;
    blueprint.set_time_sequence("blueprint", 0);
    write(&blueprint).map_err(|e| e.to_string())?;
    send_layout(stream, storage.take());
    Ok(())
}

fn write(stream: &RecordingStream) -> RecordingStreamResult<()> {
    let mut layout = Layout { stream, count: 0 };
    let night = rerun::Color::from_rgb(16, 18, 24);
    let dark = Background::new(BackgroundKind::SolidColor).with_color(night);
    let solid = layout.view(&View {
        class: "3D",
        name: "polyhedron: grey obstacle, orange frontier".to_owned(),
        origin: "/view".to_owned(),
        contents: vec!["+ $origin/**".to_owned()],
        properties: vec![("Background", &dark)],
    })?;
    let about = layout.view(&View {
        class: "TextDocument",
        name: "read me".to_owned(),
        origin: format!("/{ABOUT}"),
        contents: vec!["+ $origin".to_owned()],
        properties: vec![],
    })?;
    let image = layout.view(&View {
        class: "2D",
        name: "depth image, frontier, edges of the mesh".to_owned(),
        origin: "/image".to_owned(),
        contents: vec!["+ $origin/**".to_owned()],
        properties: vec![],
    })?;
    let first = layout.container(ContainerKind::Tabs, &[image, about], &[])?;
    let legend = PlotLegend::new().with_corner(Corner2D::RightTop);
    let mut plots = Vec::new();
    for (name, series) in [
        ("distance of the measured points, metres", ["rms_m", "p95_m"]),
        ("contribution or distance of single pixels, metres", ["contribution_m", "error_m"]),
    ] {
        plots.push(layout.view(&View {
            class: "TimeSeries",
            name: name.to_owned(),
            origin: "/".to_owned(),
            contents: series.iter().map(|one| format!("+ /plots/{one}")).collect(),
            properties: vec![("PlotLegend", &legend)],
        })?);
    }
    let plots = layout.container(ContainerKind::Vertical, &plots, &[])?;
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
    let side =
        layout.container(ContainerKind::Vertical, &[first, plots, events], &[1.3, 1.3, 0.6])?;
    layout.container(ContainerKind::Horizontal, &[solid, side], &[1.8, 1.0])?;
    layout.finish("vertices", 2.0, false)
}
