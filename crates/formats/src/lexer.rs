//! Words and numbers of a text file, taken from its bytes without a copy.

use crate::FormatError;
use crate::error::{Position, quote};

/// Walks over a text file, line by line and word by word.
///
/// Words are parted by blanks, tabs and carriage returns; `#` starts a comment where a word could
/// start. Nothing is allocated but for messages.
pub(crate) struct Lexer<'a> {
    bytes: &'a [u8],
    /// The next byte to look at.
    at: usize,
    /// Where the line at hand starts.
    line_start: usize,
    /// The line at hand, from 1; 0 before the first.
    line: usize,
}

const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | 0x0b | 0x0c)
}

const fn ends_word(byte: u8) -> bool {
    is_blank(byte) || byte == b'\n'
}

/// Whether a word is what older C libraries of Windows write for a number that is none: `1.#QNAN`, `-1.#IND00`,
/// `1.#INF000e+000`.
fn is_none_of_windows(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").unwrap_or(word);
    let name = word.strip_prefix(b"1.#").unwrap_or_default();
    [&b"QNAN"[..], b"SNAN", b"IND", b"INF"].iter().any(|&none| {
        let rest = name.strip_prefix(none);
        rest.is_some_and(|rest| rest.iter().all(|byte| matches!(byte, b'0'..=b'9' | b'e' | b'+')))
    })
}

impl<'a> Lexer<'a> {
    /// Starts before the first line; a byte-order mark is passed over.
    pub fn new(bytes: &'a [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self { bytes, at: 0, line_start: 0, line: 0 }
    }

    /// The line at hand, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Goes to the next line that holds a word, whatever is left of the line at hand.
    ///
    /// Returns whether there is one; the next word is its first.
    pub fn next_line(&mut self) -> bool {
        loop {
            if self.line > 0 {
                let rest = self.bytes.get(self.at..).unwrap_or_default();
                match rest.iter().position(|&byte| byte == b'\n') {
                    Some(offset) if self.at + offset + 1 < self.bytes.len() => {
                        self.at += offset + 1;
                    }
                    _ => {
                        self.at = self.bytes.len();
                        return false;
                    }
                }
            }
            self.line += 1;
            self.line_start = self.at;
            if !self.at_end_of_line() {
                return true;
            }
            if self.at >= self.bytes.len() {
                return false;
            }
        }
    }

    /// Goes to the next line even if it is empty; whether there is one.
    pub fn next_raw_line(&mut self) -> bool {
        if self.line > 0 {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            match rest.iter().position(|&byte| byte == b'\n') {
                Some(offset) => self.at += offset + 1,
                None => {
                    self.at = self.bytes.len();
                    return false;
                }
            }
        }
        self.line += 1;
        self.line_start = self.at;
        true
    }

    /// Bytes that are left of the file.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Passes over blanks; whether nothing but a comment is left of the line.
    pub fn at_end_of_line(&mut self) -> bool {
        loop {
            match self.bytes.get(self.at) {
                Some(&byte) if is_blank(byte) => self.at += 1,
                Some(b'\n' | b'#') | None => return true,
                Some(_) => return false,
            }
        }
    }

