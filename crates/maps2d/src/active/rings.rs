//! Rings of anchored corners.

use geometry::Point2;
use geometry::planar::overlay::{self, EdgeLabel, Region, Ring, RingEdge};
use geometry::predicates::orient;
use pose::Se2;
use probe::VertexId;

use crate::polygons::{Tag, region_of};
use crate::volume::LocalVolume;

/// A corner of a ring, with the edge that starts there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is, in the map's frame.
    pub at: Point2,
    /// The vertex of the pose graph that it moves with.
    pub anchor: VertexId,
    /// What the edge from here to the next corner is, and where it comes from.
    pub edge: RingEdge<Tag>,
}

/// A view moves by up to this, so that nothing lies exactly on anything, metres.
const NUDGE_M: f64 = 1e-4;

/// The ring of a view, pulled in by a margin, in the map's frame; counter-clockwise.
pub(super) fn ring_of(
    vertex: VertexId,
    volume: &LocalVolume,
    map_from_vertex: &Se2,
    margin_m: f64,
    scan: u64,
) -> Vec<Corner> {
    let view = region_of(vertex, volume, &Se2::identity());
    let Some(ring) = view.rings.into_iter().next() else { return Vec::new() };
    let corners = ring.points.iter().zip(ring.edges).enumerate().map(|(i, (point, edge))| {
        let radius_m = point.coords.norm();
        let pulled = if radius_m > 2.0 * margin_m {
            Point2::from(point.coords * (1.0 - margin_m / radius_m))
        } else {
            *point
        };
        let (dx, dy) = nudge(u64::from(vertex.0) << 32 | i as u64, scan);
        let at = map_from_vertex.transform(&Point2::new(pulled.x + dx, pulled.y + dy));
        Corner { at, anchor: vertex, edge }
    });
    corners.collect()
}

/// A displacement that depends on its arguments only.
fn nudge(key: u64, scan: u64) -> (f64, f64) {
    let mut z = key.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(scan);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    let share = |bits: u64| (bits & 0xffff) as f64 / 32_768.0 - 1.0;
    (NUDGE_M * share(z), NUDGE_M * share(z >> 32))
}

/// Twice the signed area of a ring, square metres.
pub(super) fn twice_area_m2(ring: &[Corner]) -> f64 {
    let Some(first) = ring.first() else { return 0.0 };
    let from_first = |corner: &Corner| corner.at - first.at;
    ring.windows(2).map(|pair| from_first(&pair[0]).perp(&from_first(&pair[1]))).sum()
}

/// How often a ring winds around a point.
pub(super) fn winding(ring: &[Corner], point: &Point2) -> i32 {
    overlay::winding(ring.iter().map(|corner| corner.at), point)
}

pub(super) fn next(ring: &[Corner], i: usize) -> usize {
    if i + 1 == ring.len() { 0 } else { i + 1 }
}

/// The ring run the other way round; every edge keeps its label.
pub(super) fn reversed(ring: &[Corner]) -> Vec<Corner> {
    (0..ring.len())
        .rev()
        .map(|i| {
            // The edge that ended here starts here now.
            let before = if i == 0 { ring.len() - 1 } else { i - 1 };
            Corner { edge: ring[before].edge, ..ring[i] }
        })
        .collect()
}

/// Whether two directed edges cross; points on a line count as to its left.
pub(super) fn crosses(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> bool {
    let apart = |x: f64, y: f64, z: f64, w: f64| x.max(y) < z.min(w) || z.max(w) < x.min(y);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let left = |p: &Point2, q: &Point2, r: &Point2| orient(p, q, r) >= 0.0;
    left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b)
}

/// The parameters along both edges where they cross.
pub(super) fn parameters(a: &Point2, b: &Point2, c: &Point2, d: &Point2) -> (f64, f64) {
    let (along, edge) = (b - a, d - c);
    let slope = along.perp(&edge);
    if slope == 0.0 {
        return (0.5, 0.5);
    }
    let t = (c - a).perp(&edge) / slope;
    let s = (c - a).perp(&along) / slope;
    (t.clamp(0.0, 1.0), s.clamp(0.0, 1.0))
}

/// The rings as a region, as they are: they may overlap.
pub(super) fn region_of_rings(rings: &[Vec<Corner>]) -> Region<Tag> {
    let ring = |ring: &Vec<Corner>| Ring {
        points: ring.iter().map(|corner| corner.at).collect(),
        edges: ring.iter().map(|corner| corner.edge).collect(),
    };
    Region { rings: rings.iter().map(ring).collect() }
}

/// The label of an edge that takes the place of two: what is unknown behind either is unknown.
pub(super) fn joined(before: RingEdge<Tag>, after: RingEdge<Tag>) -> RingEdge<Tag> {
    if before.label == EdgeLabel::Frontier { before } else { after }
}

/// The box around a ring.
pub(super) fn box_of(ring: &[Corner]) -> Option<(Point2, Point2)> {
    let first = ring.first()?.at;
    Some(ring.iter().fold((first, first), |(low, high), c| (low.inf(&c.at), high.sup(&c.at))))
}

/// Whether the boxes around two rings meet.
pub(super) fn boxes_meet(a: &[Corner], b: &[Corner]) -> bool {
    let (Some((a_low, a_high)), Some((b_low, b_high))) = (box_of(a), box_of(b)) else {
        return false;
    };
    a_low.x <= b_high.x && b_low.x <= a_high.x && a_low.y <= b_high.y && b_low.y <= a_high.y
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::volume::EdgeKey;

    /// A ring of frontier, all of it seen from one vertex.
    pub fn ring(vertex: u32, corners: &[(f64, f64)]) -> Vec<Corner> {
        let vertex = VertexId(vertex);
        let tag = Tag { vertex, key: EdgeKey(0), spoke: false };
        let edge = RingEdge { label: EdgeLabel::Frontier, data: tag };
        let corner = |&(x, y)| Corner { at: Point2::new(x, y), anchor: vertex, edge };
        corners.iter().map(corner).collect()
    }

    /// A box, counter-clockwise.
    pub fn rectangle(vertex: u32, low: (f64, f64), high: (f64, f64)) -> Vec<Corner> {
        ring(vertex, &[low, (high.0, low.1), high, (low.0, high.1)])
    }

    pub fn areas_m2(rings: &[Vec<Corner>]) -> Vec<f64> {
        let mut areas: Vec<f64> = rings.iter().map(|ring| 0.5 * twice_area_m2(ring)).collect();
        areas.sort_by(f64::total_cmp);
        areas
    }
}
