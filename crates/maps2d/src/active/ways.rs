//! The free space of the area, for ways through it.

use geometry::Point2;
use geometry::planar::overlay::{Region, union_all};
use pose::Se2;
use probe::VertexId;

use super::area::Area;
use crate::polygons::{Tag, region_of, with_straight_walls};
use crate::volume::LocalVolume;

/// A view adds nothing to the ways where its corners, pulled in by this, lie in views that were taken
/// before it, metres.
const ADDS_M: f64 = 0.03;

/// What the views of the area saw, united; views that add nothing are left out, so that a place does
/// not get dearer to plan in the more often the robot passes it.
///
/// Nearest views come first. Cost: corners of all views times the views taken, each a search by
/// bearing; and the union of the views taken.
pub(super) fn region_inside<'a>(
    area: &Area,
    view: impl Fn(VertexId) -> Option<&'a LocalVolume>,
    pose: impl Fn(VertexId) -> Se2,
) -> Region<Tag> {
    let mut taken: Vec<(&LocalVolume, Se2)> = Vec::new();
    let mut placed: Vec<Region<Tag>> = Vec::new();
    for &vertex in area.vertices() {
        let Some(volume) = view(vertex) else { continue };
        let map_from_vertex = pose(vertex);
        let is_known = |corner: &Point2| {
            let distance_m = corner.coords.norm();
            if distance_m <= ADDS_M {
                return true;
            }
            let at = map_from_vertex
                .transform(&Point2::from(corner.coords * (1.0 - ADDS_M / distance_m)));
            let holds = |(other, other_from_map): &(&LocalVolume, Se2)| {
                other.polygon.contains(&other_from_map.transform(&at))
            };
            taken.iter().any(holds)
        };
        let region = region_of(vertex, volume, &Se2::identity());
        let mut corners = region.rings.iter().flat_map(|ring| &ring.points);
        if !taken.is_empty() && corners.all(is_known) {
            continue;
        }
        placed.push(region_of(vertex, volume, &map_from_vertex));
        taken.push((volume, map_from_vertex.inverse()));
    }
    let all: Vec<&Region<Tag>> = placed.iter().collect();
    union_all(&all).map(|united| with_straight_walls(&united.region)).unwrap_or_default()
}
