//! Relative placement along shortest paths, and the consolidation scope (\[ISRR19\] 4.2, 4.3).

use pose::Se2;
use probe::{EdgeId, VertexId};
use search::{Graph, Scratch, dijkstra_nearest};

use super::RelativePose;
use crate::{Link, Skeleton};

/// The skeleton as the search sees it: what its links cost.
struct Ways<'a, P> {
    skeleton: &'a Skeleton<P>,
    cost_m: fn(&Link<P>) -> f64,
}

impl<'a, P> Ways<'a, P> {
    /// For placement.
    fn by_length(skeleton: &'a Skeleton<P>) -> Self {
        Self { skeleton, cost_m: |link| link.length_m }
    }

    /// For driving.
    fn as_driven(skeleton: &'a Skeleton<P>) -> Self {
        Self { skeleton, cost_m: |link| link.driven_m }
    }
}

impl<P: RelativePose> Graph for Ways<'_, P> {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        self.skeleton.len()
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        for link in self.skeleton.links(from) {
            visit(link.to, (self.cost_m)(link));
        }
    }
}

/// A vertex placed relative to the root of a scope, along its shortest path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<P = Se2> {
    /// The vertex.
    pub vertex: VertexId,
    /// Its frame in the frame of the root.
    pub root_from_vertex: P,
    /// Length of the shortest path from the root, metres.
    pub distance_m: f64,
    /// How much of that is odometry, metres: only this drifts.
    pub odometry_m: f64,
    /// Position in [`Scope::placed`] of the vertex before it on that path; `None` at the root.
    pub parent: Option<u32>,
}

/// How a vertex lies relative to the root: a shorthand for one row of a scope.
pub type Placement = Se2;

/// All vertices within a radius of a root along the graph, nearest first.
#[derive(Clone, Debug)]
pub struct Scope<P = Se2> {
    placed: Vec<Placed<P>>,
}

impl<P> Default for Scope<P> {
    fn default() -> Self {
        Self { placed: Vec::new() }
    }
}

impl<P: RelativePose> Scope<P> {
    /// The vertices with their placements, by rising distance; the root is the first.
    pub fn placed(&self) -> &[Placed<P>] {
        &self.placed
    }

    /// The root, or `None` in a scope that was never filled.
    pub fn root(&self) -> Option<VertexId> {
        self.placed.first().map(|root| root.vertex)
    }

    /// The measured edges on the tree path between two rows of the scope.
    ///
    /// Edges that both rows share towards the root are not on it.
    pub fn path_between(&self, skeleton: &Skeleton<P>, a: usize, b: usize) -> Vec<EdgeId> {
        let (mut i, mut j) = (a, b);
        let mut head: Vec<EdgeId> = Vec::new();
        let mut tail: Vec<&Link<P>> = Vec::new();
        // Rows are sorted by distance, so a parent always comes before its child: climbing from
        // the later row meets the other at their last common vertex.
        while i != j {
            if i > j {
                let Some(parent) = self.placed[i].parent else { break };
                if let Some(link) = self.link(skeleton, i, parent as usize) {
                    head.extend_from_slice(link.via.edges());
                }
                i = parent as usize;
            } else {
                let Some(parent) = self.placed[j].parent else { break };
                if let Some(link) = self.link(skeleton, parent as usize, j) {
                    tail.push(link);
                }
                j = parent as usize;
            }
        }
        for link in tail.iter().rev() {
            head.extend_from_slice(link.via.edges());
        }
        head
    }

    fn link<'s>(&self, skeleton: &'s Skeleton<P>, from: usize, to: usize) -> Option<&'s Link<P>> {
        shortest_link(skeleton, self.placed[from].vertex, self.placed[to].vertex)
    }
}

/// The shortest of the links from one vertex to its neighbour; the first of equals.
fn shortest_link<P: RelativePose>(
    skeleton: &Skeleton<P>,
    from: VertexId,
    to: VertexId,
) -> Option<&Link<P>> {
    skeleton.links(from).iter().filter(|link| link.to == to).min_by(|a, b| Link::by_length(a, b))
}

/// Memory that placements reuse, so that a step allocates nothing once it is warm.
#[derive(Clone, Debug, Default)]
pub struct ScopeScratch {
    search: Scratch<VertexId>,
    row_of: Vec<u32>,
}

impl ScopeScratch {
    /// Places all vertices within `radius_m` of `root` along shortest paths into `scope`.
    ///
    /// A root that the skeleton does not hold, or that is retired, gives a scope of itself alone.
    /// Cost: O(k log k) for k links inside the radius, whatever the size of the graph.
    pub fn place<P: RelativePose>(
        &mut self,
        skeleton: &Skeleton<P>,
        root: VertexId,
        radius_m: f64,
        scope: &mut Scope<P>,
    ) {
        self.place_nearest(skeleton, root, radius_m, usize::MAX, scope);
    }

