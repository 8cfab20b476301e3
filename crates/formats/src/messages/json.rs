//! JSON, value by value, without a tree: a tree takes many times the memory of its text.

use std::borrow::Cow;

use super::Malformed;

/// How deep objects and lists may stand in each other.
const MAX_DEPTH: u32 = 64;

/// A place in a JSON text.
pub(crate) struct Json<'a> {
    bytes: &'a [u8],
    at: usize,
    depth: u32,
}

impl<'a> Json<'a> {
    /// A reader at the start of a text.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, depth: 0 }
    }

    /// A complaint about the place where the reader stands.
    pub(crate) fn malformed<T>(&self, found: &'static str) -> Result<T, Malformed> {
        Err(Malformed { at: self.at, found })
    }

    /// Reads an object; `on` reads or skips the value of each key.
    pub(crate) fn object(
        &mut self,
        mut on: impl FnMut(&mut Self, &str) -> Result<(), Malformed>,
    ) -> Result<(), Malformed> {
        self.enter(b'{', "something else than an object")?;
        if !self.try_byte(b'}') {
            loop {
                let key = self.text()?;
                self.byte(b':', "a key without a colon behind it")?;
                on(self, &key)?;
                if self.try_byte(b'}') {
                    break;
                }
                self.byte(b',', "an object without a comma or an end")?;
            }
        }
        self.depth -= 1;
        Ok(())
    }

    /// Reads a list; `on` reads or skips each value.
    pub(crate) fn list(
        &mut self,
        mut on: impl FnMut(&mut Self) -> Result<(), Malformed>,
    ) -> Result<(), Malformed> {
        self.enter(b'[', "something else than a list")?;
        if !self.try_byte(b']') {
            loop {
                on(self)?;
                if self.try_byte(b']') {
                    break;
                }
                self.byte(b',', "a list without a comma or an end")?;
            }
        }
        self.depth -= 1;
        Ok(())
    }

    /// Reads a list of numbers, of `most` at most.
    pub(crate) fn numbers(&mut self, list: &mut Vec<f64>, most: usize) -> Result<(), Malformed> {
        list.clear();
        self.list(|json| {
            if list.len() == most {
                return json.malformed("more numbers than a list here may have");
            }
            list.push(json.number()?);
            Ok(())
        })
    }

    /// Reads a number; `null`, `"NaN"` and `"Infinity"` are what JSON has no numbers for.
    pub(crate) fn number(&mut self) -> Result<f64, Malformed> {
        match self.peek() {
            Some(b'"') => {
                let at = self.at;
                match &*self.text()? {
                    "NaN" => Ok(f64::NAN),
                    "Infinity" => Ok(f64::INFINITY),
                    "-Infinity" => Ok(f64::NEG_INFINITY),
                    _ => Err(Malformed { at, found: "a text, not a number" }),
                }
            }
            Some(b'n') => self.word("null").map(|()| f64::NAN),
            _ => {
                let digits = self.digits()?;
                match fast_float2::parse(digits) {
                    Ok(number) => Ok(number),
                    Err(_) => self.malformed("no number"),
                }
            }
        }
    }

    /// Reads a whole number.
    pub(crate) fn whole(&mut self) -> Result<i64, Malformed> {
        let digits = self.digits()?;
        let text = std::str::from_utf8(digits).unwrap_or("");
        text.parse().or_else(|_| self.malformed("no whole number"))
    }

    /// Reads a count of 32 bits.
    pub(crate) fn count(&mut self) -> Result<u32, Malformed> {
        let number = self.whole()?;
        u32::try_from(number).or_else(|_| self.malformed("a number that is no count"))
    }

    /// Reads a text.
    pub(crate) fn text(&mut self) -> Result<Cow<'a, str>, Malformed> {
        self.byte(b'"', "something else than a text")?;
        let start = self.at;
        let Some(end) = self.bytes[start..].iter().position(|&byte| matches!(byte, b'"' | b'\\'))
        else {
            return self.malformed("a text without an end");
        };
        let plain = std::str::from_utf8(&self.bytes[start..start + end]);
        let plain = plain.or_else(|_| self.malformed("a text that is no UTF-8"))?;
        self.at = start + end;
        if self.bytes[self.at] == b'"' {
            self.at += 1;
            return Ok(Cow::Borrowed(plain));
        }
        self.escaped(plain.as_bytes().to_vec()).map(Cow::Owned)
    }

    /// Steps over a value of any kind.
    pub(crate) fn skip(&mut self) -> Result<(), Malformed> {
        match self.peek() {
            Some(b'{') => self.object(|json, _| json.skip()),
            Some(b'[') => self.list(Self::skip),
            Some(b'"') => self.text().map(|_| ()),
            Some(b't') => self.word("true"),
            Some(b'f') => self.word("false"),
            Some(b'n') => self.word("null"),
            _ => self.digits().map(|_| ()),
        }
    }

    /// Whether nothing but blanks is left.
    pub(crate) fn end(&mut self) -> Result<(), Malformed> {
        match self.peek() {
            None => Ok(()),
            Some(_) => self.malformed("something behind the value"),
        }
    }

    fn escaped(&mut self, mut text: Vec<u8>) -> Result<String, Malformed> {
        loop {
            let Some(&byte) = self.bytes.get(self.at) else {
                return self.malformed("a text without an end");
            };
            self.at += 1;
            match byte {
                b'"' => break,
                b'\\' => {
                    let letter = self.escape()?;
                    text.extend(letter.encode_utf8(&mut [0; 4]).bytes());
                }
                other => text.push(other),
            }
        }
        String::from_utf8(text).or_else(|_| self.malformed("a text that is no UTF-8"))
    }

    /// The letter behind a backslash.
    fn escape(&mut self) -> Result<char, Malformed> {
        let kind = self.bytes.get(self.at).copied();
        self.at += 1;
        Ok(match kind {
            Some(quoted @ (b'"' | b'\\' | b'/')) => char::from(quoted),
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                let first = self.hex()?;
                let pair = (0xd800..0xdc00).contains(&first)
                    && self.bytes.get(self.at..self.at + 2) == Some(b"\\u");
                let code = if pair {
                    self.at += 2;
                    let second = self.hex()?;
                    0x10000 + ((first - 0xd800) << 10) + (second.wrapping_sub(0xdc00) & 0x3ff)
                } else {
                    first
                };
                char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)
            }
            _ => return self.malformed("an unknown letter behind a backslash"),
        })
    }

    fn hex(&mut self) -> Result<u32, Malformed> {
        let digits = self.bytes.get(self.at..self.at + 4).unwrap_or(&[]);
        let text = std::str::from_utf8(digits).ok().filter(|text| text.len() == 4);
        let code = text.and_then(|text| u32::from_str_radix(text, 16).ok());
        self.at += 4;
        code.map_or_else(|| self.malformed("no four hexadecimal digits"), Ok)
    }

    fn digits(&mut self) -> Result<&'a [u8], Malformed> {
        self.peek();
        let rest = &self.bytes[self.at..];
        let digit = |byte: &u8| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E');
        let length = rest.iter().position(|byte| !digit(byte)).unwrap_or(rest.len());
        if length == 0 {
            return self.malformed("no value");
        }
        self.at += length;
        Ok(&rest[..length])
    }

    fn word(&mut self, word: &'static str) -> Result<(), Malformed> {
        if self.bytes[self.at..].starts_with(word.as_bytes()) {
            self.at += word.len();
            return Ok(());
        }
        self.malformed("no value")
    }

    fn enter(&mut self, open: u8, found: &'static str) -> Result<(), Malformed> {
        self.byte(open, found)?;
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            self.malformed("too many values within values")
        } else {
            Ok(())
        }
    }

    fn byte(&mut self, wanted: u8, found: &'static str) -> Result<(), Malformed> {
        if self.try_byte(wanted) { Ok(()) } else { self.malformed(found) }
    }

    fn try_byte(&mut self, wanted: u8) -> bool {
        let there = self.peek() == Some(wanted);
        self.at += usize::from(there);
        there
    }

    /// The next byte that is no blank.
    fn peek(&mut self) -> Option<u8> {
        while let Some(&byte) = self.bytes.get(self.at) {
            if !matches!(byte, b' ' | b'\t' | b'\n' | b'\r') {
                return Some(byte);
            }
            self.at += 1;
        }
        None
    }
}

