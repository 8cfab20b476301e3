//! Meshes of polygons to labelled polyhedra and back; tetrahedra to files.
//!
//! | file | reads | writes | labels |
//! |---|---|---|---|
//! | `ply.rs` | ascii, binary of either byte order | ascii, binary | face properties `label`, `origin_view`, `origin_face`; colours |
//! | `obj.rs` | `v`, `f`, also with relative indices | yes | materials `obstacle` and `frontier` |
//! | `stl.rs` | text, bytes | bytes | none |
//! | `off.rs` | `OFF`, and its kin with colours or normals | yes | colours of faces |
//! | `plc.rs` | `.node`, `.poly`, `.smesh` | | none |
//! | `tetrahedra.rs` | | legacy VTK, MEDIT `.mesh` | on boundary faces |
//!
//! Polygons are cut into triangles, concave ones too ([`solid::mesh::triangulate_facet`]);
//! [`MeshFile::facet_of`] tells from which polygon of the file a triangle is. What the file does not
//! label is obstacle. A polygon that names a vertex twice in a row loses one of them, and is left out
//! when fewer than three are left; how many were is told.
//!
//! A mesh without faces is one whose file says so: by counts of 0 (PLY, OFF, STL in bytes), by `endsolid` (STL in
//! text), by lines of an OBJ none of which is a face. A file that says nothing, or nothing known, is refused.

mod build;
mod obj;
mod off;
mod plc;
mod ply;
mod read;
mod stl;
mod tetrahedra;

pub use obj::write as write_obj;
pub use off::write as write_off;
pub use plc::{PlcKind, read as read_plc};
pub use ply::{write as write_ply, write_ascii as write_ply_ascii};
pub use read::{MeshFile, MeshFormat, read};
pub use stl::write as write_stl;
pub use tetrahedra::{TetrahedraFile, write_medit, write_vtk};

use solid::Label;

/// The colour that stands for a label in files: red, green, blue.
pub const fn colour(label: Label) -> [u8; 3] {
    match label {
        Label::Obstacle => [150, 150, 160],
        Label::Frontier => [240, 140, 40],
    }
}
