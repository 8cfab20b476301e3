//! What a reader says about bytes that it cannot read.

use std::fmt;

use thiserror::Error;

/// The most cells that a map or an image may have, 2^28; checked before memory is asked for.
pub const MAX_CELLS: u64 = 1 << 28;

/// A place inside a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// Bytes from the start of a binary file, from 0.
    Byte(usize),
    /// Line and column of a text file, both from 1; the column counts characters.
    Line {
        /// Line, from 1.
        line: usize,
        /// Character in the line, from 1.
        column: usize,
    },
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Byte(offset) => write!(f, "byte {offset}"),
            Self::Line { line, column } => write!(f, "line {line}, column {column}"),
        }
    }
}

/// Why bytes could not be read or written; the caller adds the name of the file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FormatError {
    /// Something else than the format asks for stands at a position.
    #[error("{at}: found {found}, expected {expected}")]
    Unexpected {
        /// Where the reader stopped.
        at: Position,
        /// What stands there.
        found: String,
        /// What should stand there.
        expected: String,
    },
    /// The image or map is larger than [`MAX_CELLS`].
    #[error("{at}: found {columns} x {rows} cells, expected at most {limit} in all")]
    TooLarge {
        /// Where the size was read.
        at: Position,
        /// Number of columns asked for.
        columns: u64,
        /// Number of rows asked for.
        rows: u64,
        /// The limit that it exceeds, cells or bytes.
        limit: u64,
    },
    /// An image was put together from parts that do not fit.
    #[error("image part `{part}`: found {found}, expected {expected}")]
    Image {
        /// Name of the part.
        part: &'static str,
        /// Its measured value.
        found: u64,
        /// The value that fits.
        expected: u64,
    },
    /// The scale of a depth image is of no use.
    #[error("a scale of {found} units per metre, expected a positive, finite number")]
    Scale {
        /// The scale.
        found: String,
    },
    /// A log cannot be written.
    #[error("cannot write the log: {reason}")]
    Write {
        /// The writer's own words.
        reason: String,
    },
    /// The encoder refused an image.
    #[error("cannot encode the image: {reason}")]
    Encode {
        /// The encoder's own words.
        reason: String,
    },
}

impl FormatError {
    pub(crate) fn unexpected(
        at: Position,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self::Unexpected { at, found: found.into(), expected: expected.into() }
    }
}

/// Checks a size read from a header before anything is allocated for it.
pub(crate) fn check_size(
    at: Position,
    columns: u64,
    rows: u64,
) -> Result<(usize, usize), FormatError> {
    if columns == 0 || rows == 0 {
        let found = format!("a size of {columns} x {rows}");
        return Err(FormatError::unexpected(at, found, "at least one column and one row"));
    }
    if columns.checked_mul(rows).is_none_or(|cells| cells > MAX_CELLS) {
        return Err(FormatError::TooLarge { at, columns, rows, limit: MAX_CELLS });
    }
    Ok((columns as usize, rows as usize))
}

/// Text of a file for a message: quoted, escaped and cut to a readable length.
pub(crate) fn quote(text: &str) -> String {
    const SHOWN: usize = 40;
    let mut shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push_str("...");
    }
    format!("`{shown}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_checked_without_overflow() {
        let at = Position::Byte(3);
        assert_eq!(check_size(at, 1 << 14, 1 << 14), Ok((1 << 14, 1 << 14)));
        for (columns, rows) in [((1 << 14) + 1, 1 << 14), (u64::MAX, 2), (1 << 32, 1 << 32)] {
            assert_eq!(
                check_size(at, columns, rows),
                Err(FormatError::TooLarge { at, columns, rows, limit: MAX_CELLS })
            );
        }
        assert!(check_size(at, 0, 5).is_err());
    }

    #[test]
    fn quotes_are_short_and_printable() {
        assert_eq!(quote("a\nb"), "`a\\nb`");
        assert_eq!(quote(&"x".repeat(90)), format!("`{}...`", "x".repeat(40)));
    }
}
