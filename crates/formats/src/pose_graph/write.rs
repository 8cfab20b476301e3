//! Writing graph files: vertices in their order, then edges.

use nalgebra::{Matrix3, SMatrix};
use pose::{Se2, Se3};
use posegraph::{FactorGraph, FactorGraph2, FactorGraph3};

use super::AnyGraph;
use super::bits::{angle_of, push_number};
use super::records::{Record, toro_information2, toro_information3};
use super::tags::GraphFormat;

/// The graph as a g2o or TORO file.
///
/// Numbers are the shortest that read back the same. What was read from a file and is written as
/// g2o reads back equal, bit for bit; through TORO the information of edges changes by rounding, and
/// in space so do rotations. Vertices without a start value get no line. TORO cannot hold a vertex:
/// there, `FIX` is left out. Of an information matrix the upper triangle is written.
pub fn write(graph: &AnyGraph, format: GraphFormat) -> Vec<u8> {
    match graph {
        AnyGraph::Plane(graph) => write_plane(graph, format),
        AnyGraph::Space(graph) => write_space(graph, format),
    }
}

/// A graph of the plane as a file; see [`write()`].
pub fn write_plane(graph: &FactorGraph2, format: GraphFormat) -> Vec<u8> {
    write_graph(graph, format)
}

/// A graph of space as a file; see [`write()`].
pub fn write_space(graph: &FactorGraph3, format: GraphFormat) -> Vec<u8> {
    write_graph(graph, format)
}

/// What the writer has to know about a dimension.
trait Lines<const D: usize>: Record<D> {
    /// The tags of a vertex and of an edge.
    fn tags(format: GraphFormat) -> (&'static str, &'static str);
    /// Appends the numbers of a pose, each after a blank.
    fn push(&self, out: &mut Vec<u8>, format: GraphFormat);
    /// The information of an edge as the dialect means it, and the order of its entries.
    fn information(
        information: &SMatrix<f64, D, D>,
        measured: &Self,
        format: GraphFormat,
    ) -> (SMatrix<f64, D, D>, &'static [(usize, usize)]);
}

impl Lines<3> for Se2 {
    fn tags(format: GraphFormat) -> (&'static str, &'static str) {
        match format {
            GraphFormat::G2o => ("VERTEX_SE2", "EDGE_SE2"),
            GraphFormat::Toro => ("VERTEX2", "EDGE2"),
        }
    }

    fn push(&self, out: &mut Vec<u8>, _: GraphFormat) {
        push_all(out, [self.translation.x, self.translation.y, angle_of(self)]);
    }

    fn information(
        information: &Matrix3<f64>,
        measured: &Self,
        format: GraphFormat,
    ) -> (Matrix3<f64>, &'static [(usize, usize)]) {
        match format {
            GraphFormat::G2o => (*information, &[(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]),
            GraphFormat::Toro => (
                toro_information2(information, measured),
                &[(0, 0), (0, 1), (1, 1), (2, 2), (0, 2), (1, 2)],
            ),
        }
    }
}

#[rustfmt::skip]
const UPPER: [(usize, usize); 21] = [
    (0, 0), (0, 1), (0, 2), (0, 3), (0, 4), (0, 5),
    (1, 1), (1, 2), (1, 3), (1, 4), (1, 5),
    (2, 2), (2, 3), (2, 4), (2, 5),
    (3, 3), (3, 4), (3, 5),
    (4, 4), (4, 5),
    (5, 5),
];

impl Lines<6> for Se3 {
    fn tags(format: GraphFormat) -> (&'static str, &'static str) {
        match format {
            GraphFormat::G2o => ("VERTEX_SE3:QUAT", "EDGE_SE3:QUAT"),
            GraphFormat::Toro => ("VERTEX3", "EDGE3"),
        }
    }

    fn push(&self, out: &mut Vec<u8>, format: GraphFormat) {
        push_all(out, [self.translation.x, self.translation.y, self.translation.z]);
        match format {
            GraphFormat::G2o => push_all(out, self.rotation.coords.into()),
            GraphFormat::Toro => push_all(out, roll_pitch_yaw(&self.rotation_matrix())),
        }
    }

    fn information(
        information: &SMatrix<f64, 6, 6>,
        measured: &Self,
        format: GraphFormat,
    ) -> (SMatrix<f64, 6, 6>, &'static [(usize, usize)]) {
        match format {
            GraphFormat::G2o => (*information, &UPPER),
            GraphFormat::Toro => (toro_information3(information, measured), &UPPER),
        }
    }
}

/// The angles of `Rz(yaw) Ry(pitch) Rx(roll)`; roll is taken from what is left after the yaw, so
/// that all three are exact where the pitch is a right angle, too.
fn roll_pitch_yaw(r: &Matrix3<f64>) -> [f64; 3] {
    let yaw = r[(1, 0)].atan2(r[(0, 0)]);
    let pitch = (-r[(2, 0)]).atan2(r[(0, 0)].hypot(r[(1, 0)]));
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r[(0, 2)] - cos * r[(1, 2)]).atan2(cos * r[(1, 1)] - sin * r[(0, 1)]);
    [roll, pitch, yaw]
}

fn push_all<const N: usize>(out: &mut Vec<u8>, numbers: [f64; N]) {
    for number in numbers {
        out.push(b' ');
        push_number(out, number);
    }
}

fn push_id(out: &mut Vec<u8>, id: u64) {
    let mut digits = [0; 20];
    let mut at = digits.len();
    let mut rest = id;
    loop {
        at -= 1;
        digits[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    out.push(b' ');
    out.extend_from_slice(&digits[at..]);
}

fn write_graph<P: Lines<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    format: GraphFormat,
) -> Vec<u8> {
    let (vertex, edge) = P::tags(format);
    let mut out = Vec::with_capacity(graph.ids.len() * 100 + graph.factors.len() * 240);
    let mut fixed = vec![false; graph.ids.len()];
    for &index in &graph.fixed {
        if let Some(fixed) = fixed.get_mut(index) {
            *fixed = format == GraphFormat::G2o;
        }
    }
    for ((&id, pose), fixed) in graph.ids.iter().zip(&graph.initial).zip(fixed) {
        if let Some(pose) = pose {
            out.extend_from_slice(vertex.as_bytes());
            push_id(&mut out, id);
            pose.push(&mut out, format);
            out.push(b'\n');
        }
        if fixed {
            out.extend_from_slice(b"FIX");
            push_id(&mut out, id);
            out.push(b'\n');
        }
    }
    // Most files repeat one matrix: its text is kept.
    let mut known: Option<SMatrix<f64, D, D>> = None;
    let mut entries = Vec::new();
    for factor in &graph.factors {
        let ends = (graph.ids.get(factor.from), graph.ids.get(factor.to));
        let (Some(&from), Some(&to)) = ends else { continue };
        out.extend_from_slice(edge.as_bytes());
        push_id(&mut out, from);
        push_id(&mut out, to);
        factor.from_from_to.push(&mut out, format);
        let (information, order) =
            P::information(&factor.information, &factor.from_from_to, format);
        let same = known.is_some_and(|known| {
            known.iter().zip(&information).all(|(a, b)| a.to_bits() == b.to_bits())
        });
        if !same {
            entries.clear();
            for &(row, column) in order {
                entries.push(b' ');
                push_number(&mut entries, information[(row, column)]);
            }
            known = Some(information);
        }
        out.extend_from_slice(&entries);
        out.push(b'\n');
    }
    out
}
