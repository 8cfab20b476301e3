//! The labelled polyhedron.
//!
//! | file | what it holds |
//! |---|---|
//! | `label.rs` | what a face is: obstacle or frontier; where it came from |
//! | `polyhedron.rs` | vertices, faces, labels, origins; checked when made |
//! | `measure.rs` | volume, area by label, bounds |
//! | `double.rs` | numbers of twice the digits, for volumes that cancel |
//! | `shapes.rs` | boxes and tetrahedra |
//! | `facet.rs` | plane polygons, with holes, cut into triangles |
//! | `weld.rs` | vertices at one place made one |

mod double;
mod facet;
mod label;
mod measure;
mod polyhedron;
mod shapes;
mod weld;

pub use facet::triangulate_facet;
pub use label::{Label, Origin};
pub use measure::AreaByLabel;
pub use polyhedron::{Face, Polyhedron};
pub use weld::{Welded, position_classes, weld};
