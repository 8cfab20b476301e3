//! Pose graphs of g2o and TORO files, read alike: the tag of each line says what it is.
//!
//! # What the lines mean
//!
//! | line | numbers |
//! |---|---|
//! | `VERTEX_SE2 id` | `x y theta` |
//! | `VERTEX_SE3:QUAT id` | `x y z qx qy qz qw` |
//! | `EDGE_SE2 from to` | `x y theta`, `I11 I12 I13 I22 I23 I33` |
//! | `EDGE_SE3:QUAT from to` | `x y z qx qy qz qw`, the 21 entries of the upper triangle, row by row |
//! | `FIX id...` | vertices that are held where they are |
//! | `VERTEX2 id` (also `VERTEX`) | `x y theta` |
//! | `VERTEX3 id` | `x y z roll pitch yaw`, the rotation `Rz(yaw) Ry(pitch) Rx(roll)` |
//! | `EDGE2 from to` (also `EDGE`, `ODOMETRY`) | `x y theta`, `I11 I12 I22 I33 I13 I23` |
//! | `EDGE3 from to` | `x y z roll pitch yaw`, the 21 entries of the upper triangle, row by row |
//!
//! A pose is `map_from_body`, a measurement `from_from_to`; metres and radians.
//!
//! # The information matrix
//!
//! With `Z` measured and `R` its rotation, g2o weighs the error `Z⁻¹ Xi⁻¹ Xj`: its translation is
//! seen after the measured motion, and in space its rotation is the vector part of a quaternion,
//! about half the angle. TORO weighs the translation `Ri⊤ (tj - ti) - t` as the first pose sees it,
//! and the rotation per radian. Both are the same quadratic form where
//!
//! ```text
//! plane   I_g2o = diag(R, 1)⊤ I_toro diag(R, 1)
//! space   I_g2o = diag(R, 1)⊤ (S I_toro S) diag(R, 1),   S = diag(1, 1, 1, 2, 2, 2)
//! ```
//!
//! The graph holds `I_g2o`, whatever it was read from; writing TORO turns it back. TORO's own
//! optimiser takes the translation in space in the frame of the map, where no information matrix can
//! be right for more than one pose; it is taken here as in the plane. Files whose blocks are
//! multiples of the identity, which nearly all are, say the same either way.
//!
//! # What is put right, and what is not
//!
//! A number that cannot be read ends the reading with line and column. Everything else that is
//! strange is kept or left out as [`WarningKind`] says, and is told in the [`GraphFileReport`]:
//! a user wants the answer for a graph of ten thousand edges even if one of them is odd.

mod assemble;
mod bits;
mod file;
mod read;
mod records;
mod report;
mod tags;
mod write;

pub use file::{AnyGraph, GraphFile};
pub use read::read;
pub use report::{GraphFileReport, GraphWarning, NORM_TOLERANCE, UnknownTag, WarningKind};
pub use tags::GraphFormat;
pub use write::{write, write_plane, write_space};

pub(crate) use crate::lexer::Lexer;
pub(crate) use bits::push_number;
pub(crate) use read::first_tag;
pub(crate) use records::quaternion;
