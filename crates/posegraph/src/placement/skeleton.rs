//! The part of the graph that placement walks: short, with spent vertices contracted away.

use std::cmp::Ordering;
use std::sync::Arc;

use pose::Se2;
use probe::{EdgeId, IdVec, VertexId};

use super::RelativePose;
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

    pub(crate) fn join(&self, next: &Via) -> Via {
        let edges: Arc<[EdgeId]> = self.edges().iter().chain(next.edges()).copied().collect();
        if let [edge] = *edges { Via::Edge(edge) } else { Via::Chain(edges) }
    }

    pub(crate) fn reversed(&self) -> Via {
        match self {
            Via::Edge(edge) => Via::Edge(*edge),
            Via::Chain(edges) => Via::Chain(edges.iter().rev().copied().collect()),
        }
    }
}

/// A way from one vertex to another that placement may take.
#[derive(Clone, Debug, PartialEq)]
pub struct Link<P = Se2> {
    /// Where the link leads.
    pub to: VertexId,
    /// Frame of [`to`](Self::to) in the frame of the vertex that holds the link.
    pub here_from_there: P,
    /// Length of the way, metres: the sum over the edges that it stands for, place edges
    /// [weighed](Skeleton::weigh_places). Placement takes the shortest.
    pub length_m: f64,
    /// The same sum with nothing weighed, metres: what a robot drives.
    pub driven_m: f64,
    /// How much of that is odometry, metres: only this drifts.
    pub odometry_m: f64,
    /// The measured edges that the link stands for.
    pub via: Via,
}

impl<P: RelativePose> Link<P> {
    /// The way of no length from a vertex to itself.
    pub(crate) fn nowhere(at: VertexId) -> Self {
        Self {
            to: at,
            here_from_there: P::identity(),
            length_m: 0.0,
            driven_m: 0.0,
            odometry_m: 0.0,
            via: Via::Chain(Arc::new([])),
        }
    }

    /// This link and then another one from where it leads.
    pub(crate) fn then(&self, next: &Link<P>) -> Self {
        Self {
            to: next.to,
            here_from_there: self.here_from_there * next.here_from_there,
            length_m: self.length_m + next.length_m,
            driven_m: self.driven_m + next.driven_m,
            odometry_m: self.odometry_m + next.odometry_m,
            via: self.via.join(&next.via),
        }
    }

    /// The same way back to `from`, which holds this link.
    pub(crate) fn back_to(&self, from: VertexId) -> Self {
        Self {
            to: from,
            here_from_there: self.here_from_there.inverse(),
            length_m: self.length_m,
            driven_m: self.driven_m,
            odometry_m: self.odometry_m,
            via: self.via.reversed(),
        }
    }

