//! Which views a recording opens with.

use geometry::Point2;
use rerun::external::re_sdk_types::blueprint::archetypes::VisualBounds2D;
use rerun::external::re_sdk_types::blueprint::components::{ContainerKind, Corner2D};
use rerun::external::re_sdk_types::blueprint::datatypes::TextLogColumnKind;
use rerun::{RecordingStream, RecordingStreamResult};

use super::arrange::{Layout, Property, View, Written};
use super::parts::{background, send_written};
use crate::recording::{ABOUT, CONFIG, RESULT};
use crate::{Centre, Level, MapOptions, RecordingOptions};

/// Sends the layout of a recording.
pub(crate) fn send(stream: &RecordingStream, options: &RecordingOptions) -> Result<(), String> {
    send_written(stream, |layout| write(layout, options))
}

fn write(layout: &mut Layout<'_>, options: &RecordingOptions) -> RecordingStreamResult<()> {
    let mut rows = Vec::new();
    for map in &options.maps {
        rows.push(map_row(layout, map, options)?);
    }
    let maps = if rows.len() == 1 {
        rows.remove(0)
    } else {
        layout.container(ContainerKind::Vertical, &rows, &vec![1.0; rows.len()])?
    };
    let side = side(layout, options)?;
    layout.container(ContainerKind::Horizontal, &[maps, side], &[3.0, 1.35])?;
    layout.finish("step", 8.0, options.follow)
}

/// One map: truth and belief, the graph and the single event behind tabs or below.
fn map_row(
    layout: &mut Layout<'_>,
    map: &MapOptions,
    options: &RecordingOptions,
) -> RecordingStreamResult<Written> {
    let name = &map.name;
    let (low, high) = options.bounds_in_world;
    let whole = bounds(&low, &high, 1.0);
    let sight_m = options.sight_m;
    let around = bounds(&Point2::new(-sight_m, -sight_m), &Point2::new(sight_m, sight_m), 0.0);
    // Drift carries a global map out of the place.
    let margin_m = 0.2 * (high.x - low.x).max(high.y - low.y);
    let drifted = bounds(&low, &high, margin_m);
    let paper = background();

    let truth = layout.view(&View {
        class: "2D",
        name: format!("{name}: truth, and what was really seen"),
        origin: format!("/{name}/eye"),
        contents: vec![format!("+ /{name}/truth/**")],
        properties: vec![("VisualBounds2D", &whole), ("Background", &paper)],
    })?;
    let (title, origin, sight) = match map.centre {
        Centre::Robot => ("belief around the robot", format!("/{name}/belief/eye"), &around),
        Centre::Start => ("belief over the true walls", format!("/{name}/eye"), &drifted),
    };
    let belief = |title: &str, more: &[&str]| {
        let mut contents = vec![
            format!("+ /{name}/belief/**"),
            format!("- /{name}/belief/event/**"),
            format!("- /{name}/belief/scope_tree/**"),
            format!("- /{name}/belief/vertices/**"),
        ];
        contents.extend(more.iter().map(|rule| rule.replace("$map", &format!("/{name}"))));
        View {
            class: "2D",
            name: format!("{name}: {title}"),
            origin: origin.clone(),
            contents,
            properties: vec![("VisualBounds2D", sight), ("Background", &paper)],
        }
    };
    let walls: &[&str] = match map.centre {
        Centre::Robot => &[],
        Centre::Start => &["+ $map/truth/walls"],
    };
    let believed = layout.view(&belief(title, walls))?;
    let mut behind = vec![believed];
    if options.level == Level::Full {
        let rules = [
            "- $map/belief/planner/**",
            "+ $map/belief/event/**",
            "+ $map/belief/scope_tree/**",
            "+ $map/belief/vertices/**",
        ];
        behind.push(layout.view(&belief("the last event", &rules))?);
    }
    if map.centre == Centre::Robot {
        let rules = ["+ $map/truth/walls", "+ $map/truth/path/**"];
        let over = belief("belief over the true walls", &rules);
        let origin = format!("/{name}/eye");
        let properties: Vec<Property<'_>> =
            vec![("VisualBounds2D", &whole), ("Background", &paper)];
        behind.push(layout.view(&View { origin, properties, ..over })?);
    }
    let graph = layout.view(&View {
        class: "2D",
        name: format!("{name}: pose graph by odometry"),
        origin: format!("/{name}/eye"),
        contents: vec![
            format!("+ /{name}/graph/**"),
            format!("+ /{name}/truth/walls"),
            format!("+ /{name}/truth/path/**"),
        ],
        properties: vec![("VisualBounds2D", &drifted), ("Background", &paper)],
    })?;
    let beside = |layout: &mut Layout<'_>, left, right| {
        layout.container(ContainerKind::Horizontal, &[left, right], &[1.0, 1.0])
    };
    // A map that has the window for itself shows the graph at once.
    if options.maps.len() == 1 && behind.len() > 1 {
        let believed = behind.remove(0);
        let above = beside(layout, truth, believed)?;
        let others = layout.container(ContainerKind::Tabs, &behind, &[])?;
        let below = beside(layout, graph, others)?;
        return layout.container(ContainerKind::Vertical, &[above, below], &[1.3, 1.0]);
    }
    behind.push(graph);
    let tabs = layout.container(ContainerKind::Tabs, &behind, &[])?;
    beside(layout, truth, tabs)
}

/// Text, plots and the log of events, for all maps.
fn side(layout: &mut Layout<'_>, options: &RecordingOptions) -> RecordingStreamResult<Written> {
    let texts = layout.texts(&[("read me", ABOUT), ("config", CONFIG), ("result", RESULT)])?;
    let plot = |layout: &mut Layout<'_>, name: &str, series: &[&str]| {
        let of_map = |map: &MapOptions| {
            let path = format!("/{}/metrics", map.name);
            series.iter().map(move |one| format!("{path}/{one}")).collect::<Vec<_>>()
        };
        layout.plot(name, Corner2D::LeftTop, options.maps.iter().flat_map(of_map))
    };
    let coverage = plot(layout, "coverage", &["coverage"])?;
    let frontier = plot(layout, "open frontier, m", &["frontier_open_m"])?;
    let more = [
        frontier,
        plot(layout, "ignored frontier, m", &["frontier_ignored_m"])?,
        plot(layout, "volumes in scope", &["volumes_in_scope"])?,
        plot(layout, "distance, m", &["distance_m"])?,
        plot(layout, "bumps, collisions", &["bumps", "collisions"])?,
        plot(layout, "odometry error, m", &["odometry_error_m"])?,
    ];
    let more = layout.container(ContainerKind::Tabs, &more, &[])?;
    let mut parts = vec![texts, coverage, more];
    let mut shares = vec![1.5, 1.0, 1.0];
    if options.level == Level::Full {
        let contents =
            options.maps.iter().map(|map| format!("+ /{}/events/**", map.name)).collect();
        let columns = [TextLogColumnKind::EntityPath, TextLogColumnKind::Body];
        parts.push(layout.log("/", contents, columns)?);
        shares.push(1.2);
    }
    layout.container(ContainerKind::Vertical, &parts, &shares)
}

/// Bounds of a view, whose y axis points down.
pub(super) fn bounds(low: &Point2, high: &Point2, margin_m: f64) -> VisualBounds2D {
    VisualBounds2D::new(rerun::datatypes::Range2D {
        x_range: [low.x - margin_m, high.x + margin_m].into(),
        y_range: [-high.y - margin_m, -low.y + margin_m].into(),
    })
}
