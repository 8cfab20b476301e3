//! Views that more than one layout has, and how a layout is sent.

use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, PlotLegend, TextLogColumns,
};
use rerun::external::re_sdk_types::blueprint::components::{
    BackgroundKind, ContainerKind, Corner2D,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};

use super::arrange::{Layout, View, Written};
use crate::palette;
use crate::recording::send_layout;

/// Sends what `write` lays out along with a recording.
pub(super) fn send_written(
    stream: &RecordingStream,
    write: impl FnOnce(&mut Layout<'_>) -> RecordingStreamResult<()>,
) -> Result<(), String> {
    let store = RecordingStreamBuilder::new("driftlab").blueprint().memory();
    let (blueprint, storage) = store.map_err(|e| e.to_string())?;
    blueprint.set_time_sequence("blueprint", 0);
    write(&mut Layout { stream: &blueprint, count: 0 }).map_err(|e| e.to_string())?;
    send_layout(stream, storage.take());
    Ok(())
}

impl Layout<'_> {
    /// Text pages behind tabs: the name of each, and its path.
    pub(super) fn texts(&mut self, pages: &[(&str, &str)]) -> RecordingStreamResult<Written> {
        let mut texts = Vec::new();
        for (name, origin) in pages {
            texts.push(self.view(&View {
                class: "TextDocument",
                name: (*name).to_owned(),
                origin: format!("/{origin}"),
                contents: vec!["+ $origin".to_owned()],
                properties: vec![],
            })?);
        }
        self.container(ContainerKind::Tabs, &texts, &[])
    }

    /// Numbers over time, by their paths; the legend stands in `corner`.
    pub(super) fn plot(
        &mut self,
        name: &str,
        corner: Corner2D,
        paths: impl IntoIterator<Item = String>,
    ) -> RecordingStreamResult<Written> {
        let legend = PlotLegend::new().with_corner(corner);
        self.view(&View {
            class: "TimeSeries",
            name: name.to_owned(),
            origin: "/".to_owned(),
            contents: paths.into_iter().map(|path| format!("+ {path}")).collect(),
            properties: vec![("PlotLegend", &legend)],
        })
    }

    /// A log of events with these columns.
    pub(super) fn log(
        &mut self,
        origin: &str,
        contents: Vec<String>,
        columns: impl IntoIterator<Item = TextLogColumnKind>,
    ) -> RecordingStreamResult<Written> {
        let shown = columns.into_iter().map(|kind| TextLogColumn { visible: true.into(), kind });
        let columns = TextLogColumns::update_fields().with_text_log_columns(shown);
        self.view(&View {
            class: "TextLog",
            name: "events".to_owned(),
            origin: origin.to_owned(),
            contents,
            properties: vec![("TextLogColumns", &columns)],
        })
    }
}

/// What lies behind a plane view.
pub(super) fn background() -> Background {
    Background::new(BackgroundKind::SolidColor)
        .with_color(rerun::Color::from_u32(palette::BACKGROUND))
}

/// What lies behind a view of space.
pub(super) fn night() -> Background {
    let night = rerun::Color::from_rgb(16, 18, 24);
    Background::new(BackgroundKind::SolidColor).with_color(night)
}
