//! Which views the recording of a depth image opens with.

use rerun::datatypes::{TimeRange, TimeRangeBoundary};
use rerun::external::re_sdk_types::blueprint::archetypes::{EyeControls3D, PlotLegend, TimeAxis};
use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D, LinkAxis};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View};
use super::parts::{night, send_written};
use crate::recording::{ABOUT, RESULT};

/// The numbers that are plotted for each reduction, and their titles.
pub(crate) const DEPTH_PLOTS: [(&str, &str); 4] = [
    ("p95_m", "95 %"),
    ("rms_m", "root mean square"),
    ("contribution_m", "contribution of a removed vertex"),
    ("error_m", "distance of an inserted pixel"),
];

/// What a recorded depth image looks like.
pub(crate) struct DepthLook {
    /// Reductions by their name, and by its form in paths.
    pub methods: Vec<(String, String)>,
    /// A middle depth of the image, metres.
    pub middle_m: f32,
    /// The largest number of vertices that is of interest.
    pub largest: usize,
}

/// Sends the layout: a view of space for each reduction on the left; images, plots and texts on the
/// right.
pub(crate) fn send_depth(stream: &RecordingStream, look: &DepthLook) -> Result<(), String> {
    send_written(stream, |layout| write(layout, look))
}

fn write(layout: &mut Layout<'_>, look: &DepthLook) -> RecordingStreamResult<()> {
    let DepthLook { methods, middle_m, .. } = look;
    let dark = night();
    // From behind the camera and above it, so that steps in depth are seen from the side.
    let eye = EyeControls3D::new()
        .with_position([0.42 * middle_m, -0.5 * middle_m, -0.3 * middle_m])
        .with_look_target([0.02 * middle_m, 0.05 * middle_m, 0.7 * middle_m])
        .with_eye_up([0.0, -1.0, 0.0]);
    let (mut spaces, mut images) = (Vec::new(), Vec::new());
    for (method, entity) in methods {
        spaces.push(layout.view(&View {
            class: "3D",
            name: format!("{method}: grey obstacle, orange frontier"),
            origin: "/view".to_owned(),
            contents: vec![format!("+ /view/{entity}/**")],
            properties: vec![("Background", &dark), ("EyeControls3D", &eye)],
        })?);
        images.push(layout.view(&View {
            class: "2D",
            name: format!("edges of {method}"),
            origin: "/image".to_owned(),
            contents: vec![
                "+ /image/depth".to_owned(),
                "+ /image/frontier".to_owned(),
                format!("+ /image/{entity}/**"),
            ],
            properties: vec![],
        })?);
    }
    let kind = if spaces.len() > 3 { ContainerKind::Grid } else { ContainerKind::Vertical };
    let spaces = layout.container(kind, &spaces, &vec![1.0; spaces.len()])?;
    let images = layout.container(ContainerKind::Tabs, &images, &[])?;
    let texts = layout.texts(&[("read me", ABOUT), ("result", RESULT)])?;
    // The whole grid has a hundred times as many vertices as what is looked at.
    let until = (look.largest as i64).saturating_mul(11) / 10;
    let boundary = |at: i64| TimeRangeBoundary::Absolute(at.into());
    let range = TimeRange { start: boundary(0), end: boundary(until) };
    let axis = TimeAxis::new().with_link(LinkAxis::Independent).with_view_range(range);
    let mut plots = Vec::new();
    for (name, series) in [
        ("95 % of the measured points are nearer, metres", &["p95_m"][..]),
        ("root mean square distance, metres", &["rms_m"]),
        ("single vertices, metres", &["contribution_m", "error_m"]),
    ] {
        let paths = series.iter().flat_map(|name| {
            methods.iter().map(move |(_, entity)| format!("/plots/{name}/{entity}"))
        });
        let legend = PlotLegend::new().with_corner(Corner2D::RightTop);
        plots.push(layout.view(&View {
            class: "TimeSeries",
            name: name.to_owned(),
            origin: "/".to_owned(),
            contents: paths.map(|path| format!("+ {path}")).collect(),
            properties: vec![("PlotLegend", &legend), ("TimeAxis", &axis)],
        })?);
    }
    let plots = layout.container(ContainerKind::Tabs, &plots, &[])?;
    let contents = vec!["+ $origin/**".to_owned()];
    let events = layout.log("/events", contents, [TextLogColumnKind::Body])?;
    let parts = [images, plots, texts, events];
    let side = layout.container(ContainerKind::Vertical, &parts, &[1.3, 1.0, 0.8, 0.35])?;
    layout.container(ContainerKind::Horizontal, &[spaces, side], &[1.4, 1.0])?;
    layout.finish("vertices", 2.0, false)
}
