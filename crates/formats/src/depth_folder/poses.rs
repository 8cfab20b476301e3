//! Poses and cameras as such folders write them.

use std::ops::RangeInclusive;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use pose::Se3;
use sensing::Camera;

use crate::FormatError;
use crate::binary::refuse_binary;
use crate::error::Position;
use crate::lines::with_line_feeds;
use crate::pose_graph::Lexer;

/// How far the columns of a rotation may be from unit length and square to each other.
const SQUARE: f64 = 1e-2;

/// The numbers of a file, line by line; each line has as many as are wanted. The last line may be cut: a log that
/// broke off ends so.
fn rows(
    bytes: &[u8],
    counts: RangeInclusive<usize>,
    expected: &str,
) -> Result<Vec<Vec<f64>>, FormatError> {
    refuse_binary(bytes, expected)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut rows = Vec::new();
    while lexer.next_line() {
        match row(&mut lexer, &counts, expected) {
            Ok(row) => rows.push(row),
            Err(_) if !rows.is_empty() && !lexer.next_line() => break,
            Err(error) => return Err(error),
        }
    }
    Ok(rows)
}

/// The numbers of the line at hand.
fn row(
    lexer: &mut Lexer<'_>,
    counts: &RangeInclusive<usize>,
    expected: &str,
) -> Result<Vec<f64>, FormatError> {
    let mut row = Vec::new();
    while !lexer.at_end_of_line() {
        row.push(lexer.any_float(expected)?);
    }
    if counts.contains(&row.len()) { Ok(row) } else { Err(lexer.unexpected(expected)) }
}

/// The numbers of a square matrix of a file, `size` by `size`.
fn square(bytes: &[u8], size: usize, expected: &str) -> Result<Vec<Vec<f64>>, FormatError> {
    let rows = rows(bytes, size..=size, expected)?;
    match rows.len() {
        found if found == size => Ok(rows),
        found => Err(FormatError::unexpected(
            Position::Line { line: found.max(1), column: 1 },
            format!("{found} lines of numbers"),
            expected,
        )),
    }
}

/// A pose as a matrix of 4 by 4; `None` where its numbers are not those of a pose.
pub(super) fn matrix(bytes: &[u8]) -> Result<Option<Se3>, FormatError> {
    let rows = square(bytes, 4, "a pose, 4 lines of 4 numbers")?;
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
    let rows = rows(bytes, 7..=8, EXPECTED)?;
    Ok(rows.iter().map(|row| pose(&row[row.len() - 7..])).collect())
}

/// Times with their poses, `time tx ty tz qx qy qz qw` in each line; `None` for a line whose numbers are not
/// those of a pose.
pub(super) fn timed(bytes: &[u8]) -> Result<Vec<(f64, Option<Se3>)>, FormatError> {
    let rows = rows(bytes, 8..=8, "a pose `time tx ty tz qx qy qz qw`")?;
    Ok(rows.iter().map(|row| (row[0], pose(&row[1..]).filter(|_| row[0].is_finite()))).collect())
}

/// The pose that seven numbers say, `tx ty tz qx qy qz qw`.
fn pose(row: &[f64]) -> Option<Se3> {
    let &[x, y, z, i, j, k, w] = row else { return None };
    let translation = Vector3::new(x, y, z);
    let rotation = nalgebra::Quaternion::new(w, i, j, k);
    let good = translation.iter().all(|x| x.is_finite()) && (rotation.norm() - 1.0).abs() <= SQUARE;
    good.then(|| Se3::new(translation, UnitQuaternion::new_normalize(rotation)))
}

/// A camera as a matrix of 3 by 3.
pub(super) fn camera(bytes: &[u8]) -> Result<Camera, FormatError> {
    const EXPECTED: &str = "a camera, 3 lines of 3 numbers: fx 0 cx, 0 fy cy, 0 0 1";
    let rows = square(bytes, 3, EXPECTED)?;
    let camera = Camera::new(rows[0][0], rows[1][1], rows[0][2], rows[1][2]);
    match camera.is_usable() {
        true => Ok(camera),
        false => Err(Lexer::new(&with_line_feeds(bytes)).unexpected(EXPECTED)),
    }
}

/// Files and their times: `time name` in each line; a time need not be finite.
pub(super) fn timed_files(bytes: &[u8]) -> Result<Vec<(f64, String)>, FormatError> {
    const EXPECTED: &str = "a time and a file in each line";
    refuse_binary(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut files = Vec::new();
    while lexer.next_line() {
        let time = lexer.any_float(EXPECTED)?;
        lexer.at_end_of_line();
        let name = String::from_utf8_lossy(lexer.word()).into_owned();
        if name.is_empty() {
            return Err(lexer.unexpected(EXPECTED));
        }
        files.push((time, name));
    }
    Ok(files)
}
