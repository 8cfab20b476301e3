//! What is to be looked at, from where, and the way there.

use explore::FlightEvent;
use explore::flight::Target;
use geometry::Point3;
use maps3d::{FlightRoute, Plan};
use pose::Se3;
use probe::VertexId;

use super::ink::{Ink, dots, lines};
use crate::palette;

/// The best places that are drawn of those that were scored.
const MOST_SCORED: usize = 200;

/// The vertex in whose frame an event of the planner speaks.
pub(super) fn vertex_of(event: &FlightEvent<'_>) -> Option<VertexId> {
    match event {
        FlightEvent::ViewpointsScored { at, .. } | FlightEvent::ViewpointChosen { at, .. } => {
            Some(*at)
        }
        FlightEvent::RoutePlanned { hovering, .. } => Some(hovering.vertex),
        FlightEvent::FrontierGivenUp { owner, .. } => Some(*owner),
        _ => None,
    }
}

/// Draws what an event of the planner is about under `belief/planner`; its vertex lies at `drawn_from_vertex`.
pub(super) fn draw(ink: &mut Ink, event: &FlightEvent<'_>, drawn_from_vertex: &Se3) {
    let drawn = |place: &Point3| drawn_from_vertex.transform(place);
    match event {
        FlightEvent::ViewpointsScored { targets, scored, .. } => {
            let at: Vec<Point3> = targets.iter().map(|target: &Target| drawn(&target.at)).collect();
            ink.draw("belief/planner/targets", &dots(&at, &[palette::FRONTIER], 4.0));
            let shown = &scored[..scored.len().min(MOST_SCORED)];
            let best = shown.first().map_or(1.0, |(_, score)| score.max(1e-9));
            let places: Vec<Point3> = shown.iter().map(|(place, _)| drawn(place)).collect();
            let colours: Vec<_> =
                shown.iter().map(|(_, score)| palette::ramp(1.0 - score / best)).collect();
            ink.draw("belief/planner/viewpoints", &dots(&places, &colours, 2.5));
        }
        FlightEvent::ViewpointChosen { place_in_vertex, .. } => {
            let place = drawn(place_in_vertex);
            ink.draw("belief/planner/goal", &dots(&[place], &[palette::GOAL], 6.0));
            let way = vec![drawn(&Point3::origin()), place];
            ink.draw("belief/planner/way", &lines(&[way], palette::ROUTE, 2.0));
        }
        FlightEvent::RoutePlanned { hovering, route: FlightRoute::Fly(points), .. } => {
            let body = *drawn_from_vertex * hovering.vertex_from_body;
            let mut way = vec![Point3::from(body.translation)];
            way.extend(points.iter().map(|point| body.transform(point)));
            ink.draw("belief/planner/way", &lines(&[way], palette::ROUTE, 2.0));
        }
        FlightEvent::FrontierGivenUp { place_in_vertex, .. } => {
            let mark = dots(&[drawn(place_in_vertex)], &[palette::GIVEN_UP], 6.0);
            ink.draw("belief/planner/given_up", &mark);
        }
        _ => {}
    }
}

/// Draws a way through centroids, and the path that is given for it; their frame lies at `drawn_from_plan`.
pub(super) fn draw_plan(
    ink: &mut Ink,
    entity: &str,
    plan: &Plan,
    given: &[Point3],
    drawn_from_plan: &Se3,
) {
    let way = plan.way.iter().map(|knot| drawn_from_plan.transform(&knot.at)).collect();
    let path = given.iter().map(|point| drawn_from_plan.transform(point)).collect();
    ink.draw(&format!("{entity}/centroids"), &lines(&[way], palette::GIVEN_UP, 1.2));
    ink.draw(&format!("{entity}/path"), &lines(&[path], palette::ROUTE, 2.5));
}

/// What a plan came to, in words.
pub(super) fn lengths(plan: &Plan) -> String {
    format!("{:.2} m through centroids, {:.2} m shortened", plan.straight_m, plan.path_m)
}

/// Takes the marks of the step before away.
pub(super) fn wipe(ink: &mut Ink) {
    let parts = ["targets", "viewpoints", "goal", "way", "given_up", "plan/centroids", "plan/path"];
    for part in parts {
        ink.draw(&format!("belief/planner/{part}"), &rerun::Clear::flat());
    }
}

/// One line about an event of the planner.
pub(super) fn line(event: &FlightEvent<'_>) -> String {
    match event {
        FlightEvent::StateChanged { from, to } => format!("{from:?} to {to:?}"),
        FlightEvent::VertexAdded { vertex, .. } => format!("vertex {vertex}"),
        FlightEvent::EdgeAdded { kind, a, b, a_from_b, .. } => {
            format!("{kind:?} from {a} to {b}, {:.2} m", a_from_b.distance())
        }
        FlightEvent::Turned { yaw_rad } => format!("by {:.0} degrees", yaw_rad.to_degrees()),
        FlightEvent::Looked { hovering, image, .. } => format!(
            "{} x {} pixels from {}",
            image.columns,
            image.rows(),
            super::looks::place(hovering)
        ),
        FlightEvent::ViewpointsScored { at, targets, scored } => format!(
            "{} places from vertex {at} for {} points of frontier",
            scored.len(),
            targets.len()
        ),
        FlightEvent::ViewpointChosen { at, area_m2, margin_m, .. } => {
            format!("from vertex {at}: {area_m2:.2} m² in view, margin {margin_m:.2} m")
        }
        FlightEvent::RoutePlanned { hovering, route, length_m } => {
            let how = match route {
                FlightRoute::Repeat(legs) => format!("{} legs along the graph", legs.len()),
                FlightRoute::Fly(points) => format!("{} straight legs", points.len()),
            };
            format!("{length_m:.1} m from vertex {}: {how}", hovering.vertex)
        }
        FlightEvent::WayWeighed { in_body, way_m, repeat_m, is_flown, .. } => format!(
            "{way_m:.1} m through views in {} legs, {repeat_m:.1} m along the graph: {}",
            in_body.len(),
            if *is_flown { "flown" } else { "it repeats" }
        ),
        FlightEvent::Flew { distance_m } => format!("{distance_m:.2} m"),
        FlightEvent::LegRepeated { from, to, length_m } => {
            format!("from {from} to {to}, {length_m:.2} m")
        }
        FlightEvent::FrontierGivenUp { owner, area_m2, why, .. } => {
            format!("{area_m2:.3} m² of vertex {owner}: {why:?}")
        }
        FlightEvent::Finished { ending } => format!("{ending:?}"),
    }
}
