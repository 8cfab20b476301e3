//! The flat part of YAML: keys at the left margin, each with a scalar or a list of scalars.

use crate::FormatError;
use crate::error::{Position, quote};
use crate::lines::{position, without_mark};

/// A single value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scalar {
    pub text: String,
    pub at: Position,
}

impl Scalar {
    /// The value as a finite number that passes a test.
    pub fn number(&self, expected: &str, test: impl Fn(f64) -> bool) -> Result<f64, FormatError> {
        match self.text.parse::<f64>() {
            Ok(number) if number.is_finite() && test(number) => Ok(number),
            _ => {
                let found = if self.text.is_empty() { "nothing".into() } else { quote(&self.text) };
                Err(FormatError::unexpected(self.at, found, expected))
            }
        }
    }
}

/// What stands behind a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Scalar(Scalar),
    List(Vec<Scalar>),
    /// Anything deeper; only its end was looked for.
    Deeper,
}

impl Value {
    pub fn describe(&self) -> String {
        match self {
            Self::Scalar(scalar) if scalar.text.is_empty() => "nothing".into(),
            Self::Scalar(scalar) => quote(&scalar.text),
            Self::List(_) => "a list".into(),
            Self::Deeper => "a nested value".into(),
        }
    }
}

/// One key of the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub key: String,
    pub key_at: Position,
    pub value: Value,
    pub value_at: Position,
}

impl Entry {
    pub fn scalar(&self, expected: &str) -> Result<&Scalar, FormatError> {
        match &self.value {
            Value::Scalar(scalar) => Ok(scalar),
            other => Err(FormatError::unexpected(self.value_at, other.describe(), expected)),
        }
    }
}

/// All keys in the order of the file, each once, and where the file ends.
pub(super) fn entries(text: &str) -> Result<(Vec<Entry>, Position), FormatError> {
    let mut reader = Reader { lines: without_mark(text).lines().collect(), next: 0 };
    let mut entries: Vec<Entry> = Vec::new();
    while let Some(&line) = reader.lines.get(reader.next) {
        let number = reader.next + 1;
        let bare = without_comment(line);
        if bare == "..." {
            break;
        }
        if bare.is_empty() || bare == "---" || (entries.is_empty() && bare.starts_with('%')) {
            reader.next += 1;
            continue;
        }
        let entry = reader.entry(number, line)?;
        if entries.iter().any(|other| other.key == entry.key) {
            let found = format!("a second `{}`", entry.key);
            return Err(FormatError::unexpected(entry.key_at, found, "each key once"));
        }
        entries.push(entry);
    }
    Ok((entries, position(reader.next + 1, "", 0)))
}

struct Reader<'a> {
    lines: Vec<&'a str>,
    /// Index of the next line to read.
    next: usize,
}

