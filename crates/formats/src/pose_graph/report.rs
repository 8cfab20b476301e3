//! What a graph file held beside the graph: tags that mean nothing here, and what was put right.

use std::fmt;

use super::tags::GraphFormat;

/// A tag that is not understood; its lines were left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownTag {
    /// The tag, cut to a readable length.
    pub tag: String,
    /// How many lines it starts.
    pub count: usize,
    /// The first of them, from 1.
    pub first_line: usize,
}

/// What was found in a file that a user should know, and what was done about it.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphWarning {
    /// What it is about.
    pub kind: WarningKind,
    /// How often it was found.
    pub count: usize,
    /// The first line where it was found, from 1.
    pub first_line: usize,
}

/// The kinds of [`GraphWarning`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WarningKind {
    /// Quaternions whose norm is off by more than [`NORM_TOLERANCE`]; all are normalised.
    NonUnitQuaternion {
        /// The norm that is the farthest from 1.
        worst_norm: f64,
    },
    /// Edges to vertices that have no line of their own, in a file where others do; they are kept
    /// as vertices without a start value.
    MissingVertex {
        /// The smallest id without a line.
        first_id: u64,
        /// How many ids have none.
        vertices: usize,
    },
    /// Vertices that are given twice; the first line counts, as in g2o.
    RepeatedVertex {
        /// The id of the first.
        first_id: u64,
        /// Whether one of them says something else than the line before.
        conflicting: bool,
    },
    /// Edges that repeat another edge in every number; all are kept, so that they count twice.
    RepeatedEdge,
    /// Edges from a vertex to itself, which say nothing about poses; left out.
    SelfLoop {
        /// The id of the first.
        first_id: u64,
    },
    /// Information matrices that are not positive definite; the reader keeps them as they are, the
    /// optimiser counts negative eigenvalues as 0.
    IndefiniteInformation,
    /// `FIX` of a vertex that the file does not have; left out.
    FixedStranger {
        /// The id of the first.
        first_id: u64,
    },
    /// Words after the last number of a line; left out.
    TrailingWords,
}

/// How far from 1 the norm of a quaternion may be without a warning: files print few digits.
pub const NORM_TOLERANCE: f64 = 1e-3;

impl fmt::Display for GraphWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, count, first_line } = self;
        match kind {
            WarningKind::MissingVertex { first_id, vertices } => write!(
                f,
                "line {first_line}: {count} edge(s) lead to {vertices} vertices without a line of \
                 their own, the first is {first_id}; kept, without start values"
            ),
            WarningKind::NonUnitQuaternion { worst_norm } => write!(
                f,
                "line {first_line}: {count} quaternion(s) are not of norm 1, the worst of \
                 {worst_norm:.6}; normalised"
            ),
            WarningKind::RepeatedVertex { first_id, conflicting } => write!(
                f,
                "line {first_line}: {count} vertex line(s) repeat a vertex, the first is \
                 {first_id}{}; the first line of each counts",
                if *conflicting { ", with another pose" } else { "" }
            ),
            WarningKind::RepeatedEdge => write!(
                f,
                "line {first_line}: {count} edge(s) repeat another edge in every number; kept"
            ),
            WarningKind::SelfLoop { first_id } => write!(
                f,
                "line {first_line}: {count} edge(s) lead from a vertex to itself, the first is \
                 {first_id}; left out"
            ),
            WarningKind::IndefiniteInformation => write!(
                f,
                "line {first_line}: {count} information matrices are not positive definite; kept, but \
                 an optimiser counts their negative eigenvalues as 0"
            ),
            WarningKind::FixedStranger { first_id } => write!(
                f,
                "line {first_line}: {count} FIX of vertices that the file does not have, the \
                 first is {first_id}; left out"
            ),
            WarningKind::TrailingWords => write!(
                f,
                "line {first_line}: {count} line(s) go on after their last number; the rest is \
                 left out"
            ),
        }
    }
}

/// What a graph file held beside the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphFileReport {
    /// The dialect of the first vertex or edge.
    pub format: GraphFormat,
    /// How many lines the file has.
    pub lines: usize,
    /// Lines that hold a vertex, repeated ones included.
    pub vertex_lines: usize,
    /// Lines that hold an edge, self-loops included.
    pub edge_lines: usize,
    /// The tags that are not understood, in the order of their first lines.
    pub unknown_tags: Vec<UnknownTag>,
    /// What was found and put right, in the order of the kinds.
    pub warnings: Vec<GraphWarning>,
}

impl GraphFileReport {
    /// One line per unknown tag and per warning, for people.
    pub fn messages(&self) -> Vec<String> {
        let unknown = self.unknown_tags.iter().map(|unknown| {
            let UnknownTag { tag, count, first_line } = unknown;
            format!("line {first_line}: {count} line(s) start with the unknown tag {tag}; left out")
        });
        unknown.chain(self.warnings.iter().map(ToString::to_string)).collect()
    }
}

/// Counts one kind of warning.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub count: usize,
    pub first_line: usize,
}

impl Tally {
    /// Counts one more at a line; whether it is the first.
    pub fn add(&mut self, line: usize) -> bool {
        self.count += 1;
        if self.count == 1 {
            self.first_line = line;
        }
        self.count == 1
    }

    /// The warning, where there was one.
    pub fn warning(&self, kind: WarningKind) -> Option<GraphWarning> {
        let Self { count, first_line } = *self;
        (count > 0).then_some(GraphWarning { kind, count, first_line })
    }
}
