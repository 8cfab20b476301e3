//! Where an edge of a global region comes from.

use geometry::planar::BoundaryKind;
use geometry::planar::overlay::{EdgeLabel, Region, RingEdge, union_all};
use pose::Se2;
use probe::VertexId;

use crate::volume::{EdgeKey, LocalVolume};

/// The edge of a local volume that an edge of a global region is a piece of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tag {
    /// The vertex that it was seen from.
    pub vertex: VertexId,
    /// Which edge of the volume there.
    pub key: EdgeKey,
    /// Whether it is an edge at the sensor: turning is enough to look behind it.
    pub spoke: bool,
}

/// A volume as a region of the map's frame, every edge with its label and tag.
pub fn region_of(vertex: VertexId, volume: &LocalVolume, map_from_vertex: &Se2) -> Region<Tag> {
    Region::from_view(
        &volume.polygon,
        |point| map_from_vertex.transform(point),
        |edge| {
            let (key, spoke) = match edge.kind {
                BoundaryKind::Chord(i) => (EdgeKey(2 * i as u32), false),
                BoundaryKind::SpokeIn(i) => (EdgeKey(2 * i as u32), true),
                BoundaryKind::SpokeOut(i) => (EdgeKey(2 * i as u32 + 1), true),
            };
            // Obstacles are kept in boundary order, so their keys ascend.
            let solid = volume.obstacles.binary_search_by_key(&key, |wall| wall.key).is_ok();
            let label = if solid { EdgeLabel::Obstacle } else { EdgeLabel::Frontier };
            RingEdge { label, data: Tag { vertex, key, spoke } }
        },
    )
}

/// Walls that run on straight become one edge where they bend by less than this, metres.
const STRAIGHT_M: f64 = 1e-3;

/// A region without the corners on straight walls; an edge keeps the tag of its first piece.
pub(crate) fn with_straight_walls(region: &Region<Tag>) -> Region<Tag> {
    let solid = |edge: &RingEdge<Tag>| edge.label == EdgeLabel::Obstacle;
    let thinned = region.thinned(STRAIGHT_M, |a, b| solid(a) && solid(b));
    // Straight edges may cross others that were near: once more through the overlay.
    union_all(&[&thinned]).map_or(thinned, |united| united.region)
}
