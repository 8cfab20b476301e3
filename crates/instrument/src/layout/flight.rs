//! Which views the recording of a flight opens with.

use geometry::Point3;
use rerun::external::re_sdk_types::blueprint::archetypes::EyeControls3D;
use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View, Written};
use super::parts::{night, send_written};
use crate::recording::{ABOUT, CONFIG, RESULT};
use crate::{FlightOptions, Level};

/// Sends the layout of a flight.
pub(crate) fn send_flight(stream: &RecordingStream, options: &FlightOptions) -> Result<(), String> {
    send_written(stream, |layout| write(layout, options))
}

fn write(layout: &mut Layout<'_>, options: &FlightOptions) -> RecordingStreamResult<()> {
    let mut rows = Vec::new();
    for map in &options.maps {
        rows.push(map_row(layout, map, options)?);
    }
    let maps = layout.container(ContainerKind::Vertical, &rows, &vec![1.0; rows.len()])?;
    let side = side(layout, options)?;
    layout.container(ContainerKind::Horizontal, &[maps, side], &[3.0, 1.2])?;
    layout.finish("step", 8.0, false)
}

/// One map: truth and belief side by side; depth image, last view and pose graph below or behind.
fn map_row(
    layout: &mut Layout<'_>,
    map: &str,
    options: &FlightOptions,
) -> RecordingStreamResult<Written> {
    let dark = night();
    let (low, high) = options.bounds_in_world;
    let whole = eye_over(&low, &high);
    // From a corner one sees as far as the place is wide, and the robot may look any way.
    let reach_m = (0.8 * (high - low).norm()).clamp(3.0, 7.0);
    let corner = Point3::new(reach_m, reach_m, 1.4);
    let around = if options.has_truth { eye_over(&-corner, &corner) } else { whole.clone() };
    let is_around = FlightOptions::is_around_robot(map);
    let space = |layout: &mut Layout<'_>, name: &str, eye: &EyeControls3D, rules: &[&str]| {
        layout.view(&View {
            class: "3D",
            name: format!("{map}: {name}"),
            origin: "/".to_owned(),
            contents: rules.iter().map(|rule| rule.replace("$map", &format!("/{map}"))).collect(),
            properties: vec![("Background", &dark), ("EyeControls3D", eye)],
        })
    };
    let truth = match options.has_truth {
        true => {
            let title = "truth, and what was really seen";
            vec![space(layout, title, &whole, &["+ $map/truth/**"])?]
        }
        false => Vec::new(),
    };
    let (title, sight) = match is_around {
        true => ("belief around the robot", &around),
        false if options.has_truth => ("belief, from the true start", &whole),
        false => ("belief, from the first image", &whole),
    };
    let believed = space(
        layout,
        title,
        sight,
        &[
            "+ $map/belief/**",
            "- $map/belief/look/**",
            "- $map/belief/union/operand/**",
            "- $map/belief/union/search/**",
            "- $map/belief/search/**",
        ],
    )?;
    let look = space(
        layout,
        "the last view",
        if is_around { &around } else { &whole },
        &[
            "+ $map/belief/look/**",
            "+ $map/belief/union/operand/**",
            "+ $map/belief/robot/**",
            "+ $map/belief/planner/**",
        ],
    )?;
    let search = space(
        layout,
        "tetrahedra and A*",
        sight,
        &["+ $map/belief/union/search/**", "+ $map/belief/search/**", "+ $map/belief/robot/**"],
    )?;
    let graph_title =
        if options.has_truth { "pose graph by odometry" } else { "pose graph by the log's poses" };
    let graph = space(
        layout,
        graph_title,
        &whole,
        &["+ $map/graph/**", "+ $map/truth/path/**", "+ $map/truth/robot/**"],
    )?;
    let image = layout.view(&View {
        class: "2D",
        name: format!("{map}: depth image"),
        origin: format!("/{map}/camera"),
        contents: vec!["+ $origin/**".to_owned()],
        properties: vec![("Background", &dark)],
    })?;
    let mut above = truth;
    above.push(believed);
    let shares = vec![1.0; above.len()];
    let above = layout.container(ContainerKind::Horizontal, &above, &shares)?;
    if options.maps.len() == 1 {
        let tabs = layout.container(ContainerKind::Tabs, &[graph, search], &[])?;
        let below =
            layout.container(ContainerKind::Horizontal, &[image, look, tabs], &[0.8, 1.0, 1.0])?;
        return layout.container(ContainerKind::Vertical, &[above, below], &[1.6, 1.0]);
    }
    let below = layout.container(ContainerKind::Tabs, &[image, look, graph, search], &[])?;
    layout.container(ContainerKind::Horizontal, &[above, below], &[2.2, 1.0])
}

/// An eye that looks down at a box from its south.
fn eye_over(low: &Point3, high: &Point3) -> EyeControls3D {
    let middle = low + (high - low) * 0.5;
    let size = (high - low).norm();
    #[expect(clippy::cast_possible_truncation, reason = "for looking")]
    let short = |p: Point3| [p.x as f32, p.y as f32, p.z as f32];
    let eye = Point3::new(middle.x, middle.y - 0.45 * size, middle.z + 0.75 * size);
    EyeControls3D::new()
        .with_position(short(eye))
        .with_look_target(short(middle))
        .with_eye_up([0.0, 0.0, 1.0])
}

/// Text, plots and the log of events, for all maps.
fn side(layout: &mut Layout<'_>, options: &FlightOptions) -> RecordingStreamResult<Written> {
    let texts = layout.texts(&[("read me", ABOUT), ("config", CONFIG), ("result", RESULT)])?;
    let plot = |layout: &mut Layout<'_>, name: &str, series: &[&str]| {
        let paths = options
            .maps
            .iter()
            .flat_map(|map| series.iter().map(move |one| format!("/plots/{map}/{one}")));
        layout.plot(name, Corner2D::LeftTop, paths.collect::<Vec<_>>())
    };
    let of_truth = options.has_truth;
    let (mut parts, mut shares) = (vec![texts], vec![1.5]);
    if of_truth {
        parts.push(plot(layout, "coverage", &["coverage"])?);
        shares.push(1.0);
    }
    let mut more = vec![
        plot(layout, "open frontier, m²", &["frontier_open_m2"])?,
        plot(layout, "ignored frontier, m²", &["frontier_ignored_m2"])?,
        plot(layout, "faces of the map", &["map_faces"])?,
        plot(layout, "distance, m", &["distance_m"])?,
    ];
    if of_truth {
        more.push(plot(layout, "odometry error, m", &["odometry_error_m"])?);
    }
    parts.push(layout.container(ContainerKind::Tabs, &more, &[])?);
    shares.push(1.0);
    if options.level == Level::Full {
        let contents = options.maps.iter().map(|map| format!("+ /{map}/events/**")).collect();
        let columns = [TextLogColumnKind::EntityPath, TextLogColumnKind::Body];
        parts.push(layout.log("/", contents, columns)?);
        shares.push(1.2);
    }
    layout.container(ContainerKind::Vertical, &parts, &shares)
}
