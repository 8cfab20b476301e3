//! The part of the graph that placement walks: short, with spent vertices contracted away.

use std::sync::Arc;

use pose::Se2;
use probe::{EdgeId, IdVec, VertexId};

use crate::{Edge, EdgeKind, ScopeScratch};

/// The measured edges that a link stands for, in the order in which they are walked.
#[derive(Clone, Debug, PartialEq)]
pub enum Via {
    /// One edge of the graph.
    Edge(EdgeId),
    /// Several, through vertices that were retired.
    Chain(Arc<[EdgeId]>),
}

impl Via {
    /// The edges, in one of the two walking directions.
    pub fn edges(&self) -> &[EdgeId] {
        match self {
            Via::Edge(edge) => std::slice::from_ref(edge),
            Via::Chain(edges) => edges,
        }
    }

    fn join(&self, next: &Via) -> Via {
        Via::Chain(self.edges().iter().chain(next.edges()).copied().collect())
    }
}

/// A way from one vertex to another that placement may take.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Where the link leads.
    pub to: VertexId,
    /// Frame of [`to`](Self::to) in the frame of the vertex that holds the link.
    pub here_from_there: Se2,
    /// Length of the way, metres: the sum over the edges that it stands for.
    pub length_m: f64,
    /// How much of that is odometry, metres: only this drifts.
    pub odometry_m: f64,
    /// The measured edges that the link stands for.
    pub via: Via,
}

/// Where a retired vertex hangs.
#[derive(Clone, Debug)]
struct Anchor {
    host: VertexId,
    host_from_vertex: Se2,
    length_m: f64,
    odometry_m: f64,
    via: Via,
}

#[derive(Clone, Debug, Default)]
struct Node {
    links: Vec<Link>,
    anchor: Option<Anchor>,
}

/// A pose graph reduced to what relative placement needs.
///
/// Vertices can be [retired](Self::retire): they are contracted, and every way through them that is
/// the shortest and no longer than the horizon lives on as one link. Hence shortest-path distances
/// and placements up to the horizon between the vertices that remain are what they were.
/// Farther ways may become longer, but nothing that was connected comes apart.
#[derive(Clone, Debug)]
pub struct Skeleton {
    nodes: IdVec<VertexId, Node>,
    horizon_m: f64,
    retired: usize,
}

/// Ways longer than the horizon are dropped where another way is at most this many times as long.
const DETOUR: f64 = 1.5;

impl Skeleton {
    /// An empty skeleton that keeps shortest ways exact up to `horizon_m` metres.
    pub fn new(horizon_m: f64) -> Self {
        Self { nodes: IdVec::new(), horizon_m, retired: 0 }
    }

    /// Makes room for vertices up to and including `vertex`.
    pub fn cover(&mut self, vertex: VertexId) {
        while self.nodes.next_id() <= vertex {
            self.nodes.push(Node::default());
        }
    }

    /// Number of vertices that were ever covered, retired ones included.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether no vertex was covered.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Number of retired vertices.
    pub fn retired_count(&self) -> usize {
        self.retired
    }

    /// Whether the vertex is retired.
    pub fn is_retired(&self, vertex: VertexId) -> bool {
        self.nodes[vertex].anchor.is_some()
    }

    /// The links at a vertex; none at a retired one.
    pub fn links(&self, vertex: VertexId) -> &[Link] {
        &self.nodes[vertex].links
    }

    /// The vertex that stands for `vertex`, and the frame of `vertex` in its frame.
    ///
    /// A vertex that is not retired stands for itself.
    pub fn resolve(&self, vertex: VertexId) -> (VertexId, Se2) {
        let mut at = vertex;
        let mut at_from_vertex = Se2::identity();
        while let Some(anchor) = &self.nodes[at].anchor {
            at_from_vertex = anchor.host_from_vertex * at_from_vertex;
            at = anchor.host;
        }
        (at, at_from_vertex)
    }

    /// Adds a measured edge; ends that are retired are replaced by the vertices that stand for
    /// them. Returns the two ends and the length of the link, or `None` where both ends hang on
    /// the same vertex and the edge says nothing new.
    pub fn add_edge(&mut self, id: EdgeId, edge: &Edge) -> Option<(VertexId, VertexId, f64)> {
        let mut via = Via::Edge(id);
        let mut length_m = edge.length_m;
        let is_odometry = edge.kind == EdgeKind::Odometry;
        let mut odometry_m = if is_odometry { edge.length_m } else { 0.0 };
        let mut a_from_b = edge.a_from_b;
        let (mut a, mut b) = (edge.a, edge.b);
        while let Some(anchor) = self.nodes[a].anchor.clone() {
            via = anchor.via.join(&via);
            length_m += anchor.length_m;
            odometry_m += anchor.odometry_m;
            a_from_b = anchor.host_from_vertex * a_from_b;
            a = anchor.host;
        }
        while let Some(anchor) = self.nodes[b].anchor.clone() {
            let back: Arc<[EdgeId]> = anchor.via.edges().iter().rev().copied().collect();
            via = via.join(&Via::Chain(back));
            length_m += anchor.length_m;
            odometry_m += anchor.odometry_m;
            a_from_b = a_from_b * anchor.host_from_vertex.inverse();
            b = anchor.host;
        }
        if a == b {
            return None;
        }
        self.connect(a, b, a_from_b, (length_m, odometry_m), via);
        Some((a, b, length_m))
    }

