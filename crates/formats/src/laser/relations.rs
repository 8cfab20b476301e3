//! Published relative poses between time stamps: `t1 t2 x y z roll pitch yaw` per line.
//!
//! The files of Kümmerle et al., *On measuring the accuracy of SLAM algorithms* (2009), for logs of
//! planar lasers; z, roll and pitch are read and are 0 there.

use pose::Se2;

use crate::FormatError;
use crate::binary::refuse_binary;
use crate::gzip::unpack;
use crate::lexer::Lexer;
use crate::lines::with_line_feeds;

/// Where the sensor stood at one time, seen from where it stood at another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// The time of the pose in whose frame the other is given, seconds.
    pub from_secs: f64,
    /// The time of the other pose, seconds.
    pub to_secs: f64,
    /// The pose at `to_secs` in the frame of the pose at `from_secs`.
    pub from_from_to: Se2,
}

/// Reads relations, packed with gzip or not; comments start with `#`.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column: a line that does not hold exactly eight finite
/// numbers, a file without a relation.
pub fn read(bytes: &[u8]) -> Result<Vec<Relation>, FormatError> {
    const EXPECTED: &str = "a relation `t1 t2 x y z roll pitch yaw`";
    let bytes = unpack(bytes)?;
    refuse_binary(&bytes, EXPECTED)?;
    let bytes = with_line_feeds(&bytes);
    let mut lexer = Lexer::new(&bytes);
    let mut relations = Vec::new();
    while lexer.next_line() {
        let [from_secs, to_secs, x, y, _, _, _, yaw] =
            lexer.floats("t1 t2 x y z roll pitch yaw of a relation")?;
        if !lexer.at_end_of_line() {
            return Err(lexer.unexpected("the end of the line after eight numbers"));
        }
        relations.push(Relation { from_secs, to_secs, from_from_to: Se2::new(x, y, yaw) });
    }
    if relations.is_empty() {
        return Err(lexer.unexpected(EXPECTED));
    }
    Ok(relations)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relations_are_read_and_bad_lines_are_named() {
        let relations = read(b"# head\n10.5 11 1 -2 0 0 0 0.5\n").expect("good");
        let expected =
            Relation { from_secs: 10.5, to_secs: 11.0, from_from_to: Se2::new(1.0, -2.0, 0.5) };
        assert_eq!(relations, [expected]);
        for (text, message) in [
            ("1 2 3\n", "line 1, column 6: found the end of the line, expected 8 numbers"),
            ("1 2 3 4 5 6 7 8 9\n", "line 1, column 17: found `9`, expected the end of the line"),
            ("", "expected a relation"),
            ("1 2 x 4 5 6 7 8\n", "line 1, column 5: found `x`"),
        ] {
            let error = read(text.as_bytes()).expect_err(text).to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
