//! Which views the recording of an optimisation opens with.

use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, PlotLegend, TextLogColumns, VisualBounds2D,
};
use rerun::external::re_sdk_types::blueprint::components::{
    BackgroundKind, ContainerKind, Corner2D,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};

use super::arrange::{Layout, View, Written};
use crate::recording::{ABOUT, RESULT, send_layout};

/// What the layout has to know of a graph.
pub(crate) struct GraphLook {
    /// Whether it is drawn in a 3D view.
    pub in_space: bool,
    /// Lower-left and upper-right corner of what is drawn in a 2D view, metres, y up.
    pub bounds_m: ([f64; 2], [f64; 2]),
}

/// Sends the layout: the graph on the left; text, plots and events on the right.
pub(crate) fn send_graph(stream: &RecordingStream, look: &GraphLook) -> Result<(), String> {
    let store = RecordingStreamBuilder::new("driftlab").blueprint().memory();
    let (blueprint, storage) = store.map_err(|e| e.to_string())?;
    blueprint.set_time_sequence("blueprint", 0);
    write(&blueprint, look).map_err(|e| e.to_string())?;
    send_layout(stream, storage.take());
    Ok(())
}

fn write(stream: &RecordingStream, look: &GraphLook) -> RecordingStreamResult<()> {
    let mut layout = Layout { stream, count: 0 };
    let graph = graph(&mut layout, look)?;
    let side = side(&mut layout)?;
    layout.container(ContainerKind::Horizontal, &[graph, side], &[2.2, 1.0])?;
    layout.finish("iteration", 2.0, false)
}

fn graph(layout: &mut Layout<'_>, look: &GraphLook) -> RecordingStreamResult<Written> {
    let name = "poses and edges: grey fits, yellow strains, red is far off".to_owned();
    let contents = vec!["+ /graph/**".to_owned(), "- /graph/events/**".to_owned()];
    if look.in_space {
        let night = rerun::Color::from_rgb(16, 18, 24);
        let dark = Background::new(BackgroundKind::SolidColor).with_color(night);
        let (class, origin) = ("3D", "/".to_owned());
        let properties: Vec<super::arrange::Property<'_>> = vec![("Background", &dark)];
        return layout.view(&View { class, name, origin, contents, properties });
    }
    let (low, high) = look.bounds_m;
    let bounds = VisualBounds2D::new(rerun::datatypes::Range2D {
        x_range: [low[0], high[0]].into(),
        y_range: [-high[1], -low[1]].into(),
    });
    let paper = super::views::background();
    layout.view(&View {
        class: "2D",
        name,
        origin: "/eye".to_owned(),
        contents,
        properties: vec![("VisualBounds2D", &bounds), ("Background", &paper)],
    })
}

fn side(layout: &mut Layout<'_>) -> RecordingStreamResult<Written> {
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
    let legend = PlotLegend::new().with_corner(Corner2D::RightTop);
    let plot = |layout: &mut Layout<'_>, name: &str, series: &[&str]| {
        layout.view(&View {
            class: "TimeSeries",
            name: name.to_owned(),
            origin: "/".to_owned(),
            contents: series.iter().map(|one| format!("+ /plots/{one}")).collect(),
            properties: vec![("PlotLegend", &legend)],
        })
    };
    let cost = plot(layout, "log10 of cost and step", &["log10_cost", "log10_step_norm"])?;
    let histogram = layout.view(&View {
        class: "BarChart",
        name: "edges by log2 of their residual".to_owned(),
        origin: "/edges/histogram".to_owned(),
        contents: vec!["+ $origin".to_owned()],
        properties: vec![],
    })?;
    let more = [
        histogram,
        plot(layout, "gain ratio, accepted", &["gain_ratio", "accepted"])?,
        plot(layout, "log10 of damping", &["log10_damping"])?,
        plot(layout, "rejected edges", &["rejected_edges"])?,
    ];
    let more = layout.container(ContainerKind::Tabs, &more, &[])?;
    let columns = TextLogColumns::update_fields().with_text_log_columns(
        [TextLogColumnKind::Body].map(|kind| TextLogColumn { visible: true.into(), kind }),
    );
    let events = layout.view(&View {
        class: "TextLog",
        name: "events".to_owned(),
        origin: "/graph/events".to_owned(),
        contents: vec!["+ $origin/**".to_owned()],
        properties: vec![("TextLogColumns", &columns)],
    })?;
    let parts = [texts, cost, more, events];
    layout.container(ContainerKind::Vertical, &parts, &[1.5, 1.0, 1.0, 0.7])
}