    /// Memory held on the heap, bytes; chains that two links share are counted once.
    pub fn heap_bytes(&self) -> usize {
        let links = self.nodes.iter().flat_map(|node| &node.links);
        let chains: usize = links
            .map(|link| match &link.via {
                Via::Edge(_) => 0,
                Via::Chain(edges) => edges.len() * size_of::<EdgeId>() / 2,
            })
            .sum();
        let nodes: usize = self
            .nodes
            .iter()
            .map(|node| size_of::<Node>() + node.links.capacity() * size_of::<Link>())
            .sum();
        nodes + chains
    }

    fn connect(
        &mut self,
        a: VertexId,
        b: VertexId,
        a_from_b: Se2,
        (length_m, odometry_m): (f64, f64),
        via: Via,
    ) {
        let back = Via::Chain(via.edges().iter().rev().copied().collect());
        let back = if let Via::Edge(edge) = via { Via::Edge(edge) } else { back };
        self.nodes[a].links.push(Link {
            to: b,
            here_from_there: a_from_b,
            length_m,
            odometry_m,
            via,
        });
        self.nodes[b].links.push(Link {
            to: a,
            here_from_there: a_from_b.inverse(),
            length_m,
            odometry_m,
            via: back,
        });
    }

    /// Contracts a vertex: afterwards it has no links and hangs on its nearest neighbour.
    ///
    /// Every pair of its neighbours whose shortest way led through it, and is no longer than the
    /// horizon, gets that way as a link. Returns whether it was done: a vertex without neighbours
    /// and a vertex that is retired already are left alone.
    ///
    /// Cost: a bounded search per neighbour.
    pub fn retire(&mut self, vertex: VertexId, scratch: &mut ScopeScratch) -> bool {
        if self.is_retired(vertex) {
            return false;
        }
        let mut links = std::mem::take(&mut self.nodes[vertex].links);
        // The shorter of parallel links is the only one that a shortest way can use.
        links.sort_by(|a, b| a.length_m.total_cmp(&b.length_m).then(a.to.cmp(&b.to)));
        let mut seen: Vec<VertexId> = Vec::with_capacity(links.len());
        links.retain(|link| {
            let first = !seen.contains(&link.to);
            seen.push(link.to);
            first
        });
        let Some(nearest) = links.first() else { return false };
        self.nodes[vertex].anchor = Some(Anchor {
            host: nearest.to,
            host_from_vertex: nearest.here_from_there.inverse(),
            length_m: nearest.length_m,
            odometry_m: nearest.odometry_m,
            via: Via::Chain(nearest.via.edges().iter().rev().copied().collect()),
        });
        self.retired += 1;
        for link in &links {
            self.nodes[link.to].links.retain(|back| back.to != vertex);
        }
        // Shorter composed ways first, so that they can witness against longer ones.
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for i in 0..links.len() {
            for j in i + 1..links.len() {
                pairs.push((links[i].length_m + links[j].length_m, i, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (length_m, i, j) in pairs {
            let (x, y) = (&links[i], &links[j]);
            let bound_m = if length_m <= self.horizon_m { length_m } else { DETOUR * length_m };
            if scratch.distance_within(self, x.to, y.to, bound_m).is_some() {
                continue;
            }
            let x_from_y = x.here_from_there.inverse() * y.here_from_there;
            let back: Arc<[EdgeId]> = x.via.edges().iter().rev().copied().collect();
            let via = Via::Chain(back).join(&y.via);
            let lengths_m = (length_m, x.odometry_m + y.odometry_m);
            self.replace(x.to, y.to, x_from_y, lengths_m, via);
        }
        true
    }

    /// Takes a retired vertex in again: it hangs on the vertex that stood for it by one link.
    ///
    /// Ways between other vertices stay what they are. Returns whether the vertex was retired.
    pub fn restore(&mut self, vertex: VertexId) -> bool {
        let Some(mut anchor) = self.nodes[vertex].anchor.take() else { return false };
        while let Some(next) = self.nodes[anchor.host].anchor.clone() {
            anchor = Anchor {
                host: next.host,
                host_from_vertex: next.host_from_vertex * anchor.host_from_vertex,
                length_m: next.length_m + anchor.length_m,
                odometry_m: next.odometry_m + anchor.odometry_m,
                via: next.via.join(&anchor.via),
            };
        }
        self.retired -= 1;
        let Anchor { host, host_from_vertex, length_m, odometry_m, via } = anchor;
        self.connect(host, vertex, host_from_vertex, (length_m, odometry_m), via);
        true
    }

    /// Adds a link and drops longer ones between the same two vertices.
    fn replace(
        &mut self,
        a: VertexId,
        b: VertexId,
        a_from_b: Se2,
        lengths_m: (f64, f64),
        via: Via,
    ) {
        self.nodes[a].links.retain(|link| link.to != b);
        self.nodes[b].links.retain(|link| link.to != a);
        self.connect(a, b, a_from_b, lengths_m, via);
    }
}
