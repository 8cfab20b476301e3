//! The places that the robot has named, and the graph between them.

use std::collections::HashMap;

use geometry::Point2;
use pose::Se2;
use probe::{Id, VertexId};

use super::links::Links;

/// Named places: where they truly are, and how far apart the robot believes them along its graph.
#[derive(Clone, Debug)]
pub(super) struct Marks {
    poses: Vec<Option<Se2>>,
    order: Vec<VertexId>,
    links: Links,
    bucket_m: f64,
    buckets: HashMap<(i64, i64), Vec<VertexId>>,
}

impl Marks {
    /// No places; `bucket_m` is about the radius that will be asked for.
    pub(super) fn new(bucket_m: f64) -> Self {
        let bucket_m = if bucket_m.is_finite() && bucket_m > 0.0 { bucket_m } else { 1.0 };
        Self {
            poses: Vec::new(),
            order: Vec::new(),
            links: Links::default(),
            bucket_m,
            buckets: HashMap::new(),
        }
    }

    /// True pose of a vertex, `world_from_vertex`.
    pub(super) fn pose(&self, vertex: VertexId) -> Option<&Se2> {
        self.poses.get(vertex.index())?.as_ref()
    }

    /// All vertices in the order in which they were named.
    pub(super) fn order(&self) -> &[VertexId] {
        &self.order
    }

    /// Names a place. A name given again moves to the new place and keeps its links.
    pub(super) fn insert(&mut self, vertex: VertexId, world_from_vertex: Se2) {
        let index = vertex.index();
        if self.poses.len() <= index {
            self.poses.resize(index + 1, None);
        }
        match self.poses[index].replace(world_from_vertex) {
            None => self.order.push(vertex),
            Some(old) => {
                let bucket = self.bucket_of(&Point2::from(old.translation));
                if let Some(members) = self.buckets.get_mut(&bucket) {
                    members.retain(|&member| member != vertex);
                }
            }
        }
        let bucket = self.bucket_of(&Point2::from(world_from_vertex.translation));
        self.buckets.entry(bucket).or_default().push(vertex);
    }

    /// Joins two places by a way of that length; of several ways the shortest counts.
    pub(super) fn link(&mut self, a: VertexId, b: VertexId, length_m: f64) {
        if self.pose(a).is_some() && self.pose(b).is_some() {
            self.links.link(a, b, length_m);
        }
    }

    /// Places whose true distance is below `radius_m`, with it, by id.
    ///
    /// Cost: the places in the buckets around.
    pub(super) fn near(&self, point_in_world: &Point2, radius_m: f64) -> Vec<(VertexId, f64)> {
        let (column, row) = self.bucket_of(point_in_world);
        let reach = (radius_m / self.bucket_m).ceil() as i64;
        let mut found = Vec::new();
        for y in row - reach..=row + reach {
            for x in column - reach..=column + reach {
                for &vertex in self.buckets.get(&(x, y)).into_iter().flatten() {
                    let Some(pose) = self.pose(vertex) else { continue };
                    let distance_m = (pose.translation - point_in_world.coords).norm();
                    if distance_m < radius_m {
                        found.push((vertex, distance_m));
                    }
                }
            }
        }
        found.sort_unstable_by_key(|&(vertex, _)| vertex);
        found
    }

    /// Searches the graph from `from` for everything nearer than `limit_m` along it; asked of by
    /// [`reached`](Self::reached) until the next search. Cost: what lies within the limit.
    pub(super) fn search(&mut self, from: VertexId, limit_m: f64) {
        self.links.search(from, limit_m);
    }

    /// Whether the last search reached a vertex.
    pub(super) fn reached(&self, vertex: VertexId) -> bool {
        self.links.reached(vertex)
    }

    fn bucket_of(&self, point: &Point2) -> (i64, i64) {
        ((point.x / self.bucket_m).floor() as i64, (point.y / self.bucket_m).floor() as i64)
    }
}
