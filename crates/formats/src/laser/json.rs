//! As much JSON as a log takes: walked over once, nothing kept but what is asked for.

use crate::FormatError;
use crate::error::{Position, quote};

/// Objects and arrays may be nested so deep.
const DEPTH: usize = 32;

/// Walks over a JSON text.
pub(super) struct Json<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Json<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    fn peek(&mut self) -> Option<u8> {
        while let Some(byte) = self.bytes.get(self.at) {
            if !byte.is_ascii_whitespace() {
                return Some(*byte);
            }
            self.at += 1;
        }
        None
    }

    /// What stands here instead of what was expected. Cost: counts lines from the start.
    pub fn unexpected(&mut self, expected: &str) -> FormatError {
        let found = match self.peek() {
            None => "the end of the file".to_owned(),
            Some(_) => {
                let rest = &self.bytes[self.at..];
                let ends = |byte: &u8| byte.is_ascii_whitespace() || b",:]}".contains(byte);
                let end = rest.iter().skip(1).position(ends).map_or(rest.len(), |n| n + 1);
                quote(&String::from_utf8_lossy(&rest[..end]))
            }
        };
        let before = &self.bytes[..self.at];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |n| n + 1);
        let column = String::from_utf8_lossy(&before[start..]).chars().count() + 1;
        FormatError::unexpected(Position::Line { line, column }, found, expected)
    }

    /// Takes a byte if it comes next.
    fn take(&mut self, byte: u8) -> bool {
        let is = self.peek() == Some(byte);
        self.at += usize::from(is);
        is
    }

    fn need(&mut self, byte: u8) -> Result<(), FormatError> {
        match self.take(byte) {
            true => Ok(()),
            false => Err(self.unexpected(&format!("`{}`", char::from(byte)))),
        }
    }

    /// The text of a string, as it stands between its quotes: escapes are kept.
    fn string(&mut self, expected: &str) -> Result<&'a [u8], FormatError> {
        if self.peek() != Some(b'"') {
            return Err(self.unexpected(expected));
        }
        let start = self.at + 1;
        let mut at = start;
        loop {
            match self.bytes.get(at) {
                Some(b'"') => break,
                Some(b'\\') => at += 2,
                Some(_) => at += 1,
                None => return Err(self.unexpected("a string with both its quotes")),
            }
        }
        self.at = at + 1;
        Ok(&self.bytes[start..at])
    }

    /// A number that need not be finite: some programs write `NaN` and `Infinity`.
    pub fn number(&mut self, expected: &str) -> Result<f64, FormatError> {
        self.peek();
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((value, length)) => {
                self.at += length;
                Ok(value)
            }
            Err(_) => Err(self.unexpected(expected)),
        }
    }

    /// The members of an object: their names, and what `member` makes of the value that follows.
    pub fn object(
        &mut self,
        expected: &str,
        mut member: impl FnMut(&mut Self, &'a [u8]) -> Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        if !self.take(b'{') {
            return Err(self.unexpected(expected));
        }
        if self.take(b'}') {
            return Ok(());
        }
        loop {
            let name = self.string("the name of a member")?;
            self.need(b':')?;
            member(self, name)?;
            if !self.take(b',') {
                return self.need(b'}');
            }
        }
    }

    /// The values of an array, each read by `value`.
    pub fn array(
        &mut self,
        expected: &str,
        mut value: impl FnMut(&mut Self) -> Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        if !self.take(b'[') {
            return Err(self.unexpected(expected));
        }
        if self.take(b']') {
            return Ok(());
        }
        loop {
            value(self)?;
            if !self.take(b',') {
                return self.need(b']');
            }
        }
    }

    /// Passes over a value of any kind.
    pub fn skip(&mut self) -> Result<(), FormatError> {
        self.skip_within(DEPTH)
    }

    fn skip_within(&mut self, depth: usize) -> Result<(), FormatError> {
        if depth == 0 {
            return Err(self.unexpected(&format!("values nested at most {DEPTH} deep")));
        }
        match self.peek() {
            Some(b'{') => self.object("an object", |json, _| json.skip_within(depth - 1)),
            Some(b'[') => self.array("an array", |json| json.skip_within(depth - 1)),
            Some(b'"') => self.string("a string").map(drop),
            _ => {
                for word in ["true", "false", "null"] {
                    if self.bytes[self.at..].starts_with(word.as_bytes()) {
                        self.at += word.len();
                        return Ok(());
                    }
                }
                self.number("a value").map(drop)
            }
        }
    }

    /// Nothing but blanks is left.
    pub fn end(&mut self) -> Result<(), FormatError> {
        match self.peek() {
            None => Ok(()),
            Some(_) => Err(self.unexpected("the end of the file")),
        }
    }
}
