//! The united map: operands, the union, what was left beside it, tetrahedra and paths.

use geometry::Point3;
use maps3d::UnionEvent;
use pose::Se3;
use solid::Polyhedron;

use super::ink::{Faces, Ink, lines, placed};
use crate::{Family, palette};

/// Draws what an event of the united map is about under `belief/union`, in the frame `map`.
pub(super) fn draw(ink: &mut Ink, event: &UnionEvent<'_>) {
    match event {
        UnionEvent::Placed { operand, .. } => {
            ink.draw("belief/union/operand", &Faces::inside_of(operand).mesh());
        }
        UnionEvent::United { map, .. }
        | UnionEvent::Cleaned { map, .. }
        | UnionEvent::Rebuilt { map, .. } => draw_map(ink, map),
        UnionEvent::Corrected { before, after, .. } => {
            ink.draw("belief/union/before", &trajectory(before, palette::BEFORE));
            ink.draw("belief/union/after", &trajectory(after, palette::CORRECTED));
        }
        UnionEvent::Planned { plan, given } => {
            let way: Vec<Point3> = plan.way.iter().map(|knot| knot.at).collect();
            ink.draw("belief/union/plan/centroids", &lines(&[way], palette::GIVEN_UP, 1.2));
            ink.draw("belief/union/plan/path", &lines(&[given.to_vec()], palette::ROUTE, 2.5));
        }
        _ => {}
    }
}

/// What an event is about.
pub(super) fn family_of(event: &UnionEvent<'_>) -> Family {
    match event {
        UnionEvent::Corrected { .. }
        | UnionEvent::NotCorrected { .. }
        | UnionEvent::Rebuilt { .. } => Family::Correction,
        UnionEvent::Planned { .. } | UnionEvent::GivenUp { .. } => Family::Planner,
        _ => Family::Polygons,
    }
}

/// An event in one line.
pub(super) fn line(event: &UnionEvent<'_>) -> String {
    match event {
        UnionEvent::Placed { view, vertex, operand, .. } => {
            format!("view {view} at vertex {vertex}: {} faces", operand.faces().len())
        }
        UnionEvent::United { view, map, settled } => format!(
            "view {view}: {} faces, {settled} of them frontier that became obstacle",
            map.faces().len()
        ),
        UnionEvent::Cleaned { map, removed } => {
            format!("{} vertices taken out, {} faces left", removed.len(), map.faces().len())
        }
        UnionEvent::Refused { view, why } => format!("view {view} stands beside the map: {why}"),
        UnionEvent::Sorted { patches, sliver_m2 } => {
            let open_m2: f64 = patches.iter().map(|patch| patch.area_m2).sum();
            let count = patches.len();
            format!("{count} patches, {open_m2:.3} m² open, {sliver_m2:.3} m² too small")
        }
        UnionEvent::Corrected { new_places, moved_max_m, .. } => {
            format!("{new_places} new place edges moved vertices by up to {moved_max_m:.3} m")
        }
        UnionEvent::NotCorrected { report } => {
            format!("the poses stay: {:?}", report.termination)
        }
        UnionEvent::Rebuilt { views, moved_max_m, .. } => {
            format!("{views} views united again, moved by up to {moved_max_m:.3} m")
        }
        UnionEvent::Filled { tetrahedra } => format!("{} tetrahedra", tetrahedra.tetrahedra.len()),
        UnionEvent::Fanned { why, fans } => format!("{fans} fans stand for the map: {why}"),
        UnionEvent::Planned { plan, given } => format!(
            "{:.3} m through {} tetrahedra, {:.3} m after shortening; {} points given",
            plan.cost_m,
            plan.corridor.tetrahedra.len(),
            plan.path_m,
            given.len()
        ),
        UnionEvent::GivenUp { place, radius_m, unreachable } => format!(
            "within {radius_m:.2} m of ({:.2}, {:.2}, {:.2}){}",
            place.x,
            place.y,
            place.z,
            if *unreachable { ": no way leads there" } else { "" }
        ),
    }
}

fn draw_map(ink: &mut Ink, map: &Polyhedron) {
    ink.draw("belief/union/map", &Faces::inside_of(map).mesh());
}

/// Where the map's frame lies in the one that is drawn; at all times.
pub(super) fn place(ink: &mut Ink, world_from_map: &Se3) {
    ink.always("belief/union", &placed(world_from_map));
}

fn trajectory(map_from_vertex: &[Se3], colour: crate::columns::Rgba) -> rerun::LineStrips3D {
    let way: Vec<Point3> = map_from_vertex.iter().map(|pose| pose.translation.into()).collect();
    lines(&[way], colour, 1.5)
}
