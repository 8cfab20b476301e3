//! The words that start a line.

/// In which dialect a graph file, or a line of it, is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GraphFormat {
    /// g2o: `VERTEX_SE2`, `EDGE_SE3:QUAT`, ...
    G2o,
    /// TORO: `VERTEX2`, `EDGE3`, ...
    Toro,
}

impl GraphFormat {
    /// The name for messages and for `--to`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::G2o => "g2o",
            Self::Toro => "toro",
        }
    }
}

/// What a line holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Record {
    Vertex,
    Edge,
}

/// A tag that is understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tag {
    /// A pose or a measurement, in two or three dimensions.
    Pose { record: Record, format: GraphFormat, dimensions: u8 },
    /// Vertices that are held where they are.
    Fix,
}

impl Tag {
    /// The tag of a word; `None` where it means nothing here.
    pub fn of(word: &[u8]) -> Option<Self> {
        use GraphFormat::{G2o, Toro};
        use Record::{Edge, Vertex};
        let (record, format, dimensions) = match word {
            b"EDGE_SE2" => (Edge, G2o, 2),
            b"EDGE_SE3:QUAT" => (Edge, G2o, 3),
            b"VERTEX_SE2" => (Vertex, G2o, 2),
            b"VERTEX_SE3:QUAT" => (Vertex, G2o, 3),
            b"EDGE2" | b"EDGE" | b"ODOMETRY" => (Edge, Toro, 2),
            b"EDGE3" => (Edge, Toro, 3),
            b"VERTEX2" | b"VERTEX" => (Vertex, Toro, 2),
            b"VERTEX3" => (Vertex, Toro, 3),
            b"FIX" => return Some(Self::Fix),
            _ => return None,
        };
        Some(Self::Pose { record, format, dimensions })
    }
}
