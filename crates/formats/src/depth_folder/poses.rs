//! Poses and cameras as such folders write them.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use pose::Se3;
use sensing::Camera;

use crate::FormatError;
use crate::binary::refuse_binary;
use crate::lines::with_line_feeds;
use crate::pose_graph::Lexer;

/// How far the columns of a rotation may be from unit length and square to each other.
const SQUARE: f64 = 1e-2;

/// The numbers of a file, line by line.
fn rows(bytes: &[u8], expected: &str) -> Result<Vec<Vec<f64>>, FormatError> {
    refuse_binary(bytes, expected)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut rows = Vec::new();
    while lexer.next_line() {
        let mut row = Vec::new();
        while !lexer.at_end_of_line() {
            row.push(lexer.any_float(expected)?);
        }
        rows.push(row);
    }
    Ok(rows)
}

/// A pose as a matrix of 4 by 4; `None` where its numbers are not those of a pose.
pub(super) fn matrix(bytes: &[u8]) -> Result<Option<Se3>, FormatError> {
    const EXPECTED: &str = "a pose, 4 lines of 4 numbers";
    let rows = rows(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    if rows.len() != 4 || rows.iter().any(|row| row.len() != 4) {
        return Err(Lexer::new(&bytes).unexpected(EXPECTED));
    }
    let rotation = Matrix3::from_fn(|row, column| rows[row][column]);
    let translation = Vector3::from_fn(|row, _| rows[row][3]);
    let is_square = (rotation.transpose() * rotation - Matrix3::identity()).amax() <= SQUARE
        && rotation.determinant() > 0.0;
    if !is_square || translation.iter().any(|x| !x.is_finite()) {
        return Ok(None);
    }
    // Files round: the nearest rotation.
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(&rotation));
    Ok(Some(Se3::new(translation, rotation)))
}

/// Poses, one in a line: `tx ty tz qx qy qz qw`, with or without a number or a time before; `None` for a
/// line whose numbers are not those of a pose.
pub(super) fn lines(bytes: &[u8]) -> Result<Vec<Option<Se3>>, FormatError> {
    const EXPECTED: &str = "a pose `tx ty tz qx qy qz qw`, with or without a time before";
    refuse_binary(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut poses = Vec::new();
    while lexer.next_line() {
        let mut row = Vec::new();
        while !lexer.at_end_of_line() {
            row.push(lexer.any_float(EXPECTED)?);
        }
        let row = match row.len() {
            7 => &row[..],
            8 => &row[1..],
            _ => return Err(lexer.unexpected(EXPECTED)),
        };
        let rotation = nalgebra::Quaternion::new(row[6], row[3], row[4], row[5]);
        let translation = Vector3::new(row[0], row[1], row[2]);
        let good =
            translation.iter().all(|x| x.is_finite()) && (rotation.norm() - 1.0).abs() <= SQUARE;
        let pose = || Se3::new(translation, UnitQuaternion::new_normalize(rotation));
        poses.push(good.then(pose));
    }
    Ok(poses)
}

/// A camera as a matrix of 3 by 3.
pub(super) fn camera(bytes: &[u8]) -> Result<Camera, FormatError> {
    const EXPECTED: &str = "a camera, 3 lines of 3 numbers: fx 0 cx, 0 fy cy, 0 0 1";
    let rows = rows(bytes, EXPECTED)?;
    let good = rows.len() == 3 && rows.iter().all(|row| row.len() == 3);
    let camera = good.then(|| Camera::new(rows[0][0], rows[1][1], rows[0][2], rows[1][2]));
    let bytes = with_line_feeds(bytes);
    camera.filter(Camera::is_usable).ok_or_else(|| Lexer::new(&bytes).unexpected(EXPECTED))
}

/// Files and their times: `time name` in each line.
pub(super) fn timed_files(bytes: &[u8]) -> Result<Vec<(f64, String)>, FormatError> {
    const EXPECTED: &str = "a time and a file in each line";
    refuse_binary(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut files = Vec::new();
    while lexer.next_line() {
        let [time] = lexer.floats(EXPECTED)?;
        lexer.at_end_of_line();
        let name = String::from_utf8_lossy(lexer.word()).into_owned();
        if name.is_empty() {
            return Err(lexer.unexpected(EXPECTED));
        }
        files.push((time, name));
    }
    Ok(files)
}
