//! What a robot did, as MCAP.

use std::io::Write;
use std::sync::Arc;

use formats::FormatError;
use formats::log::{
    Content, Decision, DecisionMessage, EdgeMessage, Header, OdometryMessage, ScanMessage,
    SceneEntity, SceneLines, Stamp, StandingMessage, Transform, spatial,
};
use formats::mcap::McapWriter;
use maps2d::Standing;
use pose::Se2;
use posegraph::{Edge, EdgeKind};
use probe::VertexId;
use sensing::Scan;

use super::volumes::LabelledEdge;

/// The log of one robot.
///
/// | topic | what |
/// |---|---|
/// | `/scan`, `/exact/scan` | scans in the frame `base_link`: for ROS, and with all digits |
/// | `/odom` | `base_link` in `odom` at each scan, by odometry alone |
/// | `/tf` | the same; and `vertex_N` in `odom`, by odometry alone, when the vertex is founded |
/// | `/graph/standing` | before each scan: the vertex that it belongs to, and the body in its frame |
/// | `/graph/edges` | edges of the pose graph, each batch before the first scan at its newest vertex |
/// | `/graph/decisions` | what the policy told the map that steers: goals given up, also those that the map gives up itself, the last look |
/// | `/graph/scene` | the graph as lines |
/// | `/KIND/volumes` | the volumes of a map, each in the frame of its vertex, with labelled edges |
///
/// Whoever feeds a map with the edges, standings, exact scans and decisions in the order of the file gives it
/// exactly what the map of the run got: volumes and labels come out the same, bit for bit.
#[derive(Debug)]
pub struct RunLog<W: Write> {
    writer: McapWriter<W>,
    frames: Frames,
}

#[derive(Debug)]
struct Frames {
    odom: Arc<str>,
    body: Arc<str>,
}

impl<W: Write> RunLog<W> {
    /// Begins a log.
    ///
    /// # Errors
    /// [`FormatError::Write`], as all that follows.
    pub fn new(sink: W) -> Result<Self, FormatError> {
        let frames = Frames { odom: "odom".into(), body: "base_link".into() };
        Ok(Self { writer: McapWriter::new(sink)?, frames })
    }

    /// A vertex was founded; the body stands on it.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn vertex(
        &mut self,
        at: Stamp,
        vertex: VertexId,
        odom_from_vertex: &Se2,
    ) -> Result<(), FormatError> {
        let transform = Transform {
            header: Header::new(at, Arc::clone(&self.frames.odom)),
            child_frame: frame_of(vertex),
            parent_from_child: spatial(odom_from_vertex),
        };
        self.writer.write("/tf", at, &Content::Transforms(vec![transform]))
    }

    /// Edges were added at once; `odom_from_vertex` is where they are drawn.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn edges(
        &mut self,
        at: Stamp,
        edges: &[Edge],
        odom_from_vertex: impl Fn(VertexId) -> Se2,
    ) -> Result<(), FormatError> {
        let place = |vertex| {
            let at = odom_from_vertex(vertex).translation;
            [at.x, at.y, 0.0]
        };
        let mut entities = Vec::new();
        for edge in edges {
            let message = EdgeMessage {
                stamp: at,
                a: edge.a.0,
                b: edge.b.0,
                place: edge.kind == EdgeKind::Place,
                a_from_b: edge.a_from_b,
            };
            self.writer.write("/graph/edges", at, &Content::Edge(message))?;
            let rgba = match edge.kind {
                EdgeKind::Odometry => [0.3, 0.4, 0.8, 1.0],
                EdgeKind::Place => [0.9, 0.5, 0.1, 1.0],
            };
            let segments = vec![[place(edge.a), place(edge.b)]];
            entities.push(SceneEntity {
                id: format!("{}-{}", edge.a, edge.b),
                frame: Arc::clone(&self.frames.odom),
                lines: vec![SceneLines { segments, width_px: 1.5, rgba }],
                dots: Vec::new(),
            });
        }
        if entities.is_empty() {
            return Ok(());
        }
        self.writer.scene("/graph/scene", at, &entities)
    }

    /// A scan was taken; `odom_from_vertex` is that of the vertex stood on.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn scan(
        &mut self,
        at: Stamp,
        standing: &Standing,
        odom_from_vertex: &Se2,
        scan: &Scan,
    ) -> Result<(), FormatError> {
        let Frames { odom, body } = &self.frames;
        let odom_from_body = spatial(&(*odom_from_vertex * standing.vertex_from_body));
        let transform = Transform {
            header: Header::new(at, Arc::clone(odom)),
            child_frame: Arc::clone(body),
            parent_from_child: odom_from_body,
        };
        let odometry = OdometryMessage {
            header: Header::new(at, Arc::clone(odom)),
            child_frame: Arc::clone(body),
            odom_from_body,
        };
        let stood = StandingMessage {
            stamp: at,
            vertex: standing.vertex.0,
            vertex_from_body: standing.vertex_from_body,
        };
        let scan = ScanMessage {
            header: Header::new(at, Arc::clone(body)),
            scan: scan.clone(),
            range_min_m: 0.0,
            frame_from_sensor: None,
        };
        self.writer.write("/tf", at, &Content::Transforms(vec![transform]))?;
        self.writer.write("/odom", at, &Content::Odometry(odometry))?;
        self.writer.write("/graph/standing", at, &Content::Standing(stood))?;
        self.writer.write("/scan", at, &Content::Scan(scan))
    }

    /// The policy told the map of a kind something.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn decided(&mut self, at: Stamp, map: &str, decision: Decision) -> Result<(), FormatError> {
        let message = DecisionMessage { stamp: at, map: map.into(), decision };
        self.writer.write("/graph/decisions", at, &Content::Decision(message))
    }

    /// Volumes of the map `kind` are new or have other labels: each with its edges, in the frame of its
    /// vertex.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn volumes(
        &mut self,
        at: Stamp,
        kind: &str,
        volumes: impl IntoIterator<Item = (VertexId, Vec<LabelledEdge>)>,
    ) -> Result<(), FormatError> {
        let entities: Vec<SceneEntity> = volumes
            .into_iter()
            .map(|(vertex, edges)| {
                SceneEntity::volume(format!("{kind} {vertex}"), frame_of(vertex), edges)
            })
            .collect();
        if entities.is_empty() {
            return Ok(());
        }
        self.writer.scene(&format!("/{kind}/volumes"), at, &entities)
    }

    /// Ends the log.
    ///
    /// # Errors
    /// [`FormatError::Write`]
    pub fn finish(self) -> Result<W, FormatError> {
        self.writer.finish()
    }
}

fn frame_of(vertex: VertexId) -> Arc<str> {
    format!("vertex_{}", vertex.0).into()
}
