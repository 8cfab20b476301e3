//! Text files as numbered lines.

use crate::FormatError;
use crate::error::Position;

/// The text of a file, without a byte-order mark.
///
/// # Errors
/// [`FormatError::Unexpected`] at the first byte that is not UTF-8.
pub fn text(bytes: &[u8]) -> Result<&str, FormatError> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(without_mark(text)),
        Err(error) => {
            let offset = error.valid_up_to();
            let found = match bytes.get(offset) {
                Some(byte) => format!("byte 0x{byte:02x}"),
                None => "the end of the file".into(),
            };
            Err(FormatError::unexpected(Position::Byte(offset), found, "UTF-8 text"))
        }
    }
}

pub(crate) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// Position of the byte `offset` of a line, which must be a character boundary.
pub(crate) fn position(line: usize, text: &str, offset: usize) -> Position {
    let before = text.get(..offset).unwrap_or(text);
    Position::Line { line, column: before.chars().count() + 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_text_is_located() {
        assert_eq!(text(b"\xef\xbb\xbfab"), Ok("ab"));
        let error = text(b"abc\xff").expect_err("not UTF-8");
        assert_eq!(error.to_string(), "byte 3: found byte 0xff, expected UTF-8 text");
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(position(7, "äöü: x", 6), Position::Line { line: 7, column: 4 });
    }
}
