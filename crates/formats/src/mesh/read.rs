//! Which reader fits, and what it gives.

use solid::{Point3, Polyhedron};

use super::{PlcKind, obj, off, plc, ply, stl};
use crate::FormatError;
use crate::error::Position;

/// Formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Stanford PLY.
    Ply,
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography: triangles without common vertices.
    Stl,
    /// Object file format of Geomview.
    Off,
    /// TetGen's complex of points and facets.
    Plc(PlcKind),
}

impl MeshFormat {
    /// The format's name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Plc(PlcKind::Node) => "node",
            Self::Plc(PlcKind::Poly) => "poly",
            Self::Plc(PlcKind::Smesh) => "smesh",
        }
    }
}

/// A mesh and what its file said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The format that was read.
    pub format: MeshFormat,
    /// The mesh; its vertices are those of the file, in order.
    pub mesh: Polyhedron,
    /// Whether the file labels its faces.
    pub labelled: bool,
    /// How many polygons or facets the file holds.
    pub polygons: usize,
    /// For each triangle the polygon or facet of the file from which it is, from 0.
    pub facet_of: Vec<u32>,
    /// Polygons that were left out because they have fewer than three different corners.
    pub left_out: usize,
    /// Points that say in which parts of space there is nothing (`.poly`, `.smesh`).
    pub hole_points: Vec<Point3>,
}

impl MeshFile {
    /// Whether triangles have no vertices in common until the mesh is welded.
    pub fn is_soup(&self) -> bool {
        self.format == MeshFormat::Stl
    }
}

fn starts_with_word(bytes: &[u8], words: &[&[u8]]) -> bool {
    let line = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let first = line.into_iter().find(|line| !line.is_empty() && !line.starts_with(b"#"));
    first.is_some_and(|line| {
        words.iter().any(|word| {
            line.strip_prefix(*word)
                .is_some_and(|rest| rest.first().is_none_or(|&byte| byte.is_ascii_whitespace()))
        })
    })
}

/// Tells the format of a mesh by content where it can be told, else by the extension (without dot).
fn sniff(bytes: &[u8], extension: Option<&str>) -> Option<MeshFormat> {
    let by_name = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("node") => Some(MeshFormat::Plc(PlcKind::Node)),
        Some("poly") => Some(MeshFormat::Plc(PlcKind::Poly)),
        Some("smesh") => Some(MeshFormat::Plc(PlcKind::Smesh)),
        Some("obj") => Some(MeshFormat::Obj),
        Some("stl") => Some(MeshFormat::Stl),
        Some("off") => Some(MeshFormat::Off),
        Some("ply") => Some(MeshFormat::Ply),
        _ => None,
    };
    if let Some(MeshFormat::Plc(_)) = by_name {
        return by_name;
    }
    if starts_with_word(bytes, &[b"ply"]) {
        return Some(MeshFormat::Ply);
    }
    if starts_with_word(bytes, &off::MAGIC) {
        return Some(MeshFormat::Off);
    }
    if stl::is_binary(bytes) || starts_with_word(bytes, &[b"solid"]) {
        return Some(MeshFormat::Stl);
    }
    if starts_with_word(bytes, &[b"v", b"vn", b"vt", b"o", b"g", b"mtllib", b"usemtl", b"s"]) {
        return Some(MeshFormat::Obj);
    }
    by_name
}

/// Reads a mesh; the extension (without dot) decides only where the content does not.
///
/// `nodes` are the bytes of the `.node` file that a `.poly` or `.smesh` without points of its own
/// belongs to.
///
/// # Errors
/// [`FormatError::Unexpected`] with the place in the file.
pub fn read(
    bytes: &[u8],
    extension: Option<&str>,
    nodes: Option<&[u8]>,
) -> Result<MeshFile, FormatError> {
    match sniff(bytes, extension) {
        Some(MeshFormat::Ply) => ply::read(bytes),
        Some(MeshFormat::Obj) => obj::read(bytes),
        Some(MeshFormat::Stl) => stl::read(bytes),
        Some(MeshFormat::Off) => off::read(bytes),
        Some(MeshFormat::Plc(kind)) => plc::read(bytes, kind, nodes),
        None => Err(FormatError::unexpected(
            Position::Byte(0),
            "an unknown format",
            "PLY, OBJ, STL, OFF, .node, .poly or .smesh",
        )),
    }
}
