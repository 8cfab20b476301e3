//! The united map: operands, the union, what was left beside it, tetrahedra and paths.

use geometry::Point3;
use maps3d::global_union::UnionEvent;
use pose::Se3;
use solid::Polyhedron;

use super::ink::{Faces, Ink, dots, lines, placed, segments};
use super::planner;
use crate::{Family, palette};

/// Draws what an event of the united map is about under `belief/union`, in the frame `map`.
pub(super) fn draw(ink: &mut Ink, event: &UnionEvent<'_>) {
    match event {
        UnionEvent::Placed { operand, .. } => {
            ink.draw("belief/union/operand", &segments(&sides(operand), palette::SCOPE, 0.6));
        }
        UnionEvent::Sorted { patches, .. } => {
            // These patches are told in the frame of the map.
            let at: Vec<Point3> =
                patches.iter().flat_map(|patch| &patch.points).map(|point| point.in_body).collect();
            ink.draw("belief/union/frontier", &dots(&at, &[palette::FRONTIER], 3.0));
        }
        UnionEvent::GivenUp { place, .. } => {
            ink.draw("belief/union/given_up", &dots(&[*place], &[palette::GIVEN_UP], 5.0));
        }
        UnionEvent::United { map, .. }
        | UnionEvent::Cleaned { map, .. }
        | UnionEvent::Rebuilt { map, .. } => draw_map(ink, map),
        UnionEvent::Corrected { before, after, .. } => {
            ink.draw("belief/union/before", &trajectory(before, palette::BEFORE));
            ink.draw("belief/union/after", &trajectory(after, palette::CORRECTED));
        }
        UnionEvent::Planned { plan, given } => {
            planner::draw_plan(ink, "belief/union/plan", plan, given, &Se3::identity());
        }
        _ => {}
    }
}

/// The sides of all faces, each once.
fn sides(mesh: &Polyhedron) -> Vec<[Point3; 2]> {
    let sides = mesh.faces().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    // Of a closed surface each comes once in either direction.
    let once = sides.filter(|[a, b]| a < b);
    once.map(|ends| ends.map(|corner| mesh.vertices()[corner as usize])).collect()
}

fn draw_map(ink: &mut Ink, map: &Polyhedron) {
    ink.draw("belief/union/map", &Faces::inside_of(map).mesh());
}

/// Where the map's frame lies in the one that is drawn; at all times.
pub(super) fn place(ink: &mut Ink, world_from_map: &Se3) {
    ink.always("belief/union", &placed(world_from_map));
}

/// One line about an event of the united map.
pub(super) fn line(event: &UnionEvent<'_>) -> String {
    match event {
        UnionEvent::Placed { view, vertex, operand, .. } => {
            format!("view {view} at vertex {vertex}: {} faces", operand.faces().len())
        }
        UnionEvent::United { view, map, settled } => format!(
            "view {view}: the map has {} faces, {settled} of frontier became obstacle",
            map.faces().len()
        ),
        UnionEvent::Cleaned { map, .. } => format!("{} faces are left", map.faces().len()),
        UnionEvent::Refused { view, why } => format!("view {view}: {why}"),
        UnionEvent::Sorted { patches, sliver_m2 } => {
            format!("{} patches of frontier, {sliver_m2:.3} m² too small", patches.len())
        }
        UnionEvent::Corrected { new_places, moved_max_m, .. } => {
            format!("{new_places} places: vertices moved by up to {moved_max_m:.2} m")
        }
        UnionEvent::NotCorrected { .. } => "the poses stay as they were".to_owned(),
        UnionEvent::Rebuilt { views, moved_max_m, map } => {
            format!("{views} views, moved by up to {moved_max_m:.2} m: {} faces", map.faces().len())
        }
        UnionEvent::Filled { tetrahedra } => {
            format!("{} tetrahedra", tetrahedra.tetrahedra.len())
        }
        UnionEvent::Fanned { why, fans } => format!("{fans} fans in place of tetrahedra: {why}"),
        UnionEvent::Planned { plan, given } => {
            format!("{}, {} points given", planner::lengths(plan), given.len())
        }
        UnionEvent::GivenUp { radius_m, unreachable, .. } => {
            let why = if *unreachable { "no way leads there" } else { "it was looked at" };
            format!("within {radius_m:.2} m: {why}")
        }
    }
}

/// What an event is about.
pub(super) fn family_of(event: &UnionEvent<'_>) -> Family {
    match event {
        UnionEvent::Corrected { .. }
        | UnionEvent::NotCorrected { .. }
        | UnionEvent::Rebuilt { .. } => Family::Correction,
        UnionEvent::Filled { .. } | UnionEvent::Fanned { .. } | UnionEvent::Planned { .. } => {
            Family::Planner
        }
        _ => Family::Polygons,
    }
}

fn trajectory(map_from_vertex: &[Se3], colour: crate::columns::Rgba) -> rerun::LineStrips3D {
    let way: Vec<Point3> = map_from_vertex.iter().map(|pose| pose.translation.into()).collect();
    lines(&[way], colour, 1.5)
}