impl Reader<'_> {
    /// Reads the key of a line and its value, and moves behind it.
    fn entry(&mut self, number: usize, line: &str) -> Result<Entry, FormatError> {
        let no_key = || {
            let indent = line.len() - line.trim_start().len();
            FormatError::unexpected(position(number, line, indent), quote(line), "`key: value`")
        };
        if line.starts_with([' ', '\t', '-', '[', '{']) {
            return Err(no_key());
        }
        let (key, key_end) = match line.chars().next() {
            Some(mark @ ('"' | '\'')) => quoted(number, line, 0, mark)?,
            _ => {
                let colon = line.char_indices().find(|&(index, symbol)| {
                    symbol == ':'
                        && line[index + 1..].chars().next().is_none_or(char::is_whitespace)
                });
                let Some((colon, _)) = colon else { return Err(no_key()) };
                (line[..colon].trim_end().to_owned(), colon)
            }
        };
        let rest = line[key_end..].trim_start();
        if !rest.starts_with(':') || key.is_empty() {
            return Err(no_key());
        }
        let colon = line.len() - rest.len();
        let rest = line[colon + 1..].trim_start();
        let start = line.len() - rest.len();
        let (value, value_at) = match rest.chars().next() {
            Some('[') => (self.flow_list(start)?, position(number, line, start)),
            Some('{' | '|' | '>') => {
                self.next += 1;
                (Value::Deeper, position(number, line, start))
            }
            Some('#') | None => {
                // A comment or the end: the value is on the lines below, or there is none.
                let at = position(number, line, colon + 1);
                self.next += 1;
                (self.block_list(at)?, at)
            }
            Some(mark @ ('"' | '\'')) => {
                let (text, end) = quoted(number, line, start, mark)?;
                only_comment(number, line, end)?;
                self.next += 1;
                let at = position(number, line, start);
                (Value::Scalar(Scalar { text, at }), at)
            }
            Some(_) => {
                let at = position(number, line, start);
                self.next += 1;
                (Value::Scalar(Scalar { text: without_comment(rest).to_owned(), at }), at)
            }
        };
        let value = if self.skip_indented(&value) { Value::Deeper } else { value };
        Ok(Entry { key, key_at: position(number, line, 0), value, value_at })
    }

    /// Skips indented lines where a nested value may have them; whether there were any.
    fn skip_indented(&mut self, value: &Value) -> bool {
        let may = match value {
            Value::Deeper => true,
            Value::Scalar(scalar) => scalar.text.is_empty(),
            Value::List(_) => false,
        };
        let mut any = false;
        while may
            && let Some(line) = self.lines.get(self.next)
            && (line.starts_with([' ', '\t']) || (any && line.trim().is_empty()))
        {
            any |= !without_comment(line).is_empty();
            self.next += 1;
        }
        any
    }

    /// A list of `- item` lines; an empty scalar when the next line is none.
    fn block_list(&mut self, at: Position) -> Result<Value, FormatError> {
        let mut items = Vec::new();
        let mut end = self.next;
        while let Some(&line) = self.lines.get(end) {
            let bare = without_comment(line);
            let indent = line.len() - line.trim_start().len();
            let rest = bare.trim_start();
            if rest.is_empty() {
                end += 1;
                continue;
            }
            let Some(item) = rest.strip_prefix('-') else { break };
            if rest == "---" || !(item.is_empty() || item.starts_with([' ', '\t'])) {
                break;
            }
            let start = indent + 1 + (item.len() - item.trim_start().len());
            let item = item.trim_start();
            let at = position(end + 1, line, start);
            end += 1;
            self.next = end;
            match item.chars().next() {
                Some('[' | '{' | '|' | '>') | None => return Ok(Value::Deeper),
                Some(mark @ ('"' | '\'')) => {
                    let (text, after) = quoted(end, line, start, mark)?;
                    only_comment(end, line, after)?;
                    items.push(Scalar { text, at });
                }
                // `- key: value` is a list of maps.
                Some(_) if item.contains(": ") || item.ends_with(':') || item.starts_with("- ") => {
                    return Ok(Value::Deeper);
                }
                Some(_) => items.push(Scalar { text: item.to_owned(), at }),
            }
        }
        if items.is_empty() {
            return Ok(Value::Scalar(Scalar { text: String::new(), at }));
        }
        Ok(Value::List(items))
    }

    /// A list in brackets that opens at a byte of the next line; it may go on over indented lines.
    fn flow_list(&mut self, start: usize) -> Result<Value, FormatError> {
        let mut items: Vec<Scalar> = Vec::new();
        let mut deeper = false;
        let mut depth = 0_usize;
        // Whether an item may start here: after a bracket or a comma.
        let mut open = true;
        let mut offset = start;
        loop {
            let number = self.next + 1;
            let line = self.lines[self.next];
            while let Some(symbol) = line[offset..].chars().next() {
                let at = position(number, line, offset);
                match symbol {
                    '[' | '{' => {
                        deeper |= depth > 0;
                        depth += 1;
                        offset += 1;
                    }
                    ']' | '}' => {
                        depth -= 1;
                        open = false;
                        offset += 1;
                        if depth == 0 {
                            only_comment(number, line, offset)?;
                            self.next += 1;
                            return Ok(if deeper { Value::Deeper } else { Value::List(items) });
                        }
                    }
                    ',' if open && !deeper => {
                        return Err(FormatError::unexpected(at, "`,`", "a value of the list"));
                    }
                    ',' => {
                        open = true;
                        offset += 1;
                    }
                    '#' if line[..offset].ends_with([' ', '\t']) => offset = line.len(),
                    _ if symbol.is_whitespace() => offset += symbol.len_utf8(),
                    _ if !open && !deeper => {
                        let found = quote(line[offset..].trim_end());
                        return Err(FormatError::unexpected(at, found, "`,` or `]`"));
                    }
                    '"' | '\'' => {
                        let (text, end) = quoted(number, line, offset, symbol)?;
                        items.push(Scalar { text, at });
                        (open, offset) = (false, end);
                    }
                    _ => {
                        let rest = &line[offset..];
                        let end = rest.find([',', ']', '}', '[', '{']).unwrap_or(rest.len());
                        let end = rest.find(" #").map_or(end, |comment| end.min(comment));
                        items.push(Scalar { text: rest[..end].trim_end().to_owned(), at });
                        (open, offset) = (false, offset + end);
                    }
                }
            }
            let at = position(number, line, line.len());
            self.next += 1;
            offset = 0;
            let goes_on = self
                .lines
                .get(self.next)
                .is_some_and(|line| line.trim().is_empty() || line.starts_with([' ', '\t', ']']));
            if !goes_on {
                let found = "the end of the list without `]`";
                return Err(FormatError::unexpected(at, found, "`]`"));
            }
        }
    }
}

