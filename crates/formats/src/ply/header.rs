//! The header: what the body will hold.

use crate::FormatError;
use crate::error::{Position, quote};
use crate::lexer::Lexer;

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Numbers as text.
    Ascii,
    /// Bytes, the least significant first.
    LittleEndian,
    /// Bytes, the most significant first.
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// 8 bits, signed.
    I8,
    /// 8 bits.
    U8,
    /// 16 bits, signed.
    I16,
    /// 16 bits.
    U16,
    /// 32 bits, signed.
    I32,
    /// 32 bits.
    U32,
    /// 32 bits, floating.
    F32,
    /// 64 bits, floating.
    F64,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes that a number takes.
    pub const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    const fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// One property of an element: a number, or a count and that many numbers.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) count: Option<Scalar>,
    pub(super) scalar: Scalar,
}

#[derive(Clone, Debug)]
pub(super) struct Declared {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Declared>,
    /// Where the body starts, bytes.
    pub(super) body: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

/// The end of the header: the byte after the line that says so, and the number of its lines.
fn end_of_header(bytes: &[u8]) -> Option<(usize, usize)> {
    let mut start = 0;
    for line in 1.. {
        let rest = bytes.get(start..)?;
        let length = rest.iter().position(|&byte| byte == b'\n')?;
        if rest[..length].trim_ascii() == b"end_header" {
            return Some((start + length + 1, line));
        }
        start += length + 1;
    }
    None
}

pub(super) fn read(bytes: &[u8]) -> Result<Header, FormatError> {
    let first = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    if first.trim_ascii() != b"ply" {
        let found = quote(&String::from_utf8_lossy(&first[..first.len().min(60)]));
        let at = Position::Line { line: 1, column: 1 };
        return Err(FormatError::unexpected(at, found, "`ply`"));
    }
    let Some((body, lines)) = end_of_header(bytes) else {
        let at = Position::Byte(bytes.len());
        return Err(FormatError::unexpected(at, "the end of the file", "`end_header`"));
    };
    let mut lexer = Lexer::new(&bytes[..body]);
    let mut encoding = None;
    let mut elements: Vec<Declared> = Vec::new();
    while lexer.next_line() {
        let mark = lexer.mark();
        match lexer.word() {
            b"ply" | b"comment" | b"obj_info" | b"end_header" => {}
            b"format" => {
                let mark = lexer.mark();
                encoding = Some(match lexer.word() {
                    b"ascii" => Encoding::Ascii,
                    b"binary_little_endian" => Encoding::LittleEndian,
                    b"binary_big_endian" => Encoding::BigEndian,
                    other => return Err(refused(&lexer, mark, other, "`ascii` or `binary_..`")),
                });
            }
            b"element" => {
                let name = String::from_utf8_lossy(lexer.word()).into_owned();
                let count = lexer.id("the number of elements")?;
                // No element takes less than a byte, so that more cannot be there.
                let limit = bytes.len() as u64;
                if count > limit {
                    let at = lexer.position_of(mark);
                    let expected = format!("at most {limit}, the bytes of the file");
                    return Err(FormatError::unexpected(at, format!("{count} {name}"), expected));
                }
                elements.push(Declared { name, count: count as usize, properties: Vec::new() });
            }
            b"property" => {
                let property = property(&mut lexer)?;
                let Some(element) = elements.last_mut() else {
                    return Err(refused(&lexer, mark, b"property", "`element` before `property`"));
                };
                element.properties.push(property);
            }
            other => return Err(refused(&lexer, mark, other, "a line of a PLY header")),
        }
    }
    let Some(encoding) = encoding else {
        let at = Position::Line { line: lines, column: 1 };
        return Err(FormatError::unexpected(at, "`end_header`", "a line `format` before it"));
    };
    Ok(Header { encoding, elements, body, lines })
}

fn refused(lexer: &Lexer<'_>, mark: usize, found: &[u8], expected: &str) -> FormatError {
    let found = quote(&String::from_utf8_lossy(found));
    FormatError::unexpected(lexer.position_of(mark), found, expected)
}

fn scalar(lexer: &mut Lexer<'_>) -> Result<Scalar, FormatError> {
    lexer.at_end_of_line();
    let mark = lexer.mark();
    let word = lexer.word();
    Scalar::named(word).ok_or_else(|| refused(lexer, mark, word, "the type of a number"))
}

fn property(lexer: &mut Lexer<'_>) -> Result<Property, FormatError> {
    lexer.at_end_of_line();
    let mark = lexer.mark();
    let word = lexer.word();
    let (count, scalar) = if word == b"list" {
        let count_mark = lexer.mark();
        let count = self::scalar(lexer)?;
        if !count.is_integer() {
            return Err(refused(lexer, count_mark, b"float", "an integer type for a length"));
        }
        (Some(count), self::scalar(lexer)?)
    } else {
        let named = Scalar::named(word);
        (None, named.ok_or_else(|| refused(lexer, mark, word, "a type, or `list`"))?)
    };
    let name = String::from_utf8_lossy(lexer.word()).into_owned();
    Ok(Property { name, count, scalar })
}
