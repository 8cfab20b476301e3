//! The extended polygon grows along the graph (\[Zie18\] 2.8.1).

use std::collections::{BTreeSet, VecDeque};

use geometry::Point2;
use geometry::planar::{box_gap, point_segment_distance};
use pose::Se2;
use probe::VertexId;

use super::{CornerState, ExtendedMap};
use crate::volume::LocalVolume;

/// A polygon of the extended one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    pub vertex: VertexId,
    pub root_from_vertex: Se2,
}

impl ExtendedMap {
    /// The polygons that intersect that of `root` and hang together with it through such, breadth
    /// first; the root comes first.
    ///
    /// Cost: the members' neighbours, each against the polygon of the root.
    pub(super) fn grow(&self, root: VertexId) -> Vec<Member> {
        let Some(centre) = self.local(root) else { return Vec::new() };
        let mut members = vec![Member { vertex: root, root_from_vertex: Se2::identity() }];
        let mut met: BTreeSet<VertexId> = BTreeSet::from([root]);
        let mut queue: VecDeque<Member> = members.iter().copied().collect();
        while let Some(from) = queue.pop_front() {
            let links = self.links.get(from.vertex).map_or(&[][..], Vec::as_slice);
            for link in links {
                if !met.insert(link.to) {
                    continue;
                }
                let root_from_vertex = from.root_from_vertex * link.from_from_to;
                let Some(local) = self.local(link.to) else { continue };
                if meet(&centre.volume, &local.volume, &root_from_vertex) {
                    let member = Member { vertex: link.to, root_from_vertex };
                    members.push(member);
                    queue.push_back(member);
                }
            }
        }
        members
    }

    /// Marks the corners of members that lie inside others, or along their walls, as free; returns how many of each vertex.
    ///
    /// Cost: open corners times members nearby.
    pub(super) fn mark_free(&mut self, members: &[Member]) -> Vec<(VertexId, usize)> {
        let mut marked = Vec::new();
        let wall_m = self.params.wall_closing_m;
        for member in members {
            let Some(local) = self.locals[member.vertex].as_deref() else { continue };
            let mut freed: Vec<usize> = Vec::new();
            for (i, corner) in local.corners.iter().enumerate() {
                if corner.state != CornerState::Open {
                    continue;
                }
                let at_in_root = member.root_from_vertex.transform(&corner.at);
                let inside = members.iter().any(|other| {
                    let Some(state) = self.local(other.vertex) else { return false };
                    let apart = other.root_from_vertex.translation - at_in_root.coords;
                    let reach_m = state.volume.radius_m() + wall_m;
                    if other.vertex == member.vertex || apart.norm() > reach_m {
                        return false;
                    }
                    let at = other.root_from_vertex.inverse_transform(&at_in_root);
                    let walls = &state.volume.obstacles;
                    state.volume.inner.contains(&at)
                        || walls.iter().any(|wall| {
                            box_gap(&at, &at, &wall.from, &wall.to) < wall_m
                                && point_segment_distance(&at, &wall.from, &wall.to) < wall_m
                        })
                });
                if inside {
                    freed.push(i);
                }
            }
            if let Some(local) = self.locals[member.vertex].as_deref_mut()
                && !freed.is_empty()
            {
                freed.iter().for_each(|&i| local.corners[i].state = CornerState::Free);
                marked.push((member.vertex, freed.len()));
            }
        }
        marked
    }
}

/// Whether two volumes share some inside.
fn meet(a: &LocalVolume, b: &LocalVolume, a_from_b: &Se2) -> bool {
    let apart_m = a_from_b.translation.norm();
    if apart_m > a.radius_m() + b.radius_m() {
        return false;
    }
    let mut inside = Vec::new();
    let enters = b.polygon.boundary().any(|edge| {
        inside.clear();
        let (from, to) = (a_from_b.transform(&edge.from), a_from_b.transform(&edge.to));
        a.polygon.clip(&from, &to, &mut inside);
        inside.iter().any(|span| !span.is_empty())
    });
    // Else one may lie in the other, as a whole.
    enters
        || a.polygon
            .vertices()
            .first()
            .is_some_and(|v| b.polygon.contains(&a_from_b.inverse_transform(&halfway(v))))
}

/// A point inside the wedge of a vertex, whatever lies beside it.
fn halfway(vertex: &Point2) -> Point2 {
    Point2::from(vertex.coords * 0.5)
}