/// The line up to its comment, without white space at its end.
fn without_comment(line: &str) -> &str {
    let mut quote: Option<char> = None;
    let mut before = ' ';
    for (index, symbol) in line.char_indices() {
        match (quote, symbol) {
            (Some(mark), _) if mark == symbol => quote = None,
            (None, '#') if before.is_whitespace() => return line[..index].trim_end(),
            // A quote inside a word is an apostrophe.
            (None, '"' | '\'') if before.is_whitespace() => quote = Some(symbol),
            _ => {}
        }
        before = symbol;
    }
    line.trim_end()
}

fn only_comment(number: usize, line: &str, end: usize) -> Result<(), FormatError> {
    let rest = &line[end..];
    let bare = rest.trim_start();
    if bare.is_empty() || (bare.starts_with('#') && bare.len() < rest.len()) {
        return Ok(());
    }
    let at = position(number, line, line.len() - bare.len());
    Err(FormatError::unexpected(at, quote(bare), "the end of the line"))
}

/// The quoted text that opens at a byte of the line, and the byte behind its closing quote.
fn quoted(
    number: usize,
    line: &str,
    start: usize,
    mark: char,
) -> Result<(String, usize), FormatError> {
    let mut text = String::new();
    let mut symbols = line[start + 1..].char_indices().peekable();
    while let Some((index, symbol)) = symbols.next() {
        let at = start + 1 + index;
        if symbol == mark {
            if mark == '\'' && symbols.next_if(|&(_, next)| next == '\'').is_some() {
                text.push('\'');
                continue;
            }
            return Ok((text, at + 1));
        }
        if symbol != '\\' || mark == '\'' {
            text.push(symbol);
            continue;
        }
        let escape = symbols.next().map(|(_, escape)| escape);
        let digits = match escape {
            Some('x') => 2,
            Some('u') => 4,
            Some('U') => 8,
            _ => 0,
        };
        let decoded = match escape {
            Some(plain @ ('\\' | '"' | '/' | ' ')) => Some(plain),
            Some('n') => Some('\n'),
            Some('t') => Some('\t'),
            Some('x' | 'u' | 'U') => {
                let code = (0..digits).try_fold(0_u32, |code, _| {
                    let digit = symbols.next().and_then(|(_, symbol)| symbol.to_digit(16))?;
                    Some((code << 4) | digit)
                });
                code.and_then(char::from_u32)
            }
            _ => None,
        };
        let Some(decoded) = decoded else {
            let found = quote(&line[at..]);
            return Err(FormatError::unexpected(position(number, line, at), found, "an escape"));
        };
        text.push(decoded);
    }
    let at = position(number, line, start);
    Err(FormatError::unexpected(at, "a quote that is not closed", format!("`{mark}`")))
}
