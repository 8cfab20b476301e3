//! Reading a graph file: lines to vertices and edges, and what was strange about them.

use nalgebra::SMatrix;
use pose::{Se2, Se3};
use posegraph::Factor;

use super::assemble::assemble;
use super::records::Record;
use super::report::{GraphFileReport, Tally, UnknownTag, WarningKind};
use super::tags::{self, GraphFormat, Tag};
use super::{AnyGraph, GraphFile};
use crate::FormatError;
use crate::binary::refuse_binary;
use crate::error::quote;
use crate::lexer::Lexer;
use crate::lines::with_line_feeds;

/// Reads a pose graph from the bytes of a g2o or TORO file, in two or three dimensions.
///
/// Vertices come out in the order of their ids, edges in the order of the file. Memory and time are
/// linear in the size of the file (sorting the ids where they are sparse adds a logarithm). Lines end
/// with a line feed, with or without a carriage return before it; in a file without any, with a return.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column: a number that is none or not finite, a line
/// that ends too early, a quaternion without a direction, two and three dimensions in one file, or
/// a file without any vertex or edge. Everything else is in the report.
pub fn read(bytes: &[u8]) -> Result<GraphFile, FormatError> {
    const EXPECTED: &str = "a pose graph: a line that starts with VERTEX_SE2, VERTEX_SE3:QUAT, \
                            EDGE_SE2, EDGE_SE3:QUAT, VERTEX2, VERTEX3, EDGE2 or EDGE3";
    let bytes = &*with_line_feeds(bytes);
    let Some((format, dimensions)) = first_tag(bytes) else {
        refuse_binary(bytes, EXPECTED)?;
        let mut lexer = Lexer::new(bytes);
        lexer.next_line();
        return Err(lexer.unexpected(EXPECTED));
    };
    if dimensions == 2 {
        let (graph, report) = assemble(collect::<Se2, 3>(bytes, format)?);
        Ok(GraphFile { graph: AnyGraph::Plane(graph), report })
    } else {
        let (graph, report) = assemble(collect::<Se3, 6>(bytes, format)?);
        Ok(GraphFile { graph: AnyGraph::Space(graph), report })
    }
}

/// Dialect and dimensions of the first vertex or edge.
pub(crate) fn first_tag(bytes: &[u8]) -> Option<(GraphFormat, u8)> {
    let mut lexer = Lexer::new(bytes);
    while lexer.next_line() {
        if let Some(Tag::Pose { format, dimensions, .. }) = Tag::of(lexer.word()) {
            return Some((format, dimensions));
        }
    }
    None
}

/// What the lines of a file say, in their order; ids are the file's.
pub(super) struct Collected<P, const D: usize> {
    pub vertices: Vec<(u64, P)>,
    pub vertex_lines: Vec<u32>,
    /// Ends of `factors`, whose own indices are not set yet.
    pub ends: Vec<(u64, u64)>,
    pub factors: Vec<Factor<P, D>>,
    pub edge_lines: Vec<u32>,
    pub fixed: Vec<(u64, u32)>,
    pub report: GraphFileReport,
}

/// Warnings that are counted while lines are read.
#[derive(Default)]
struct Tallies {
    norms: Tally,
    worst_norm: f64,
    trailing: Tally,
    loops: Tally,
    loop_id: u64,
    indefinite: Tally,
}

