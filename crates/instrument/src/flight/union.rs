//! The united map: operands, the union, what was left beside it, tetrahedra and paths.

use geometry::Point3;
use maps3d::UnionEvent;
use pose::Se3;
use solid::Polyhedron;

use super::ink::{Faces, Ink, lines, placed};
use crate::palette;

/// Draws what an event of the united map is about under `belief/union`, in the frame `map`.
pub(super) fn draw(ink: &mut Ink, event: &UnionEvent<'_>) {
    match event {
        UnionEvent::Placed { operand, .. } => {
            ink.draw("belief/look/volume", &Faces::inside_of(operand).mesh());
        }
        UnionEvent::United { map, .. }
        | UnionEvent::Cleaned { map, .. }
        | UnionEvent::Rebuilt { map, .. } => draw_map(ink, map),
        UnionEvent::Corrected { before, after, .. } => {
            ink.draw("belief/union/before", &trajectory(before, palette::BEFORE));
            ink.draw("belief/union/after", &trajectory(after, palette::CORRECTED));
        }
        UnionEvent::Planned { plan, given } => {
            let way: Vec<Point3> = plan.centroid_path().to_vec();
            ink.draw("belief/union/plan/centroids", &lines(&[way], palette::GIVEN_UP, 1.2));
            ink.draw("belief/union/plan/path", &lines(&[given.to_vec()], palette::ROUTE, 2.5));
        }
        _ => {}
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
