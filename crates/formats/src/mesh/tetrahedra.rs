//! Tetrahedra with labelled boundary faces, as files that viewers of fields and meshes open.

use std::io::Write;

use solid::{Face, Label, Point3};

use super::off::push_point;

/// What is written: nothing is checked, indices count from 0.
#[derive(Clone, Copy, Debug)]
pub struct TetrahedraFile<'a> {
    /// The vertices, metres.
    pub vertices: &'a [Point3],
    /// Four vertices each, positively oriented.
    pub tetrahedra: &'a [[u32; 4]],
    /// Faces of the boundary.
    pub faces: &'a [Face],
    /// The label of each of them.
    pub labels: &'a [Label],
}

fn push_row(out: &mut Vec<u8>, count: Option<usize>, corners: &[u32], first: u32) {
    // A vector takes whatever is written to it.
    if let Some(count) = count {
        let _ = write!(out, "{count} ");
    }
    for (i, corner) in corners.iter().enumerate() {
        let _ = write!(out, "{}{}", if i == 0 { "" } else { " " }, corner + first);
    }
}

/// Writes legacy VTK text (`.vtk`): an unstructured grid of tetrahedra, then triangles, with the
/// cell datum `label`: -1 for tetrahedra, 0 for obstacle, 1 for frontier.
pub fn write_vtk(file: &TetrahedraFile<'_>) -> Vec<u8> {
    let mut out = Vec::new();
    let (tetrahedra, faces) = (file.tetrahedra.len(), file.faces.len());
    let _ = writeln!(
        out,
        "# vtk DataFile Version 3.0\ntetrahedra written by driftlab\nASCII\n\
         DATASET UNSTRUCTURED_GRID\nPOINTS {} double",
        file.vertices.len()
    );
    for vertex in file.vertices {
        push_point(&mut out, vertex);
        out.push(b'\n');
    }
    let _ = writeln!(out, "CELLS {} {}", tetrahedra + faces, 5 * tetrahedra + 4 * faces);
    for corners in file.tetrahedra {
        push_row(&mut out, Some(4), corners, 0);
        out.push(b'\n');
    }
    for corners in file.faces {
        push_row(&mut out, Some(3), corners, 0);
        out.push(b'\n');
    }
    let _ = writeln!(out, "CELL_TYPES {}", tetrahedra + faces);
    out.extend(b"10\n".repeat(tetrahedra));
    out.extend(b"5\n".repeat(faces));
    let _ = writeln!(
        out,
        "CELL_DATA {}\nSCALARS label int 1\nLOOKUP_TABLE default",
        tetrahedra + faces
    );
    out.extend(b"-1\n".repeat(tetrahedra));
    for label in file.labels {
        let _ = writeln!(out, "{}", label.code());
    }
    out
}

/// Writes MEDIT text (`.mesh`); the reference of a triangle is 1 for obstacle and 2 for frontier, that
/// of a tetrahedron 0.
pub fn write_medit(file: &TetrahedraFile<'_>) -> Vec<u8> {
    let mut out = Vec::new();
    let _ = writeln!(out, "MeshVersionFormatted 2\nDimension 3\nVertices\n{}", file.vertices.len());
    for vertex in file.vertices {
        push_point(&mut out, vertex);
        out.extend(b" 0\n");
    }
    let _ = writeln!(out, "Triangles\n{}", file.faces.len());
    for (corners, label) in file.faces.iter().zip(file.labels) {
        push_row(&mut out, None, corners, 1);
        let _ = writeln!(out, " {}", label.code() + 1);
    }
    let _ = writeln!(out, "Tetrahedra\n{}", file.tetrahedra.len());
    for corners in file.tetrahedra {
        push_row(&mut out, None, corners, 1);
        out.extend(b" 0\n");
    }
    out.extend(b"End\n");
    out
}
