//! The feed of a run, read back from its log.

use formats::log::{Content, ContentKind, EdgeMessage, Log, Message};
use maps2d::Standing;
use posegraph::{EdgeKind, PoseGraph};
use probe::VertexId;

use super::Fed;

/// What a log lacks to be fed as it was.
#[derive(Debug, thiserror::Error, PartialEq)]
#[non_exhaustive]
pub enum RefeedError {
    /// There is no pose graph in it.
    #[error("found no standings and scans, expected the log of a run (`driftlab run --export`)")]
    NoFeed,
    /// An edge of it leads nowhere, or comes too late.
    #[error(
        "found an edge from vertex {a} to {b} where {vertices} vertices are known, expected edges of one newest vertex before the first scan there"
    )]
    Edge {
        /// Where it starts.
        a: u32,
        /// Where it ends.
        b: u32,
        /// Vertices before it.
        vertices: u32,
    },
    /// A scan was taken at a vertex that no edge leads to.
    #[error(
        "found a scan at vertex {vertex} where {vertices} vertices are known, expected one that an edge leads to"
    )]
    Standing {
        /// The vertex.
        vertex: u32,
        /// Vertices before it.
        vertices: u32,
    },
}

/// Whether a log holds what the maps of a run were fed: then its pose graph need not be estimated anew.
pub fn is_fed(log: &Log) -> bool {
    [ContentKind::Standing, ContentKind::Scan]
        .iter()
        .all(|&kind| log.topics_of(kind).next().is_some())
}

/// What the maps of a run were fed, from its log: the same edges, scans and standings in the same order, bit
/// for bit.
///
/// # Errors
/// [`RefeedError`]
pub fn refeed(log: &Log) -> Result<Vec<Fed>, RefeedError> {
    if !is_fed(log) {
        return Err(RefeedError::NoFeed);
    }
    let mut reader =
        Reader { graph: PoseGraph::new(), waiting: Vec::new(), standing: None, fed: Vec::new() };
    let copies = |message: &&Message| log.topics[message.topic].copy_of.is_none();
    for message in log.messages.iter().filter(copies) {
        match &message.content {
            Content::Edge(edge) => reader.waiting.push(edge),
            Content::Standing(standing) => {
                reader.standing = Some(Standing {
                    vertex: VertexId(standing.vertex),
                    vertex_from_body: standing.vertex_from_body,
                });
                reader.found(standing.vertex)?;
            }
            Content::Scan(scan) => {
                if let Some(standing) = reader.standing {
                    reader.fed.push(Fed::Scan { standing, scan: scan.scan.clone() });
                }
            }
            Content::Decision(message) => {
                // It came after the edges before it.
                if let Some(edge) = reader.waiting.last() {
                    reader.found(edge.b)?;
                }
                let (map, decision) = (message.map.to_string(), message.decision);
                reader.fed.push(Fed::Decided { map, decision });
            }
            _ => {}
        }
    }
    Ok(reader.fed)
}

struct Reader<'a> {
    graph: PoseGraph,
    /// Edges since the last scan.
    waiting: Vec<&'a EdgeMessage>,
    standing: Option<Standing>,
    fed: Vec<Fed>,
}

impl Reader<'_> {
    /// Adds the edges that came before a scan at `vertex`, in batches by their newest vertex.
    fn found(&mut self, vertex: u32) -> Result<(), RefeedError> {
        let count = |graph: &PoseGraph| graph.vertex_count() as u32;
        if self.graph.vertex_count() == 0 {
            let vertex = self.graph.add_vertex();
            self.fed.push(Fed::Edges { vertex, edges: Vec::new() });
        }
        let waiting = std::mem::take(&mut self.waiting);
        for batch in waiting.chunk_by(|one, next| one.b == next.b) {
            let mut edges = Vec::with_capacity(batch.len());
            for &&EdgeMessage { a, b, place, a_from_b, .. } in batch {
                let refused = RefeedError::Edge { a, b, vertices: count(&self.graph) };
                if b == count(&self.graph) {
                    self.graph.add_vertex();
                }
                let kind = if place { EdgeKind::Place } else { EdgeKind::Odometry };
                let added = self.graph.add_edge(VertexId(a), VertexId(b), a_from_b, kind);
                let Ok(edge) = added else { return Err(refused) };
                edges.push(*self.graph.edge(edge));
            }
            let vertex = VertexId(count(&self.graph) - 1);
            self.fed.push(Fed::Edges { vertex, edges });
        }
        let vertices = count(&self.graph);
        if vertex < vertices { Ok(()) } else { Err(RefeedError::Standing { vertex, vertices }) }
    }
}