    /// [`place`](Self::place), but of the vertices within the radius only the nearest `most`, at
    /// least the root.
    pub fn place_nearest<P: RelativePose>(
        &mut self,
        skeleton: &Skeleton<P>,
        root: VertexId,
        radius_m: f64,
        most: usize,
        scope: &mut Scope<P>,
    ) {
        scope.placed.clear();
        self.row_of.resize(skeleton.len(), u32::MAX);
        let mut count = 0;
        let full = |_| {
            count += 1;
            count >= most
        };
        let found =
            dijkstra_nearest(&Ways::by_length(skeleton), root, radius_m, full, &mut self.search);
        let Ok(tree) = found.map(|found| found.tree) else {
            let root_from_vertex = P::identity();
            scope.placed.push(Placed {
                vertex: root,
                root_from_vertex,
                distance_m: 0.0,
                odometry_m: 0.0,
                parent: None,
            });
            return;
        };
        for settled in tree.settled() {
            let row = scope.placed.len() as u32;
            self.row_of[settled.node.0 as usize] = row;
            let (parent, root_from_vertex, odometry_m) = match settled.parent {
                None => (None, P::identity(), 0.0),
                Some(before) => {
                    let parent = self.row_of[before.0 as usize];
                    let before_row = scope.placed[parent as usize];
                    let (step, drifting_m) = shortest_link(skeleton, before, settled.node)
                        .map_or_else(
                            || (P::identity(), 0.0),
                            |link| (link.here_from_there, link.odometry_m),
                        );
                    let odometry_m = before_row.odometry_m + drifting_m;
                    (Some(parent), before_row.root_from_vertex * step, odometry_m)
                }
            };
            scope.placed.push(Placed {
                vertex: settled.node,
                root_from_vertex,
                distance_m: settled.cost,
                odometry_m,
                parent,
            });
        }
    }

    /// Length of the shortest path between two vertices if it is at most `limit_m`.
    pub fn distance_within<P: RelativePose>(
        &mut self,
        skeleton: &Skeleton<P>,
        a: VertexId,
        b: VertexId,
        limit_m: f64,
    ) -> Option<f64> {
        let nearest = dijkstra_nearest(
            &Ways::by_length(skeleton),
            a,
            limit_m,
            |node| node == b,
            &mut self.search,
        );
        nearest.ok()?.goal.map(|goal| goal.cost)
    }

    /// Lengths of the shortest paths from a vertex to others where they are at most `limit_m`, in the
    /// order of `others`; replaces what `out` holds.
    ///
    /// Cost: one search, which ends with the farthest of them.
    pub fn distances_within<P: RelativePose>(
        &mut self,
        skeleton: &Skeleton<P>,
        from: VertexId,
        others: &[VertexId],
        limit_m: f64,
        out: &mut Vec<Option<f64>>,
    ) {
        let mut waited: Vec<VertexId> = others.to_vec();
        waited.sort_unstable();
        waited.dedup();
        let mut left = waited.len();
        let is_last = |node: VertexId| {
            left -= usize::from(waited.binary_search(&node).is_ok());
            left == 0
        };
        let ways = Ways::by_length(skeleton);
        let found = dijkstra_nearest(&ways, from, limit_m, is_last, &mut self.search).ok();
        let tree = found.map(|found| found.tree);
        out.clear();
        out.extend(others.iter().map(|other| tree.as_ref()?.cost(*other)));
    }

    /// The shortest way to drive, of at most `limit_m`, from `root` to a vertex that satisfies `is_goal`: the vertices
    /// after the root, in driving order, each with the length of the link that leads to it.
    ///
    /// `Some` of an empty way means that the root itself is the goal.
    pub fn way_to_nearest<P: RelativePose>(
        &mut self,
        skeleton: &Skeleton<P>,
        root: VertexId,
        limit_m: f64,
        is_goal: impl FnMut(VertexId) -> bool,
    ) -> Option<Vec<(VertexId, f64)>> {
        let found =
            dijkstra_nearest(&Ways::as_driven(skeleton), root, limit_m, is_goal, &mut self.search)
                .ok()?;
        let goal = found.goal?.node;
        let path = found.tree.path_to(goal)?;
        let legs = path.windows(2).map(|pair| {
            let links = skeleton.links(pair[0]).iter().filter(|link| link.to == pair[1]);
            let driven_m = links.map(|link| link.driven_m).min_by(f64::total_cmp);
            (pair[1], driven_m.unwrap_or(0.0))
        });
        Some(legs.collect())
    }
}
