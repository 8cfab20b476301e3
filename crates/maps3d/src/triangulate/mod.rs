//! Triangulations of the image, and what their faces are.
//!
//! | file | what it holds |
//! |---|---|
//! | `mesh.rs` | pixels, depths and triangles: any triangulation of the image, lifted or not |
//! | `planar.rs` | the proof that triangles on whole pixels are a planar triangulation |
//! | `grid.rs` | the triangulation of all pixels (\[Mos15\] 3.4) |
//! | `frontier.rs` | which squares of the image hold frontier: missing data, depth gaps (\[Mos15\] 5.7.1) |
//! | `label.rs` | obstacle or frontier for the faces of any triangulation |
//! | `rows.rs` | the pixels of a triangle, row by row |

mod frontier;
mod grid;
mod label;
mod mesh;
mod planar;
mod rows;

pub use frontier::{FrontierSquares, Occlusion};
pub use grid::{grid, grid_faces};
pub use label::label;
pub use mesh::{ImageMesh, orient};
pub use planar::check_planar;
pub(crate) use rows::{Span, rows_of};
