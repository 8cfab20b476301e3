//! The record: every vertex and edge that was ever added (\[ISRR19\] 4.2).

use pose::Se2;
use probe::{EdgeId, IdVec, VertexId};

use super::RelativePose;
use crate::PoseGraphError;

/// Where an edge comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// Integrated wheel or visual odometry between subsequent vertices.
    Odometry,
    /// Recognition of a known place.
    Place,
}

/// A measured relative pose between two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge<P = Se2> {
    /// The vertex in whose frame the measurement is given.
    pub a: VertexId,
    /// The vertex that is measured.
    pub b: VertexId,
    /// Frame of `b` in the frame of `a`.
    pub a_from_b: P,
    /// Weight of the edge: the norm of the translation, metres (\[ISRR19\] 4.3).
    pub length_m: f64,
    /// Where the measurement comes from.
    pub kind: EdgeKind,
    /// Whether the edge was taken back.
    pub withdrawn: bool,
}

impl<P: RelativePose> Edge<P> {
    /// The other end of the edge, and its frame in the frame of `from`.
    pub fn from_end(&self, from: VertexId) -> (VertexId, P) {
        if from == self.a { (self.b, self.a_from_b) } else { (self.a, self.a_from_b.inverse()) }
    }
}

/// Vertices, and the relative poses that were measured between them.
///
/// The graph knows ids and relative poses; what hangs on a vertex lives in the maps. Nothing is
/// ever removed: a withdrawn place edge stays, marked.
#[derive(Clone, Debug)]
pub struct PoseGraph<P = Se2> {
    edges: IdVec<EdgeId, Edge<P>>,
    edges_of: IdVec<VertexId, Vec<EdgeId>>,
}

impl<P> Default for PoseGraph<P> {
    fn default() -> Self {
        Self { edges: IdVec::new(), edges_of: IdVec::new() }
    }
}

impl<P: RelativePose> PoseGraph<P> {
    /// A graph without vertices.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a vertex without edges.
    pub fn add_vertex(&mut self) -> VertexId {
        self.edges_of.push(Vec::new())
    }

    /// Adds a measured relative pose: the frame of `b` in the frame of `a`.
    ///
    /// # Errors
    /// Unknown or equal vertices, and poses that are not finite.
    pub fn add_edge(
        &mut self,
        a: VertexId,
        b: VertexId,
        a_from_b: P,
        kind: EdgeKind,
    ) -> Result<EdgeId, PoseGraphError> {
        for vertex in [a, b] {
            if self.edges_of.get(vertex).is_none() {
                return Err(PoseGraphError::UnknownVertex { vertex, len: self.edges_of.len() });
            }
        }
        if a == b {
            return Err(PoseGraphError::SelfEdge { vertex: a });
        }
        let length_m = a_from_b.distance();
        if !a_from_b.is_finite() {
            return Err(PoseGraphError::NotFinite { a, b });
        }
        let edge = self.edges.push(Edge { a, b, a_from_b, length_m, kind, withdrawn: false });
        self.edges_of[a].push(edge);
        self.edges_of[b].push(edge);
        Ok(edge)
    }

    /// Takes a place edge back; it stays in the record, marked.
    ///
    /// # Errors
    /// Unknown edges, odometry edges, and edges that were withdrawn before.
    pub fn withdraw(&mut self, edge: EdgeId) -> Result<(), PoseGraphError> {
        let len = self.edges.len();
        let found = self.edges.get_mut(edge).ok_or(PoseGraphError::UnknownEdge { edge, len })?;
        if found.kind != EdgeKind::Place {
            return Err(PoseGraphError::NotAPlaceEdge { edge });
        }
        if found.withdrawn {
            return Err(PoseGraphError::AlreadyWithdrawn { edge });
        }
        found.withdrawn = true;
        Ok(())
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.edges_of.len()
    }

    /// Number of edges, withdrawn ones included.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// The edge of an id that this graph gave out.
    pub fn edge(&self, edge: EdgeId) -> &Edge<P> {
        &self.edges[edge]
    }

    /// All edges with their ids, withdrawn ones included.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = (EdgeId, &Edge<P>)> {
        self.edges.iter_ids()
    }

    /// The edges at a vertex that are not withdrawn, in the order in which they came.
    pub fn edges_of(&self, vertex: VertexId) -> impl Iterator<Item = (EdgeId, &Edge<P>)> {
        self.edges_of[vertex]
            .iter()
            .map(|&edge| (edge, &self.edges[edge]))
            .filter(|(_, edge)| !edge.withdrawn)
    }
}
