//! OBJ: lines that start with what they hold.

use std::io::Write;

use solid::{Label, Polyhedron};

use super::build::Builder;
use super::off::push_point;
use super::{MeshFile, MeshFormat};
use crate::FormatError;
use crate::error::{Position, quote};
use crate::lexer::Lexer;

/// Words that lines start with. A file with none of them is no OBJ; one with an `o` alone is an empty mesh.
const KNOWN: [&[u8]; 13] = [
    b"v", b"vt", b"vn", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"usemtl", b"mtllib", b"cstype",
];

/// A polygon whose corners may be read before the vertices that they name.
struct Waiting {
    corners: Vec<(i64, Position)>,
    /// How many vertices stood before it: relative indices count back from there.
    before: usize,
    label: Label,
    at: Position,
}

/// Reads `v` and `f`; materials named `obstacle` and `frontier` label what follows.
pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let mut lexer = Lexer::new(bytes);
    let mut builder = Builder::default();
    let mut waiting: Vec<Waiting> = Vec::new();
    let (mut label, mut labelled) = (Label::Obstacle, false);
    let mut known = false;
    while lexer.next_line() {
        let at = lexer.position_of(lexer.mark());
        let word = lexer.word();
        known |= KNOWN.contains(&word);
        match word {
            b"v" => {
                let xyz = lexer.floats::<3>("x, y, z")?;
                builder.vertex(xyz, || at)?;
            }
            b"f" => {
                let mut corners = Vec::new();
                while !lexer.at_end_of_line() {
                    corners.push(corner(&mut lexer)?);
                }
                waiting.push(Waiting { corners, before: builder.vertices.len(), label, at });
            }
            b"usemtl" => {
                let name = lexer.word();
                let named = Label::ALL.into_iter().find(|label| label.name().as_bytes() == name);
                labelled |= named.is_some();
                label = named.unwrap_or(Label::Obstacle);
            }
            // Normals, textures, groups, lines and whatever else: not the surface.
            _ => {}
        }
    }
    if !known {
        let at = lexer.position_of(lexer.mark());
        let found = "the end of the file and no line of an OBJ";
        return Err(FormatError::unexpected(
            at,
            found,
            "`v`, `f`, `o`, `g` or another of its words",
        ));
    }
    let mut resolved = Vec::new();
    for Waiting { corners, before, label, at } in waiting {
        resolved.clear();
        for (index, at) in corners {
            let from_zero =
                if index < 0 { before as f64 + index as f64 } else { index as f64 - 1.0 };
            let count = builder.vertices.len();
            let known = builder.known(from_zero, || at).map_err(|_| {
                let expected = format!("one of the {count} vertices, from 1 or from -1 back");
                FormatError::unexpected(at, format!("vertex {index}"), expected)
            })?;
            resolved.push(known);
        }
        builder.polygon(&resolved, label, || at)?;
    }
    let end = lexer.position_of(lexer.mark());
    builder.finish(MeshFormat::Obj, labelled, end)
}

/// The first number of a corner such as `3`, `3/1` or `3//2`.
fn corner(lexer: &mut Lexer<'_>) -> Result<(i64, Position), FormatError> {
    let at = lexer.position_of(lexer.mark());
    let word = lexer.word();
    let number = word.split(|&byte| byte == b'/').next().unwrap_or_default();
    let number = std::str::from_utf8(number).ok().and_then(|text| text.parse().ok());
    match number.filter(|&index: &i64| index != 0) {
        Some(index) => Ok((index, at)),
        None => {
            let found = quote(&String::from_utf8_lossy(word));
            Err(FormatError::unexpected(at, found, "the number of a vertex, not 0"))
        }
    }
}

/// Writes text, faces in order, with a material where the label changes; a mesh without vertices as an object
/// without any.
pub fn write(mesh: &Polyhedron) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * (mesh.vertices().len() + mesh.faces().len()));
    if mesh.vertices().is_empty() {
        out.extend(b"o empty\n");
    }
    for vertex in mesh.vertices() {
        out.extend(b"v ");
        push_point(&mut out, vertex);
        out.push(b'\n');
    }
    let mut last = None;
    for (face, &label) in mesh.faces().iter().zip(mesh.labels()) {
        // A vector takes whatever is written to it.
        if last != Some(label) {
            let _ = writeln!(out, "usemtl {label}");
            last = Some(label);
        }
        let [a, b, c] = face.map(|vertex| vertex + 1);
        let _ = writeln!(out, "f {a} {b} {c}");
    }
    out
}
