//! STL: triangles, each with its own three corners.

use solid::{Label, Polyhedron};

use super::build::Builder;
use super::{MeshFile, MeshFormat};
use crate::FormatError;
use crate::error::{Position, quote};
use crate::lexer::Lexer;

/// Bytes of the head, and of one triangle.
const HEAD: usize = 84;
const RECORD: usize = 50;

fn count(bytes: &[u8]) -> Option<usize> {
    let count: [u8; 4] = bytes.get(80..HEAD)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

/// Whether the count in the head fits the length: text that starts with `solid` may be bytes.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    count(bytes)
        .and_then(|count| count.checked_mul(RECORD)?.checked_add(HEAD))
        .is_some_and(|length| length == bytes.len())
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let starts_as_text = bytes.trim_ascii_start().starts_with(b"solid");
    if is_binary(bytes) || !starts_as_text { read_binary(bytes) } else { read_text(bytes) }
}

fn read_binary(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let Some(count) = count(bytes) else {
        let found = format!("{} bytes", bytes.len());
        let expected = format!("a head of {HEAD} bytes, or `solid`");
        return Err(FormatError::unexpected(Position::Byte(0), found, expected));
    };
    let left = bytes.len() - HEAD;
    if count.checked_mul(RECORD).is_none_or(|needed| needed > left) {
        let found = format!("{count} triangles and {left} bytes");
        let expected = format!("{RECORD} bytes for each triangle");
        return Err(FormatError::unexpected(Position::Byte(80), found, expected));
    }
    let mut builder = Builder::default();
    for (index, record) in bytes[HEAD..].chunks_exact(RECORD).take(count).enumerate() {
        for corner in 0..3 {
            let offset = 12 + 12 * corner;
            let at = || Position::Byte(HEAD + RECORD * index + offset);
            let number = |axis: usize| {
                let start = offset + 4 * axis;
                let raw: [u8; 4] = [0, 1, 2, 3].map(|i| record[start + i]);
                f64::from(f32::from_le_bytes(raw))
            };
            builder.vertex([number(0), number(1), number(2)], at)?;
        }
        let first = 3 * index as u32;
        let at = || Position::Byte(HEAD + RECORD * index);
        builder.polygon(&[first, first + 1, first + 2], Label::Obstacle, at)?;
    }
    builder.finish(MeshFormat::Stl, false, Position::Byte(bytes.len()))
}

fn read_text(bytes: &[u8]) -> Result<MeshFile, FormatError> {
    let mut lexer = Lexer::new(bytes);
    let mut builder = Builder::default();
    let mut open: Vec<u32> = Vec::new();
    let mut ended = false;
    while lexer.next_line() {
        let at = lexer.position_of(lexer.mark());
        match lexer.word() {
            b"vertex" => {
                let xyz = lexer.floats::<3>("x, y, z")?;
                open.push(builder.vertices.len() as u32);
                builder.vertex(xyz, || at)?;
            }
            b"endloop" => {
                if open.len() != 3 {
                    let found = format!("a loop of {} vertices", open.len());
                    return Err(FormatError::unexpected(at, found, "three"));
                }
                builder.polygon(&open, Label::Obstacle, || at)?;
                open.clear();
            }
            b"endsolid" => ended = true,
            b"solid" | b"facet" | b"outer" | b"endfacet" => {}
            other => {
                let found = quote(&String::from_utf8_lossy(other));
                return Err(FormatError::unexpected(at, found, "a line of an STL text"));
            }
        }
    }
    let end = lexer.position_of(lexer.mark());
    if !open.is_empty() {
        return Err(FormatError::unexpected(end, "the end of the file", "`endloop`"));
    }
    // No facet is a mesh only where the file says that this was all.
    if builder.vertices.is_empty() && !ended {
        return Err(FormatError::unexpected(end, "the end of the file", "`facet` or `endsolid`"));
    }
    builder.finish(MeshFormat::Stl, false, end)
}

/// Writes bytes; coordinates become 32-bit floats, labels are lost.
pub fn write(mesh: &Polyhedron) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEAD + RECORD * mesh.faces().len());
    // Not `solid`: readers take that for text.
    out.extend(b"mesh written by driftlab");
    out.resize(80, 0);
    out.extend((mesh.faces().len() as u32).to_le_bytes());
    for face in 0..mesh.faces().len() {
        let normal = mesh.scaled_normal(face).try_normalize(0.0).unwrap_or_default();
        let corners = mesh.corners(face).map(|corner| corner.coords);
        for number in normal.iter().chain(corners.iter().flatten()) {
            out.extend((*number as f32).to_le_bytes());
        }
        out.extend([0, 0]);
    }
    out
}
