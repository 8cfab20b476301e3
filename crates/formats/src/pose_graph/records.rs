//! The numbers of one line: poses and information matrices, per dialect and dimension.
//!
//! What the dialects mean, and how TORO's information becomes g2o's, stands in the page of the
//! module [`pose_graph`](super).

use nalgebra::{Matrix2, Matrix3, Quaternion, SMatrix, UnitQuaternion, Vector3, Vector6};
use pose::{Se2, Se3, wrap_angle};
use posegraph::Manifold;

use super::report::NORM_TOLERANCE;
use super::tags::GraphFormat;
use crate::FormatError;
use crate::lexer::Lexer;

/// A pose as a line gives it, and the norm of its quaternion where that was put right.
pub(super) type Read<P> = (P, Option<f64>);

/// What the reader has to know about a dimension.
pub(super) trait Record<const D: usize>: Manifold<D> {
    /// How many dimensions the space has.
    const DIMENSIONS: u8;
    /// Reads the pose of a vertex or an edge.
    fn read(lexer: &mut Lexer<'_>, format: GraphFormat) -> Result<Read<Self>, FormatError>;
    /// Reads the information of an edge, in g2o's meaning.
    fn read_information(
        lexer: &mut Lexer<'_>,
        format: GraphFormat,
        measured: &Self,
    ) -> Result<SMatrix<f64, D, D>, FormatError>;
}

impl Record<3> for Se2 {
    const DIMENSIONS: u8 = 2;

    fn read(lexer: &mut Lexer<'_>, _: GraphFormat) -> Result<Read<Self>, FormatError> {
        let [x, y, theta] = lexer.floats("a pose x y theta")?;
        // Wrapped first: an angle within a half-turn can be written so that it reads back the same.
        Ok((Se2::new(x, y, wrap_angle(theta)), None))
    }

    fn read_information(
        lexer: &mut Lexer<'_>,
        format: GraphFormat,
        measured: &Self,
    ) -> Result<Matrix3<f64>, FormatError> {
        Ok(match format {
            GraphFormat::G2o => {
                let [xx, xy, xt, yy, yt, tt] =
                    lexer.floats("an information matrix I11 I12 I13 I22 I23 I33")?;
                Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt)
            }
            GraphFormat::Toro => {
                let [xx, xy, yy, tt, xt, yt] =
                    lexer.floats("an information matrix I11 I12 I22 I33 I13 I23")?;
                let information = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
                turned(&information, &measured.rotation.to_rotation_matrix().into_inner())
            }
        })
    }
}

impl Record<6> for Se3 {
    const DIMENSIONS: u8 = 3;

    fn read(lexer: &mut Lexer<'_>, format: GraphFormat) -> Result<Read<Self>, FormatError> {
        match format {
            GraphFormat::G2o => {
                let [x, y, z] = lexer.floats("a pose x y z qx qy qz qw")?;
                let (rotation, norm) = quaternion(lexer)?;
                Ok((Se3::new(Vector3::new(x, y, z), rotation), norm))
            }
            GraphFormat::Toro => {
                let [x, y, z, roll, pitch, yaw] = lexer.floats("a pose x y z roll pitch yaw")?;
                let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
                Ok((Se3::new(Vector3::new(x, y, z), rotation), None))
            }
        }
    }

    fn read_information(
        lexer: &mut Lexer<'_>,
        format: GraphFormat,
        measured: &Self,
    ) -> Result<SMatrix<f64, 6, 6>, FormatError> {
        let upper: [f64; 21] =
            lexer.floats("an information matrix, its upper triangle row by row")?;
        let mut information = SMatrix::<f64, 6, 6>::zeros();
        let mut entries = upper.into_iter();
        for row in 0..6 {
            for (column, entry) in (row..6).zip(&mut entries) {
                information[(row, column)] = entry;
                information[(column, row)] = entry;
            }
        }
        Ok(match format {
            GraphFormat::G2o => information,
            GraphFormat::Toro => {
                let angles = Vector6::new(1.0, 1.0, 1.0, 2.0, 2.0, 2.0);
                let scaled = information.component_mul(&(angles * angles.transpose()));
                turned(&scaled, &measured.rotation_matrix())
            }
        })
    }
}

/// Reads `qx qy qz qw`; tells the norm where it was worth a warning.
///
/// A quaternion whose norm is 1 up to rounding keeps its bits, so that what was written reads back
/// the same.
pub(crate) fn quaternion(
    lexer: &mut Lexer<'_>,
) -> Result<(UnitQuaternion<f64>, Option<f64>), FormatError> {
    const ROUNDING: f64 = 1e-14;
    lexer.at_end_of_line();
    let at = lexer.mark();
    let [x, y, z, w] = lexer.floats("a quaternion qx qy qz qw")?;
    let quaternion = Quaternion::new(w, x, y, z);
    let squared = quaternion.norm_squared();
    if (squared - 1.0).abs() <= ROUNDING {
        return Ok((UnitQuaternion::new_unchecked(quaternion), None));
    }
    // Scaled by the largest part first, so that no square overflows or vanishes.
    let largest = quaternion.coords.amax();
    if largest < f64::MIN_POSITIVE {
        let found = format!("a quaternion {x} {y} {z} {w}");
        return Err(FormatError::unexpected(lexer.position_of(at), found, "one of norm 1"));
    }
    let norm = squared.sqrt();
    let unit = UnitQuaternion::new_normalize(Quaternion::from(quaternion.coords / largest));
    Ok((unit, ((norm - 1.0).abs() > NORM_TOLERANCE).then_some(norm)))
}

/// The information with its translation block turned by `from_from_to` transposed: from the frame
/// of the edge's first pose into the one after the measured motion, `Rᵀ I R`.
fn turned<const D: usize, const T: usize>(
    information: &SMatrix<f64, D, D>,
    rotation: &SMatrix<f64, T, T>,
) -> SMatrix<f64, D, D> {
    let mut change = SMatrix::<f64, D, D>::identity();
    change.fixed_view_mut::<T, T>(0, 0).copy_from(rotation);
    let mut turned = change.transpose() * information * change;
    turned.fill_lower_triangle_with_upper_triangle();
    turned
}

/// TORO's information of an edge, from g2o's: the inverse of what reading does.
pub(super) fn toro_information2(information: &Matrix3<f64>, measured: &Se2) -> Matrix3<f64> {
    let rotation: Matrix2<f64> = measured.rotation.to_rotation_matrix().into_inner();
    turned(information, &rotation.transpose())
}

/// TORO's information of an edge, from g2o's: the inverse of what reading does.
pub(super) fn toro_information3(
    information: &SMatrix<f64, 6, 6>,
    measured: &Se3,
) -> SMatrix<f64, 6, 6> {
    let angles = Vector6::new(1.0, 1.0, 1.0, 0.5, 0.5, 0.5);
    let scaled = information.component_mul(&(angles * angles.transpose()));
    turned(&scaled, &measured.rotation_matrix().transpose())
}