/// The bytes of a text in base64, with or without the signs that fill its end.
pub(crate) fn base64(text: &str, at: usize) -> Result<Vec<u8>, Malformed> {
    let malformed = Malformed { at, found: "a text that is no base64" };
    let text = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0_u32;
        for &letter in group {
            let six = match letter {
                b'A'..=b'Z' => letter - b'A',
                b'a'..=b'z' => letter - b'a' + 26,
                b'0'..=b'9' => letter - b'0' + 52,
                b'+' | b'-' => 62,
                b'/' | b'_' => 63,
                _ => return Err(malformed),
            };
            bits = bits << 6 | u32::from(six);
        }
        match group.len() {
            4 => bytes.extend(&bits.to_be_bytes()[1..]),
            3 => bytes.extend(&(bits << 6).to_be_bytes()[1..3]),
            2 => bytes.push((bits >> 4) as u8),
            _ => return Err(malformed),
        }
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_in_order() {
        let text = r#" { "a" : [1, -2.5e1, null, "NaN"], "b\n\u00e9\ud83d\ude00": {"c": [true, {}]}, "d": "x" } "#;
        let mut json = Json::new(text.as_bytes());
        let (mut numbers, mut keys) = (Vec::new(), Vec::new());
        json.object(|json, key| {
            keys.push(key.to_owned());
            if key == "a" { json.numbers(&mut numbers, 4) } else { json.skip() }
        })
        .expect("an object");
        json.end().expect("nothing behind it");
        assert_eq!(keys, ["a", "b\né😀", "d"]);
        assert_eq!(numbers[..2], [1.0, -25.0]);
        assert!(numbers[2..].iter().all(|number| number.is_nan()));
        assert!(Json::new(b"[1,2]").numbers(&mut numbers, 1).is_err());
    }

    #[test]
    fn broken_texts_are_refused() {
        for text in [
            "",
            "{",
            "[1",
            "[1 2]",
            "{\"a\" 1}",
            "{a: 1}",
            "\"x",
            "\"\\",
            "\"\\q\"",
            "\"\\u12\"",
            "nul",
            "[,]",
            "\"\u{0}\\u00",
        ] {
            assert!(Json::new(text.as_bytes()).skip().is_err(), "{text}");
        }
        assert!(Json::new("[".repeat(100_000).as_bytes()).skip().is_err());
        assert!(
            Json::new(b"\"\xff\"").text().is_err() && Json::new(b"\"\\n\xff\"").text().is_err()
        );
        assert!(Json::new(b"1.5").whole().is_err() && Json::new(b"-1").count().is_err());
        let mut behind = Json::new(b"1 2");
        assert!(behind.skip().is_ok() && behind.end().is_err());
    }

    #[test]
    fn base64_comes_back() {
        let read = |text| base64(text, 0).ok();
        assert_eq!(read("AAEC/w=="), Some(vec![0, 1, 2, 255]));
        assert_eq!(read("AAE="), Some(vec![0, 1]));
        assert_eq!(read("AAE"), Some(vec![0, 1]));
        assert_eq!(read(""), Some(vec![]));
        assert_eq!(read("A"), None);
        assert_eq!(read("A*=="), None);
    }
}
