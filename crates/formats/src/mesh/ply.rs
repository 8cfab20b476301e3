//! Meshes in PLY files.

use std::io::Write;

use solid::{Label, Origin, Polyhedron};

use super::build::Builder;
use super::off::push_point;
use super::{MeshFile, MeshFormat, colour};
use crate::FormatError;
use crate::error::Position;
use crate::ply::{self, Element};

fn missing(what: &str) -> FormatError {
    let at = Position::Line { line: 1, column: 1 };
    FormatError::unexpected(at, format!("a header without {what}"), what)
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let file = ply::read(bytes)?;
    let vertex = file.element("vertex").ok_or_else(|| missing("an element `vertex`"))?;
    let mut builder = Builder::default();
    let column = |name| vertex.column(name).ok_or_else(|| missing("properties x, y and z"));
    let [x, y, z] = [column("x")?, column("y")?, column("z")?];
    for index in 0..vertex.count {
        let number = |values: &[f64]| values.first().copied().unwrap_or(f64::NAN);
        let xyz = [x, y, z].map(|axis| number(axis.row(index)));
        builder.vertex(xyz, || vertex.position(index))?;
    }
    let face = file.element("face").ok_or_else(|| missing("an element `face`"))?;
    let corners = face.column("vertex_indices").or_else(|| face.column("vertex_index"));
    let corners = match corners {
        Some(corners) => corners,
        None if face.count == 0 => {
            return builder.finish(MeshFormat::Ply, false, Position::Byte(bytes.len()));
        }
        None => return Err(missing("a property `vertex_indices` of faces")),
    };
    let labels = face.column("label");
    let origins = face.column("origin_view").zip(face.column("origin_face"));
    for index in 0..face.count {
        let at = || face.position(index);
        let known = corners.row(index).iter().map(|&corner| builder.known(corner, at));
        let known = known.collect::<Result<Vec<u32>, _>>()?;
        let label = match labels {
            Some(column) => label(column.row(index), face, index)?,
            None => Label::Obstacle,
        };
        let origin = origins.map(|(view, of)| {
            let number = |values: &[f64]| values.first().map_or(0, |&value| value as u32);
            Origin { view: number(view.row(index)), face: number(of.row(index)) }
        });
        builder.facet(&[known], &[], label, origin, at)?;
    }
    builder.finish(MeshFormat::Ply, labels.is_some(), Position::Byte(bytes.len()))
}

fn label(values: &[f64], face: &Element, index: usize) -> Result<Label, FormatError> {
    let label = match values {
        [code] if *code == 0.0 => Some(Label::Obstacle),
        [code] if *code == 1.0 => Some(Label::Frontier),
        _ => None,
    };
    label.ok_or_else(|| {
        let found = format!("label {values:?} of face {index}");
        FormatError::unexpected(face.position(index), found, "0 (obstacle) or 1 (frontier)")
    })
}

fn header(mesh: &Polyhedron, encoding: &str) -> Vec<u8> {
    let mut out = Vec::new();
    let origins = match mesh.origins() {
        Some(_) => "property uint origin_view\nproperty uint origin_face\n",
        None => "",
    };
    // A vector takes whatever is written to it.
    let _ = write!(
        out,
        "ply\nformat {encoding} 1.0\ncomment label: 0 obstacle, 1 frontier\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nproperty uchar label\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n{origins}end_header\n",
        mesh.vertices().len(),
        mesh.faces().len()
    );
    out
}

/// Writes bytes, the least significant first; what is written reads back equal, bit for bit.
pub fn write(mesh: &Polyhedron) -> Vec<u8> {
    let mut out = header(mesh, "binary_little_endian");
    out.reserve(24 * mesh.vertices().len() + 25 * mesh.faces().len());
    out.extend(
        mesh.vertices()
            .iter()
            .flat_map(|v| v.coords.into_iter().copied())
            .flat_map(f64::to_le_bytes),
    );
    for (index, (face, &label)) in mesh.faces().iter().zip(mesh.labels()).enumerate() {
        out.push(3);
        out.extend(face.iter().flat_map(|vertex| vertex.to_le_bytes()));
        out.push(label.code());
        out.extend(colour(label));
        if let Some(Origin { view, face }) = mesh.origins().map(|origins| origins[index]) {
            out.extend([view, face].into_iter().flat_map(u32::to_le_bytes));
        }
    }
    out
}

/// Writes text; what is written reads back equal, bit for bit.
pub fn write_ascii(mesh: &Polyhedron) -> Vec<u8> {
    let mut out = header(mesh, "ascii");
    for vertex in mesh.vertices() {
        push_point(&mut out, vertex);
        out.push(b'\n');
    }
    for (index, ([a, b, c], &label)) in mesh.faces().iter().zip(mesh.labels()).enumerate() {
        let [red, green, blue] = colour(label);
        let _ = write!(out, "3 {a} {b} {c} {} {red} {green} {blue}", label.code());
        if let Some(Origin { view, face }) = mesh.origins().map(|origins| origins[index]) {
            let _ = write!(out, " {view} {face}");
        }
        out.push(b'\n');
    }
    out
}