    /// The next word of the line; empty at its end.
    pub fn word(&mut self) -> &'a [u8] {
        if self.at_end_of_line() {
            return &[];
        }
        let word = self.peeked();
        self.at += word.len();
        word
    }

    /// What is left of the word that starts here.
    fn peeked(&self) -> &'a [u8] {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let end = rest.iter().position(|&byte| ends_word(byte)).unwrap_or(rest.len());
        &rest[..end]
    }

    /// The next word as a finite number.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] where the line ends, or stands no number, or no finite one.
    #[inline]
    pub fn float(&mut self, expected: &str) -> Result<f64, FormatError> {
        if self.at_end_of_line() {
            return Err(self.unexpected(expected));
        }
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((value, length))
                if value.is_finite() && rest.get(length).is_none_or(|&byte| ends_word(byte)) =>
            {
                self.at += length;
                Ok(value)
            }
            _ => Err(self.unexpected(&format!("{expected}, a finite number"))),
        }
    }

    /// The next word as a number that need not be finite; what the C library of Windows writes for such, `-1.#IND`
    /// and the like, too.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] where the line ends, or stands no number.
    pub fn any_float(&mut self, expected: &str) -> Result<f64, FormatError> {
        if self.at_end_of_line() {
            return Err(self.unexpected(expected));
        }
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((value, length)) if rest.get(length).is_none_or(|&byte| ends_word(byte)) => {
                self.at += length;
                Ok(value)
            }
            _ if is_none_of_windows(self.peeked()) => {
                self.at += self.peeked().len();
                Ok(f64::NAN)
            }
            _ => Err(self.unexpected(expected)),
        }
    }

    /// The next `N` words as finite numbers.
    ///
    /// # Errors
    /// As [`float`](Self::float).
    #[inline]
    pub fn floats<const N: usize>(&mut self, expected: &str) -> Result<[f64; N], FormatError> {
        let mut values = [0.0; N];
        for (index, value) in values.iter_mut().enumerate() {
            if self.at_end_of_line() {
                let expected = format!("{N} numbers ({expected}), of which {index} are there");
                return Err(self.unexpected(&expected));
            }
            *value = self.float(expected)?;
        }
        Ok(values)
    }

    /// The next word as the id of a vertex.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] where the line ends, or stands no integer from 0 to 2⁶⁴ - 1.
    #[inline]
    pub fn id(&mut self, expected: &str) -> Result<u64, FormatError> {
        let refused = |lexer: &Self| {
            let expected = format!("{expected}, an integer from 0 to {}", u64::MAX);
            lexer.unexpected(&expected)
        };
        if self.at_end_of_line() {
            return Err(refused(self));
        }
        let word = self.peeked();
        let mut id: Option<u64> = None;
        for &byte in word {
            let digit = byte.wrapping_sub(b'0');
            let grown = id.unwrap_or(0).checked_mul(10).and_then(|id| id.checked_add(digit.into()));
            id = grown.filter(|_| digit < 10);
            if id.is_none() {
                return Err(refused(self));
            }
        }
        self.at += word.len();
        id.ok_or_else(|| refused(self))
    }

    /// Remembers where the lexer stands, for [`position_of`](Self::position_of).
    pub fn mark(&self) -> usize {
        self.at
    }

    /// Line, and column in characters, of a mark in the line at hand.
    pub fn position_of(&self, mark: usize) -> Position {
        let before = self.bytes.get(self.line_start..mark).unwrap_or_default();
        let before = before.strip_suffix(b"\n").unwrap_or(before);
        let column = String::from_utf8_lossy(before).chars().count() + 1;
        Position::Line { line: self.line.max(1), column }
    }

    /// What stands here instead of what was expected.
    pub fn unexpected(&self, expected: &str) -> FormatError {
        let found = match self.bytes.get(self.at) {
            None => "the end of the file".to_owned(),
            Some(b'\n' | b'#') => "the end of the line".to_owned(),
            Some(_) => quote(&String::from_utf8_lossy(self.peeked())),
        };
        FormatError::unexpected(self.position_of(self.at), found, expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_numbers_and_lines() {
        let text = b"\xef\xbb\xbf# head\n\n  A 12 -0.5\t1e-3 \r\nB # rest\nC 18446744073709551615";
        let mut lexer = Lexer::new(text);
        assert!(lexer.next_line());
        assert_eq!((lexer.line(), lexer.word()), (3, b"A".as_slice()));
        assert_eq!(lexer.id("an id"), Ok(12));
        assert_eq!(lexer.floats::<2>("x, y"), Ok([-0.5, 1e-3]));
        assert!(lexer.at_end_of_line());
        assert!(lexer.next_line());
        assert_eq!((lexer.line(), lexer.word()), (4, b"B".as_slice()));
        assert!(lexer.at_end_of_line() && lexer.word().is_empty());
        assert!(lexer.next_line());
        assert_eq!(lexer.word(), b"C");
        assert_eq!(lexer.id("an id"), Ok(u64::MAX));
        assert!(!lexer.next_line() && !lexer.next_line());
    }

    #[test]
    fn what_windows_writes_for_no_number_is_one() {
        let mut lexer = Lexer::new(b"-1.#IND000e+000 1.#QNAN -1.#INF nan -inf 2 1.#IND_x");
        assert!(lexer.next_line());
        let read: Vec<f64> = (0..6).filter_map(|_| lexer.any_float("x").ok()).collect();
        assert!(read.len() == 6 && read[..4].iter().all(|x| x.is_nan()), "{read:?}");
        assert_eq!(read[4..], [f64::NEG_INFINITY, 2.0]);
        assert!(lexer.any_float("x").is_err() && lexer.float("x").is_err());
    }

    #[test]
    fn what_is_no_number_is_told_with_its_place() {
        let cases = [
            ("x", "line 1, column 3: found `x`, expected x, a finite number"),
            ("nan", "line 1, column 3: found `nan`, expected x, a finite number"),
            ("-inf", "line 1, column 3: found `-inf`, expected x, a finite number"),
            ("1e999", "line 1, column 3: found `1e999`, expected x, a finite number"),
            ("1,5", "line 1, column 3: found `1,5`, expected x, a finite number"),
            (" # 1", "line 1, column 4: found the end of the line, expected x"),
            ("", "line 1, column 3: found the end of the file, expected x"),
        ];
        for (word, message) in cases {
            let text = format!("A {word}");
            let mut lexer = Lexer::new(text.as_bytes());
            assert!(lexer.next_line() && lexer.word() == b"A");
            assert_eq!(lexer.float("x").expect_err(word).to_string(), message);
        }
        for word in ["-1", "1.0", "18446744073709551616", "é"] {
            let text = format!("A {word}");
            let mut lexer = Lexer::new(text.as_bytes());
            assert!(lexer.next_line() && lexer.word() == b"A");
            let message = format!(
                "line 1, column 3: found `{word}`, expected an id, an integer from 0 to {}",
                u64::MAX
            );
            assert_eq!(lexer.id("an id").expect_err(word).to_string(), message);
        }
    }
}
