//! Trajectories of the TUM RGB-D benchmark: `timestamp tx ty tz qx qy qz qw` per line.

use pose::Se3;

use crate::FormatError;
use crate::binary::refuse_binary;
use crate::lines::with_line_feeds;
use crate::pose_graph::{Lexer, push_number, quaternion};

/// Poses in the order of a file, each with its time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Time of each pose, seconds.
    pub stamps_secs: Vec<f64>,
    /// `map_from_body` of each pose; as long as `stamps_secs`.
    pub poses: Vec<Se3>,
}

/// Reads a trajectory; comments start with `#`, quaternions are normalised.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column: a line that does not hold exactly eight finite
/// numbers, a quaternion without a direction, a file without a pose.
pub fn read(bytes: &[u8]) -> Result<Trajectory, FormatError> {
    const EXPECTED: &str = "a pose `timestamp tx ty tz qx qy qz qw`";
    refuse_binary(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut trajectory = Trajectory::default();
    while lexer.next_line() {
        let [stamp, x, y, z] = lexer.floats("timestamp tx ty tz of a pose")?;
        let (rotation, _) = quaternion(&mut lexer)?;
        if !lexer.at_end_of_line() {
            return Err(lexer.unexpected("the end of the line after eight numbers"));
        }
        trajectory.stamps_secs.push(stamp);
        trajectory.poses.push(Se3::new([x, y, z].into(), rotation));
    }
    if trajectory.poses.is_empty() {
        return Err(lexer.unexpected(EXPECTED));
    }
    Ok(trajectory)
}

/// The trajectory as a file; what was read reads back equal, bit for bit.
pub fn write(trajectory: &Trajectory) -> Vec<u8> {
    let mut out = Vec::with_capacity(trajectory.poses.len() * 120);
    for (stamp, pose) in trajectory.stamps_secs.iter().zip(&trajectory.poses) {
        push_number(&mut out, *stamp);
        for &number in pose.translation.iter().chain(pose.rotation.coords.iter()) {
            out.push(b' ');
            push_number(&mut out, number);
        }
        out.push(b'\n');
    }
    out
}

/// Whether the first line that holds a word holds eight numbers.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    let bytes = with_line_feeds(bytes);
    let mut lexer = Lexer::new(&bytes);
    lexer.next_line() && lexer.floats::<8>("").is_ok() && lexer.at_end_of_line()
}