fn collect<P: Record<D>, const D: usize>(
    bytes: &[u8],
    format: GraphFormat,
) -> Result<Collected<P, D>, FormatError> {
    let mut lexer = Lexer::new(bytes);
    let mut tallies = Tallies::default();
    // Lines of edges hold at least about 80 bytes as a rule: room that is seldom outgrown.
    let room = bytes.len() / 100;
    let mut all = Collected {
        vertices: Vec::with_capacity(room / 4),
        vertex_lines: Vec::with_capacity(room / 4),
        ends: Vec::with_capacity(room),
        factors: Vec::with_capacity(room),
        edge_lines: Vec::with_capacity(room),
        fixed: Vec::new(),
        report: GraphFileReport {
            format,
            lines: 0,
            vertex_lines: 0,
            edge_lines: 0,
            unknown_tags: Vec::new(),
            warnings: Vec::new(),
        },
    };
    // The matrix before, and whether it was definite: most files repeat one matrix.
    let mut known = (SMatrix::<f64, D, D>::identity(), true);
    while lexer.next_line() {
        let mark = lexer.mark();
        let word = lexer.word();
        let line = lexer.line();
        let Some(tag) = Tag::of(word) else {
            count_unknown(&mut all.report.unknown_tags, word, line);
            continue;
        };
        let Tag::Pose { record, format, dimensions } = tag else {
            loop {
                all.fixed.push((lexer.id("the id of a vertex to hold")?, line_number(line)));
                if lexer.at_end_of_line() {
                    break;
                }
            }
            continue;
        };
        if dimensions != P::DIMENSIONS {
            let found = format!("{} in a file that starts in {}D", text(word), P::DIMENSIONS);
            let expected = format!("vertices and edges in {}D only", P::DIMENSIONS);
            return Err(FormatError::unexpected(lexer.position_of(mark), found, expected));
        }
        let norm = match record {
            tags::Record::Vertex => {
                let id = lexer.id("the id of the vertex")?;
                let (pose, norm) = P::read(&mut lexer, format)?;
                all.vertices.push((id, pose));
                all.vertex_lines.push(line_number(line));
                all.report.vertex_lines += 1;
                norm
            }
            tags::Record::Edge => {
                let from = lexer.id("the id of the vertex that the edge comes from")?;
                let to = lexer.id("the id of the vertex that the edge leads to")?;
                let (from_from_to, norm) = P::read(&mut lexer, format)?;
                let information = P::read_information(&mut lexer, format, &from_from_to)?;
                all.report.edge_lines += 1;
                if from == to {
                    if tallies.loops.add(line) {
                        tallies.loop_id = from;
                    }
                } else {
                    if known.0 != information {
                        known = (information, information.cholesky().is_some());
                    }
                    if !known.1 {
                        tallies.indefinite.add(line);
                    }
                    all.ends.push((from, to));
                    all.factors.push(Factor { from: 0, to: 0, from_from_to, information });
                    all.edge_lines.push(line_number(line));
                }
                norm
            }
        };
        if let Some(norm) = norm {
            let first = tallies.norms.add(line);
            if first || (norm - 1.0).abs() > (tallies.worst_norm - 1.0).abs() {
                tallies.worst_norm = norm;
            }
        }
        if !lexer.at_end_of_line() {
            tallies.trailing.add(line);
        }
    }
    all.report.lines = lexer.line();
    all.report.warnings.extend(
        [
            tallies
                .norms
                .warning(WarningKind::NonUnitQuaternion { worst_norm: tallies.worst_norm }),
            tallies.trailing.warning(WarningKind::TrailingWords),
            tallies.loops.warning(WarningKind::SelfLoop { first_id: tallies.loop_id }),
            tallies.indefinite.warning(WarningKind::IndefiniteInformation),
        ]
        .into_iter()
        .flatten(),
    );
    Ok(all)
}

/// Lines beyond 2³² are told as the last one that fits.
fn line_number(line: usize) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}

fn text(word: &[u8]) -> String {
    quote(&String::from_utf8_lossy(word))
}

/// The most unknown tags that are told apart; a file of words is not a graph.
const MAX_UNKNOWN: usize = 64;

fn count_unknown(unknown: &mut Vec<UnknownTag>, word: &[u8], line: usize) {
    let known = unknown.iter_mut().find(|unknown| {
        unknown.tag.len() == word.len() + 2 && unknown.tag.as_bytes()[1..=word.len()] == *word
    });
    if let Some(unknown) = known {
        unknown.count += 1;
        return;
    }
    let tag = text(word);
    let full = unknown.len() >= MAX_UNKNOWN;
    match unknown.iter_mut().find(|unknown| unknown.tag == tag) {
        Some(unknown) => unknown.count += 1,
        None if full => {
            if let Some(last) = unknown.last_mut() {
                "others".clone_into(&mut last.tag);
                last.count += 1;
            }
        }
        None => unknown.push(UnknownTag { tag, count: 1, first_line: line }),
    }
}