    /// The shorter first; of equally long ones that of the earlier edges.
    pub(crate) fn by_length(a: &Link<P>, b: &Link<P>) -> Ordering {
        a.length_m.total_cmp(&b.length_m).then_with(|| a.via.edges().cmp(b.via.edges()))
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Node<P> {
    pub links: Vec<Link<P>>,
    /// The links that the vertex had when it was retired, shortest first; none while it is not.
    /// They lead to vertices that were retired later, or not at all.
    pub spare: Vec<Link<P>>,
}

/// A pose graph reduced to what relative placement needs.
///
/// Vertices can be [retired](Self::retire): they are contracted, and every way through them that is
/// the shortest and no longer than the horizon lives on as one link. Hence shortest-path distances
/// and placements up to the horizon between the vertices that remain are what they were, give or
/// take the [stretch](Self::with_stretch). Farther ways may become longer, and so may ways to what
/// [comes back](Self::restore) and over edges that come to retired vertices later; but no way
/// becomes shorter than it is, and nothing that was connected comes apart.
#[derive(Clone, Debug)]
pub struct Skeleton<P = Se2> {
    pub(crate) nodes: IdVec<VertexId, Node<P>>,
    pub(crate) horizon_m: f64,
    pub(crate) stretch: f64,
    pub(crate) place_weight: f64,
    pub(crate) retired: usize,
    pub(crate) whole: bool,
}

impl<P: RelativePose> Skeleton<P> {
    /// An empty skeleton that keeps shortest ways exact up to `horizon_m` metres.
    pub fn new(horizon_m: f64) -> Self {
        Self::with_stretch(horizon_m, 1.0)
    }

    /// An empty skeleton that lets a way get longer by the factor `stretch`, at least 1, with each
    /// vertex that is retired on it.
    ///
    /// At exactly 1 every retired vertex joins all its neighbours, because the straight way is
    /// always a little shorter than the way round by another vertex, and the links of a place that
    /// is passed again and again grow with every pass. At 1.1 they are few: what remains is a
    /// sparse spanner.
    pub fn with_stretch(horizon_m: f64, stretch: f64) -> Self {
        let (nodes, stretch) = (IdVec::new(), stretch.max(1.0));
        Self { nodes, horizon_m, stretch, place_weight: 1.0, retired: 0, whole: true }
    }

    /// Lets a metre of the place edges that come from now on count as so many, above 0.
    ///
    /// Place edges do not drift: where a metre of them counts less than one of odometry, placement
    /// goes where the covariance along the way is less, as far as it grows with the odometry on it.
    pub fn weigh_places(mut self, place_weight: f64) -> Self {
        self.place_weight = place_weight;
        self
    }

    /// The same ways, with a metre of place edges counting as so many, above 0: near 0, placement goes where
    /// there is the least odometry.
    ///
    /// What was [retired](Self::retire) stays contracted to the ways that were the shortest then. O(links).
    #[must_use]
    pub fn reweighed(&self, place_weight: f64) -> Self {
        let weigh = |links: &[Link<P>]| -> Vec<Link<P>> {
            let length_m =
                |link: &Link<P>| link.odometry_m + place_weight * (link.driven_m - link.odometry_m);
            links.iter().map(|link| Link { length_m: length_m(link), ..link.clone() }).collect()
        };
        let nodes = self
            .nodes
            .iter()
            .map(|node| Node { links: weigh(&node.links), spare: weigh(&node.spare) });
        Self { nodes: nodes.collect(), place_weight, ..*self }
    }

    /// Makes room for vertices up to and including `vertex`.
    pub fn cover(&mut self, vertex: VertexId) {
        while self.nodes.next_id() <= vertex {
            self.nodes.push(Node { links: Vec::new(), spare: Vec::new() });
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

    /// Whether nothing was ever retired, so that every way is what it is along the measured edges.
    pub fn is_whole(&self) -> bool {
        self.whole
    }

    /// Whether the vertex is retired.
    pub fn is_retired(&self, vertex: VertexId) -> bool {
        !self.nodes[vertex].spare.is_empty()
    }

    /// The links at a vertex; none at a retired one.
    pub fn links(&self, vertex: VertexId) -> &[Link<P>] {
        &self.nodes[vertex].links
    }

    /// The vertex that stands for `vertex`, and the frame of `vertex` in its frame.
    ///
    /// A vertex that is not retired stands for itself.
    pub fn resolve(&self, vertex: VertexId) -> (VertexId, P) {
        let mut at = vertex;
        let mut at_from_vertex = P::identity();
        // Links of retired vertices lead to vertices that were retired later, or not at all.
        while let Some(nearest) = self.nodes[at].spare.first() {
            at_from_vertex = nearest.here_from_there.inverse() * at_from_vertex;
            at = nearest.to;
        }
        (at, at_from_vertex)
    }

    /// Adds a measured edge. Ends that are retired stay so: over a retired end the edge is led on to
    /// the nearest few vertices that are not, where no other way leads there.
    ///
    /// Cost: constant for ends that are not retired; else that of [`restore`](Self::restore), and for
    /// two ends that are, of [`retire`](Self::retire) besides.
    pub fn add_edge(&mut self, id: EdgeId, edge: &Edge<P>, scratch: &mut ScopeScratch) {
        let is_odometry = edge.kind == EdgeKind::Odometry;
        let link = Link {
            to: edge.b,
            here_from_there: edge.a_from_b,
            length_m: edge.length_m * if is_odometry { 1.0 } else { self.place_weight },
            driven_m: edge.length_m,
            odometry_m: if is_odometry { edge.length_m } else { 0.0 },
            via: Via::Edge(id),
        };
        if self.is_retired(edge.b) {
            let hidden = self.restore(edge.a, scratch);
            self.join_retired(edge.a, &link, scratch);
            if hidden {
                self.retire(edge.a, scratch);
            }
        } else if self.is_retired(edge.a) {
            self.join_retired(edge.b, &link.back_to(edge.a), scratch);
        } else {
            self.connect(edge.a, link);
        }
    }

    /// Memory held on the heap, bytes; chains that two links share are counted once.
    pub fn heap_bytes(&self) -> usize {
        let links = self.nodes.iter().flat_map(|node| node.links.iter().chain(&node.spare));
        let chains: usize = links
            .map(|link| match &link.via {
                Via::Edge(_) => 0,
                Via::Chain(edges) => edges.len() * size_of::<EdgeId>() / 2,
            })
            .sum();
        let nodes: usize = self
            .nodes
            .iter()
            .map(|node| {
                let links = node.links.capacity() + node.spare.capacity();
                size_of::<Node<P>>() + links * size_of::<Link<P>>()
            })
            .sum();
        nodes + chains
    }

    /// Adds a link at both its ends.
    pub(crate) fn connect(&mut self, from: VertexId, link: Link<P>) {
        let (to, back) = (link.to, link.back_to(from));
        self.nodes[from].links.push(link);
        self.nodes[to].links.push(back);
    }
}
