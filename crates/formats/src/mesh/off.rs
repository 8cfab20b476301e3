//! OFF: counts, vertices, polygons.

use std::io::Write;

use solid::{Label, Polyhedron};

use super::build::Builder;
use super::{MeshFile, MeshFormat, colour};
use crate::FormatError;
use crate::lexer::Lexer;
use crate::pose_graph::push_number;

/// The first words of OFF and its kin: what comes after the coordinates of a vertex is passed over.
pub(super) const MAGIC: [&[u8]; 7] =
    [b"OFF", b"COFF", b"NOFF", b"CNOFF", b"STOFF", b"STCOFF", b"STCNOFF"];

/// Reads text; the binary kind is refused.
pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let mut lexer = Lexer::new(bytes);
    if !lexer.next_line() {
        return Err(lexer.unexpected("`OFF`"));
    }
    let mark = lexer.mark();
    if !MAGIC.contains(&lexer.word()) {
        let at = lexer.position_of(mark);
        return Err(FormatError::unexpected(at, "another word", "`OFF`"));
    }
    if lexer.at_end_of_line() && !lexer.next_line() {
        return Err(lexer.unexpected("the counts of vertices, faces and edges"));
    }
    let vertices = lexer.id("the number of vertices")?;
    let polygons = lexer.id("the number of faces")?;
    let mut builder = Builder::default();
    for index in 0..vertices {
        if !lexer.next_line() {
            return Err(lexer.unexpected(&format!("vertex {index} of {vertices}")));
        }
        let mark = lexer.mark();
        let xyz = lexer.floats::<3>("x, y, z")?;
        builder.vertex(xyz, || lexer.position_of(mark))?;
    }
    let mut colours = Vec::new();
    let mut corners = Vec::new();
    let mut faces: Vec<(Vec<u32>, crate::error::Position)> = Vec::new();
    for index in 0..polygons {
        if !lexer.next_line() {
            return Err(lexer.unexpected(&format!("face {index} of {polygons}")));
        }
        let mark = lexer.mark();
        let count = lexer.id("the number of corners")?;
        corners.clear();
        for _ in 0..count {
            lexer.at_end_of_line();
            let mark = lexer.mark();
            let corner = lexer.id("a corner")? as f64;
            corners.push(builder.known(corner, || lexer.position_of(mark))?);
        }
        colours.push(face_label(&mut lexer));
        faces.push((corners.clone(), lexer.position_of(mark)));
    }
    // Colours mean labels only where every face has one of ours.
    let labels: Option<Vec<Label>> = colours.into_iter().collect();
    let labelled = labels.as_ref().is_some_and(|labels| !labels.is_empty());
    for (index, (corners, at)) in faces.into_iter().enumerate() {
        let label = labels.as_ref().map_or(Label::Obstacle, |labels| labels[index]);
        builder.polygon(&corners, label, || at)?;
    }
    let end = lexer.position_of(lexer.mark());
    builder.finish(MeshFormat::Off, labelled, end)
}

/// The label whose colour stands at the end of a face's line.
fn face_label(lexer: &mut Lexer<'_>) -> Option<Label> {
    let rgb = lexer.floats::<3>("red, green, blue").ok()?;
    Label::ALL.into_iter().find(|&label| colour(label).map(f64::from) == rgb)
}

/// Writes text with a colour for each face; what is written reads back equal, but for origins.
pub fn write(mesh: &Polyhedron) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * (mesh.vertices().len() + mesh.faces().len()));
    // A vector takes whatever is written to it.
    let _ = writeln!(out, "OFF\n{} {} 0", mesh.vertices().len(), mesh.faces().len());
    for vertex in mesh.vertices() {
        push_point(&mut out, vertex);
        out.push(b'\n');
    }
    for ([a, b, c], &label) in mesh.faces().iter().zip(mesh.labels()) {
        let [red, green, blue] = colour(label);
        let _ = writeln!(out, "3 {a} {b} {c} {red} {green} {blue}");
    }
    out
}

/// Writes three numbers that read back equal, bit for bit.
pub(super) fn push_point(out: &mut Vec<u8>, point: &solid::Point3) {
    for (axis, &number) in point.iter().enumerate() {
        if axis > 0 {
            out.push(b' ');
        }
        push_number(out, number);
    }
}
