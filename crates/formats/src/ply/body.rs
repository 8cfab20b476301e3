//! The body: columns of numbers.

use super::header::{self, Declared, Encoding, Property, Scalar};
use crate::FormatError;
use crate::error::Position;
use crate::lexer::Lexer;

/// One property of all elements of a kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name of the property.
    pub name: String,
    /// Where the numbers of each element end in `values`; empty where each element has one number.
    pub ends: Vec<usize>,
    /// The numbers; not finite where the file says so.
    pub values: Vec<f64>,
}

impl Column {
    /// The numbers of one element.
    pub fn row(&self, index: usize) -> &[f64] {
        if self.ends.is_empty() {
            return self.values.get(index..=index).unwrap_or_default();
        }
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.values[start..self.ends[index]]
    }
}

/// All elements of a kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Name of the kind: `vertex`, `face`, ...
    pub name: String,
    /// How many there are.
    pub count: usize,
    /// Their properties.
    pub columns: Vec<Column>,
    /// Where each element starts: a line for text, a byte otherwise.
    places: Vec<u64>,
    is_text: bool,
}

impl Element {
    /// The property of that name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// Where an element stands in the file.
    pub fn position(&self, index: usize) -> Position {
        let place = self.places.get(index).copied().unwrap_or_default() as usize;
        if self.is_text { Position::Line { line: place, column: 1 } } else { Position::Byte(place) }
    }
}

/// What a PLY file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Ply {
    /// How the body was written.
    pub encoding: Encoding,
    /// The elements in the order of the file.
    pub elements: Vec<Element>,
}

impl Ply {
    /// The elements of that name.
    pub fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

/// Where the numbers come from.
enum Source<'a> {
    Text(Lexer<'a>),
    Bytes { bytes: &'a [u8], at: usize, little: bool },
}

/// Reads a PLY file; bytes after the last element are passed over. Linear in the bytes.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column in the header and in text, with the byte offset
/// in bytes.
pub fn read(bytes: &[u8]) -> Result<Ply, FormatError> {
    let header = header::read(bytes)?;
    let is_text = header.encoding == Encoding::Ascii;
    let mut source = match header.encoding {
        Encoding::Ascii => {
            let mut lexer = Lexer::new(bytes);
            for _ in 0..header.lines {
                lexer.next_raw_line();
            }
            Source::Text(lexer)
        }
        encoding => {
            Source::Bytes { bytes, at: header.body, little: encoding == Encoding::LittleEndian }
        }
    };
    let elements = (header.elements.into_iter())
        .map(|declared| source.element(declared, is_text))
        .collect::<Result<_, _>>()?;
    Ok(Ply { encoding: header.encoding, elements })
}

impl Source<'_> {
    fn element(&mut self, declared: Declared, is_text: bool) -> Result<Element, FormatError> {
        let Declared { name, count, properties } = declared;
        let empty = |property: &Property| Column {
            name: property.name.clone(),
            ends: Vec::new(),
            values: Vec::new(),
        };
        let mut columns: Vec<Column> = properties.iter().map(empty).collect();
        let mut places = Vec::new();
        // An element without properties takes no bytes: its count says nothing.
        for index in 0..if properties.is_empty() { 0 } else { count } {
            places.push(self.begin(&name, index, count)?);
            for (property, column) in properties.iter().zip(&mut columns) {
                let length = match property.count {
                    Some(scalar) => self.length(scalar)?,
                    None => 1,
                };
                for _ in 0..length {
                    column.values.push(self.number(property.scalar)?);
                }
                if property.count.is_some() {
                    column.ends.push(column.values.len());
                }
            }
        }
        Ok(Element { name, count, columns, places, is_text })
    }

    /// Goes to the next element; where it stands.
    fn begin(&mut self, name: &str, index: usize, count: usize) -> Result<u64, FormatError> {
        match self {
            Self::Text(lexer) => {
                if !lexer.next_line() {
                    return Err(lexer.unexpected(&format!("{name} {index} of {count}")));
                }
                Ok(lexer.line() as u64)
            }
            Self::Bytes { at, .. } => Ok(*at as u64),
        }
    }

    fn length(&mut self, scalar: Scalar) -> Result<usize, FormatError> {
        let at = self.position();
        let (length, left) = (self.number(scalar)?, self.left());
        if length < 0.0 || length > left as f64 || length.fract() != 0.0 {
            let expected = format!("a length from 0 to {left}, the bytes that are left");
            return Err(FormatError::unexpected(at, length.to_string(), expected));
        }
        Ok(length as usize)
    }

    fn position(&mut self) -> Position {
        match self {
            Self::Text(lexer) => {
                lexer.at_end_of_line();
                lexer.position_of(lexer.mark())
            }
            Self::Bytes { at, .. } => Position::Byte(*at),
        }
    }

    fn left(&self) -> usize {
        match self {
            Self::Text(lexer) => lexer.left(),
            Self::Bytes { bytes, at, .. } => bytes.len() - at,
        }
    }

    fn number(&mut self, scalar: Scalar) -> Result<f64, FormatError> {
        match self {
            Self::Text(lexer) => lexer.any_float("a number"),
            Self::Bytes { bytes, at, little } => {
                let Some(taken) = bytes.get(*at..*at + scalar.size()) else {
                    let found = "the end of the file";
                    let expected = format!("a number of {} bytes", scalar.size());
                    return Err(FormatError::unexpected(Position::Byte(*at), found, expected));
                };
                *at += scalar.size();
                let mut raw = [0; 8];
                raw[..taken.len()].copy_from_slice(taken);
                if !*little {
                    raw[..taken.len()].reverse();
                }
                Ok(value(scalar, raw))
            }
        }
    }
}

/// The number whose bytes, the least significant first, stand at the start of `raw`.
fn value(scalar: Scalar, raw: [u8; 8]) -> f64 {
    let [a, b, c, d, ..] = raw;
    match scalar {
        Scalar::I8 => f64::from(a as i8),
        Scalar::U8 => f64::from(a),
        Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
        Scalar::U16 => f64::from(u16::from_le_bytes([a, b])),
        Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Scalar::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Scalar::F64 => f64::from_le_bytes(raw),
    }
}
