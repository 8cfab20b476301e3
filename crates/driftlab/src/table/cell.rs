//! One value of a table.

use serde_json::Value;

/// One value of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// Nothing to tell.
    Null,
    /// Yes or no.
    Flag(bool),
    /// A count.
    Count(u64),
    /// A measured number.
    Number(f64),
    /// A name.
    Text(String),
}

impl Cell {
    /// The value as a text that [`decode`](Self::decode) reads back, numbers bit for bit.
    ///
    /// Counts are digits alone, numbers never are, texts are in quotes, and nothing is empty.
    pub(crate) fn encode(&self) -> String {
        match self {
            Self::Null => String::new(),
            Self::Flag(flag) => flag.to_string(),
            Self::Count(count) => count.to_string(),
            Self::Number(number) => format!("{number:?}"),
            Self::Text(text) => format!("\"{text}"),
        }
    }

    /// What [`encode`](Self::encode) wrote; `None` for any other text.
    pub(crate) fn decode(text: &str) -> Option<Self> {
        if let Some(text) = text.strip_prefix('"') {
            return Some(Self::Text(text.to_owned()));
        }
        Some(match text {
            "" => Self::Null,
            "true" => Self::Flag(true),
            "false" => Self::Flag(false),
            digits if digits.bytes().all(|byte| byte.is_ascii_digit()) => {
                Self::Count(digits.parse().ok()?)
            }
            number => Self::Number(number.parse().ok()?),
        })
    }

    /// The value of a report; lists and objects become text.
    pub(crate) fn from_json(value: &Value) -> Self {
        match value {
            Value::Null => Self::Null,
            Value::Bool(flag) => Self::Flag(*flag),
            Value::Number(number) => match number.as_u64() {
                Some(count) => Self::Count(count),
                None => number.as_f64().map_or(Self::Null, Self::Number),
            },
            Value::String(text) => Self::Text(text.clone()),
            other => Self::Text(other.to_string()),
        }
    }

    /// The value of a config; lists and tables become text.
    pub(crate) fn from_toml(value: &toml::Value) -> Self {
        match value {
            toml::Value::Boolean(flag) => Self::Flag(*flag),
            toml::Value::Integer(number) => {
                u64::try_from(*number).map_or(Self::Number(*number as f64), Self::Count)
            }
            toml::Value::Float(number) => Self::Number(*number),
            toml::Value::String(text) => Self::Text(text.clone()),
            other => Self::Text(other.to_string()),
        }
    }

    /// The same in JSON; numbers that JSON cannot write are null.
    pub(crate) fn to_json(&self) -> Value {
        match self {
            Self::Null => Value::Null,
            Self::Flag(flag) => (*flag).into(),
            Self::Count(count) => (*count).into(),
            Self::Number(number) => (*number).into(),
            Self::Text(text) => text.as_str().into(),
        }
    }

    /// As a number: flags are 0 and 1, texts are none.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Flag(flag) => Some(f64::from(u8::from(*flag))),
            Self::Count(count) => Some(*count as f64),
            Self::Number(number) => Some(*number),
            Self::Null | Self::Text(_) => None,
        }
    }

    /// As people read it; nothing is empty.
    pub(crate) fn shown(&self) -> String {
        match self {
            Self::Null => String::new(),
            Self::Flag(flag) => flag.to_string(),
            Self::Count(count) => count.to_string(),
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text.clone(),
        }
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_comes_back_bit_for_bit() {
        let numbers = [0.0, -0.0, 0.1 + 0.2, 1e300, f64::MIN_POSITIVE, 5e-324, f64::INFINITY, 7.0];
        let mut cells = vec![
            Cell::Null,
            Cell::Flag(true),
            Cell::Flag(false),
            Cell::Count(0),
            Cell::Count(u64::MAX),
            Cell::Text(String::new()),
            Cell::Text("true".into()),
            Cell::Text("12 \"x\"\n".into()),
        ];
        cells.extend(numbers.map(Cell::Number));
        for cell in cells {
            let back = Cell::decode(&cell.encode()).expect("our own text");
            assert_eq!(back, cell);
            if let (Cell::Number(back), Cell::Number(number)) = (back, cell) {
                assert_eq!(back.to_bits(), number.to_bits());
            }
        }
        let nan = Cell::decode(&Cell::Number(f64::NAN).encode()).and_then(|cell| cell.number());
        assert!(nan.is_some_and(f64::is_nan));
        assert_eq!(Cell::decode("much"), None);
        assert_eq!(Cell::decode("99999999999999999999"), None);
    }
}
