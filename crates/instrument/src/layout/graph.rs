//! Which views the recording of an optimisation opens with.

use rerun::external::re_sdk_types::blueprint::archetypes::VisualBounds2D;
use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View, Written};
use super::parts::{background, night, send_written};
use crate::recording::{ABOUT, RESULT};

/// What the layout has to know of a graph.
pub(crate) struct GraphLook {
    /// Whether it is drawn in a 3D view.
    pub in_space: bool,
    /// Lower-left and upper-right corner of what is drawn in a 2D view, metres, y up.
    pub bounds_m: ([f64; 2], [f64; 2]),
}

/// Sends the layout: the graph on the left; text, plots and events on the right.
pub(crate) fn send_graph(stream: &RecordingStream, look: &GraphLook) -> Result<(), String> {
    send_written(stream, |layout| {
        let graph = graph(layout, look)?;
        let side = side(layout)?;
        layout.container(ContainerKind::Horizontal, &[graph, side], &[2.2, 1.0])?;
        layout.finish("iteration", 2.0, false)
    })
}

fn graph(layout: &mut Layout<'_>, look: &GraphLook) -> RecordingStreamResult<Written> {
    let name = "poses and edges: grey fits, yellow strains, red is far off".to_owned();
    let contents = vec!["+ /graph/**".to_owned(), "- /graph/events/**".to_owned()];
    if look.in_space {
        let dark = night();
        let (class, origin) = ("3D", "/".to_owned());
        let properties: Vec<super::arrange::Property<'_>> = vec![("Background", &dark)];
        return layout.view(&View { class, name, origin, contents, properties });
    }
    let (low, high) = look.bounds_m;
    let bounds = VisualBounds2D::new(rerun::datatypes::Range2D {
        x_range: [low[0], high[0]].into(),
        y_range: [-high[1], -low[1]].into(),
    });
    let paper = background();
    layout.view(&View {
        class: "2D",
        name,
        origin: "/eye".to_owned(),
        contents,
        properties: vec![("VisualBounds2D", &bounds), ("Background", &paper)],
    })
}

fn side(layout: &mut Layout<'_>) -> RecordingStreamResult<Written> {
    let texts = layout.texts(&[("read me", ABOUT), ("result", RESULT)])?;
    let plot = |layout: &mut Layout<'_>, name: &str, series: &[&str]| {
        let paths = series.iter().map(|one| format!("/plots/{one}"));
        layout.plot(name, Corner2D::RightTop, paths)
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
    let contents = vec!["+ $origin/**".to_owned()];
    let events = layout.log("/graph/events", contents, [TextLogColumnKind::Body])?;
    let parts = [texts, cost, more, events];
    layout.container(ContainerKind::Vertical, &parts, &[1.5, 1.0, 1.0, 0.7])
}
