//! The way from where the camera was last to the nearest frontier.

use explore::FlightEvent;
use geometry::Point3;
use maps3d::{FlightRoute, Hovering, Map3d};
use pose::Se3;
use probe::Probe;

use instrument::FlightRecorder;

/// A way, from the camera on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Way {
    /// Where it bends, in the frame of the log; the camera first, the frontier last.
    pub in_log: Vec<Point3>,
    /// Its length, metres.
    pub length_m: f64,
}

/// Finds the way for a body of a radius, as the map knows ways: through tetrahedra of one volume, of the fans of
/// many, through cells, or along the graph and then straight on.
pub(super) fn to_frontier(
    map: &mut dyn Map3d,
    hovering: &Hovering,
    body_radius_m: f64,
    log_from_vertex: &[Se3],
    recorder: &mut FlightRecorder,
) -> Option<Way> {
    let log_from = |hovering: &Hovering| {
        let vertex = log_from_vertex.get(hovering.vertex.0 as usize)?;
        Some(*vertex * hovering.vertex_from_body)
    };
    let log_from_body = log_from(hovering)?;
    let route = match map.way_through_views(hovering, body_radius_m) {
        Some(points) => Some(FlightRoute::Fly(points)),
        None => map.route_with(hovering, body_radius_m, &|_| true, recorder),
    };
    let mut in_log = vec![Point3::from(log_from_body.translation)];
    match route {
        Some(FlightRoute::Fly(points)) if !points.is_empty() => {
            in_log.extend(points.iter().map(|point| log_from_body.transform(point)));
        }
        Some(FlightRoute::Repeat(links)) => {
            let last = links.last().map_or(hovering.vertex, |(vertex, _)| *vertex);
            for (vertex, _) in &links {
                in_log.push(log_from_vertex.get(vertex.0 as usize)?.translation.into());
            }
            let there = Hovering { vertex: last, ..*hovering };
            let log_from_there = log_from(&there)?;
            let ends = match map.way_through_views(&there, body_radius_m) {
                Some(points) => points,
                None => vec![nearest(map, &there, body_radius_m)?],
            };
            in_log.extend(ends.iter().map(|point| log_from_there.transform(point)));
        }
        // Nothing to find a way through: what is in sight is straight ahead.
        _ => in_log.push(log_from_body.transform(&nearest(map, hovering, body_radius_m)?)),
    }
    let length_m = in_log.windows(2).map(|leg| (leg[1] - leg[0]).norm()).sum();
    let body_from_log = log_from_body.inverse();
    let points = in_log[1..].iter().map(|point| body_from_log.transform(point)).collect();
    let route = &FlightRoute::Fly(points);
    recorder.emit(FlightEvent::RoutePlanned { hovering: *hovering, route, length_m });
    Some(Way { in_log, length_m })
}

/// The frontier point that is nearest to where the robot hovers, of what it has in view there and does not touch
/// already.
fn nearest(map: &mut dyn Map3d, hovering: &Hovering, body_radius_m: f64) -> Option<Point3> {
    let mut patches = Vec::new();
    map.frontiers(hovering, &mut patches);
    let points = patches.iter().flat_map(|patch| &patch.points).map(|point| point.in_body);
    let apart = points.filter(|point| point.coords.norm() > body_radius_m);
    apart.min_by(|a, b| a.coords.norm().total_cmp(&b.coords.norm()))
}
