//! Text files as numbered lines.

use std::borrow::Cow;

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

/// The bytes with line ends as they are read: where there are carriage returns and no line feed at all,
/// as old Macintosh programs wrote, each return ends a line. Borrowed in every other case, at the cost of
/// looking for the first line feed.
pub(crate) fn with_line_feeds(bytes: &[u8]) -> Cow<'_, [u8]> {
    if bytes.contains(&b'\n') || !bytes.contains(&b'\r') {
        return Cow::Borrowed(bytes);
    }
    Cow::Owned(bytes.iter().map(|&byte| if byte == b'\r' { b'\n' } else { byte }).collect())
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
    fn a_return_ends_a_line_where_nothing_else_does() {
        assert_eq!(*with_line_feeds(b"a\rb\r"), *b"a\nb\n");
        for bytes in [&b"a\r\nb\r\n"[..], b"a\rb\n", b"ab", b""] {
            assert!(matches!(with_line_feeds(bytes), Cow::Borrowed(same) if same == bytes));
        }
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(position(7, "äöü: x", 6), Position::Line { line: 7, column: 4 });
    }
}
