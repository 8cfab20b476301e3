//! Which views the recording of a replay opens with.

use geometry::Point2;
use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, View, Written};
use super::parts::{background, send_written};
use super::views::bounds;
use crate::recording::{ABOUT, CONFIG, RESULT};
use crate::{Centre, MapOptions, ReplayOptions};

/// As many maps side by side as can be looked at.
const SIDE_BY_SIDE: usize = 3;

/// Sends the layout: three pictures above, what the maps believe below; text, the last match, plots and
/// events on the right.
pub(crate) fn send_replay(stream: &RecordingStream, options: &ReplayOptions) -> Result<(), String> {
    send_written(stream, |layout| {
        let pictures = pictures(layout, options)?;
        let mut maps = Vec::new();
        for map in &options.maps {
            maps.push(belief(layout, map, options)?);
        }
        let left = if maps.is_empty() {
            pictures
        } else {
            let mut below = Vec::new();
            for (row, kinds) in maps.chunks(SIDE_BY_SIDE).zip(options.maps.chunks(SIDE_BY_SIDE)) {
                let shares = vec![1.0; row.len()];
                let kinds: Vec<&str> = kinds.iter().map(|map| map.name.as_str()).collect();
                let row = layout.container(ContainerKind::Horizontal, row, &shares)?;
                below.push(layout.named(row, &kinds.join(", "))?);
            }
            // One row needs no tabs.
            let below = match <[Written; 1]>::try_from(below) {
                Ok([only]) => only,
                Err(below) => layout.container(ContainerKind::Tabs, &below, &[])?,
            };
            layout.container(ContainerKind::Vertical, &[pictures, below], &[1.2, 1.0])?
        };
        let side = side(layout, options)?;
        layout.container(ContainerKind::Horizontal, &[left, side], &[3.0, 1.35])?;
        layout.finish("step", 8.0, true)
    })
}

fn pictures(layout: &mut Layout<'_>, options: &ReplayOptions) -> RecordingStreamResult<Written> {
    let (low, high) = options.bounds_in_odom;
    let margin_m = 0.05 * (high.x - low.x).max(high.y - low.y);
    let whole = bounds(&low, &high, margin_m);
    let sight = Point2::new(options.sight_m, options.sight_m);
    let around = bounds(&-sight, &sight, 0.0);
    let paper = background();
    let mut shown = Vec::new();
    for (title, picture, view) in [
        ("by odometry only", "by_odometry", &whole),
        ("optimised, and the frontier that is left", "as_optimised", &whole),
        ("relative, around the robot", "around_the_robot", &around),
    ] {
        shown.push(layout.view(&View {
            class: "2D",
            name: title.to_owned(),
            origin: "/eye".to_owned(),
            contents: vec![format!("+ /pictures/{picture}/**")],
            properties: vec![("VisualBounds2D", view), ("Background", &paper)],
        })?);
    }
    layout.container(ContainerKind::Horizontal, &shown, &[1.0, 1.0, 1.0])
}

fn belief(
    layout: &mut Layout<'_>,
    map: &MapOptions,
    options: &ReplayOptions,
) -> RecordingStreamResult<Written> {
    let name = &map.name;
    let (low, high) = options.bounds_in_odom;
    let sight = Point2::new(options.sight_m, options.sight_m);
    let (whole, around) = (bounds(&low, &high, 1.0), bounds(&-sight, &sight, 0.0));
    let (title, origin, view) = match map.centre {
        Centre::Robot => ("around the robot", format!("/{name}/belief/eye"), &around),
        Centre::Start => ("in its own frame", "/eye".to_owned(), &whole),
    };
    let paper = background();
    layout.view(&View {
        class: "2D",
        name: format!("{name}: {title}"),
        origin,
        contents: vec![
            format!("+ /{name}/belief/**"),
            format!("- /{name}/belief/event/**"),
            format!("- /{name}/belief/scope_tree/**"),
            format!("- /{name}/belief/vertices/**"),
        ],
        properties: vec![("VisualBounds2D", view), ("Background", &paper)],
    })
}

fn side(layout: &mut Layout<'_>, options: &ReplayOptions) -> RecordingStreamResult<Written> {
    let texts = layout.texts(&[
        ("match", "match/verdict"),
        ("read me", ABOUT),
        ("config", CONFIG),
        ("result", RESULT),
    ])?;
    let paper = background();
    let reach = Point2::new(10.0, 10.0);
    let near = bounds(&-reach, &reach, 0.0);
    let mut both = Vec::new();
    for (name, title) in [("before", "before the match"), ("after", "after")] {
        both.push(layout.view(&View {
            class: "2D",
            name: title.to_owned(),
            origin: "/eye".to_owned(),
            contents: vec!["+ /match/known".to_owned(), format!("+ /match/{name}/**")],
            properties: vec![("VisualBounds2D", &near), ("Background", &paper)],
        })?);
    }
    let both = layout.container(ContainerKind::Horizontal, &both, &[1.0, 1.0])?;
    let paths = |names: &[&str]| names.iter().map(|name| format!("/plots/{name}")).collect();
    let plot = |layout: &mut Layout<'_>, name: &str, paths: Vec<String>| {
        layout.plot(name, Corner2D::LeftTop, paths)
    };
    let of_maps = |what: &str| {
        options.maps.iter().map(|map| format!("/{}/metrics/{what}", map.name)).collect()
    };
    let plots = [
        plot(layout, "closures", paths(&["proposed", "accepted"]))?,
        plot(layout, "open frontier, m", of_maps("frontier_open_m"))?,
        plot(layout, "residuals and deviations, m", paths(&["residual_m", "sigma_m"]))?,
        plot(layout, "volumes in scope", of_maps("volumes_in_scope"))?,
    ];
    let plots = layout.container(ContainerKind::Tabs, &plots, &[])?;
    let contents = vec!["+ $origin/**".to_owned()];
    let events = layout.log("/events", contents, [TextLogColumnKind::Body])?;
    layout.container(ContainerKind::Vertical, &[texts, both, plots, events], &[1.3, 1.2, 0.9, 0.8])
}
