//! Protocol buffers: the fields of a message, from bytes and back.
//!
//! Written here and not taken from `prost`: its derive builds every list before it can be bounded, and
//! a scan would be copied once more. Seven message types do not need more than varints and lengths.

use super::Malformed;

/// The value of a field, by how it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value<'a> {
    /// A whole number, a truth value or a constant of an enumeration.
    Varint(u64),
    /// Eight bytes, mostly a double.
    Fixed64([u8; 8]),
    /// A text, bytes, a message, or numbers without tags.
    Bytes(&'a [u8]),
    /// Four bytes.
    Fixed32([u8; 4]),
}

/// One field of a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Field<'a> {
    /// Its number.
    pub number: u32,
    /// Its value.
    pub value: Value<'a>,
    /// Bytes from the start of the outermost message.
    pub at: usize,
}

impl<'a> Field<'a> {
    /// A double.
    pub(crate) fn double(&self) -> Result<f64, Malformed> {
        match self.value {
            Value::Fixed64(bytes) => Ok(f64::from_le_bytes(bytes)),
            _ => self.malformed("a field of another type than a double"),
        }
    }

    /// Four bytes, as they stand.
    pub(crate) fn fixed32(&self) -> Result<u32, Malformed> {
        match self.value {
            Value::Fixed32(bytes) => Ok(u32::from_le_bytes(bytes)),
            _ => self.malformed("a field of another type than fixed32"),
        }
    }

    /// A whole number.
    pub(crate) fn varint(&self) -> Result<u64, Malformed> {
        match self.value {
            Value::Varint(number) => Ok(number),
            _ => self.malformed("a field of another type than a whole number"),
        }
    }

    /// Bytes.
    pub(crate) fn bytes(&self) -> Result<&'a [u8], Malformed> {
        match self.value {
            Value::Bytes(bytes) => Ok(bytes),
            _ => self.malformed("a field of another type than bytes"),
        }
    }

    /// A text.
    pub(crate) fn text(&self) -> Result<&'a str, Malformed> {
        let text = std::str::from_utf8(self.bytes()?);
        text.or_else(|_| self.malformed("a text that is no UTF-8"))
    }

    /// The fields of a message inside this one.
    pub(crate) fn message(&self) -> Result<Fields<'a>, Malformed> {
        let bytes = self.bytes()?;
        Ok(Fields { bytes, at: 0, origin: self.at })
    }

    /// Appends a repeated double, with or without tags; `most` bounds the list.
    pub(crate) fn doubles(&self, list: &mut Vec<f64>, most: usize) -> Result<(), Malformed> {
        let (many, rest) = match &self.value {
            Value::Bytes(bytes) => bytes.as_chunks::<8>(),
            Value::Fixed64(one) => (std::slice::from_ref(one), &[][..]),
            _ => return self.malformed("a field of another type than doubles"),
        };
        if !rest.is_empty() {
            return self.malformed("a list of doubles that ends within one");
        }
        if list.len() + many.len() > most {
            return self.malformed("more numbers than a list here may have");
        }
        list.extend(many.iter().map(|&eight| f64::from_le_bytes(eight)));
        Ok(())
    }

    /// A complaint about this field.
    pub(crate) fn malformed<T>(&self, found: &'static str) -> Result<T, Malformed> {
        Err(Malformed { at: self.at, found })
    }
}

/// Walks over the fields of a message.
pub(crate) struct Fields<'a> {
    bytes: &'a [u8],
    at: usize,
    origin: usize,
}

impl<'a> Fields<'a> {
    /// The fields of a whole message.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, origin: 0 }
    }

    /// The next field; `None` at the end of the message.
    pub(crate) fn next_field(&mut self) -> Result<Option<Field<'a>>, Malformed> {
        if self.at == self.bytes.len() {
            return Ok(None);
        }
        let at = self.origin + self.at;
        let tag = self.varint()?;
        let number = u32::try_from(tag >> 3).unwrap_or(0);
        if number == 0 {
            return Err(Malformed { at, found: "a field without a number" });
        }
        let value = match tag & 7 {
            0 => Value::Varint(self.varint()?),
            1 => Value::Fixed64(self.array()?),
            2 => {
                let length = usize::try_from(self.varint()?).unwrap_or(usize::MAX);
                Value::Bytes(self.take(length)?)
            }
            5 => Value::Fixed32(self.array()?),
            _ => return Err(Malformed { at, found: "a field of an unknown kind" }),
        };
        let at = match value {
            Value::Bytes(bytes) => self.origin + self.at - bytes.len(),
            _ => at,
        };
        Ok(Some(Field { number, value, at }))
    }

    fn varint(&mut self) -> Result<u64, Malformed> {
        let mut number = 0_u64;
        for shift in (0..64).step_by(7) {
            let [byte] = self.array()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(Malformed { at: self.origin + self.at, found: "a whole number of more than ten bytes" })
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], Malformed> {
        let Some(taken) = self.bytes[self.at..].get(..length) else {
            let at = self.origin + self.at;
            return Err(Malformed { at, found: "a field that is longer than its message" });
        };
        self.at += length;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Malformed> {
        let Some(array) = self.bytes[self.at..].first_chunk::<N>() else {
            let at = self.origin + self.at;
            return Err(Malformed { at, found: "the end of the message within a field" });
        };
        self.at += N;
        Ok(*array)
    }
}

/// Writes the fields of a message; what is zero or empty is left out, as the third version has it.
#[derive(Debug, Default)]
pub(crate) struct Writer {
    /// What was written so far.
    pub bytes: Vec<u8>,
}

impl Writer {
    /// A whole number.
    pub(crate) fn varint(&mut self, number: u32, value: u64) -> &mut Self {
        if value != 0 {
            self.raw_varint(u64::from(number) << 3);
            self.raw_varint(value);
        }
        self
    }

    /// A double; minus zero is written, so that it comes back.
    pub(crate) fn double(&mut self, number: u32, value: f64) -> &mut Self {
        if value.to_bits() != 0 {
            self.raw_varint(u64::from(number) << 3 | 1);
            self.bytes.extend(value.to_le_bytes());
        }
        self
    }

    /// Doubles without tags.
    pub(crate) fn doubles(&mut self, number: u32, values: &[f64]) -> &mut Self {
        if !values.is_empty() {
            self.raw_varint(u64::from(number) << 3 | 2);
            self.raw_varint(values.len() as u64 * 8);
            self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        }
        self
    }

    /// A text.
    pub(crate) fn text(&mut self, number: u32, text: &str) -> &mut Self {
        self.blob(number, text.as_bytes())
    }

    /// Bytes.
    pub(crate) fn blob(&mut self, number: u32, bytes: &[u8]) -> &mut Self {
        if !bytes.is_empty() {
            self.raw_varint(u64::from(number) << 3 | 2);
            self.raw_varint(bytes.len() as u64);
            self.bytes.extend_from_slice(bytes);
        }
        self
    }

    /// A message inside this one; an empty one is written too: it is there.
    pub(crate) fn message(&mut self, number: u32, write: impl FnOnce(&mut Self)) -> &mut Self {
        let mut inner = Self::default();
        write(&mut inner);
        self.raw_varint(u64::from(number) << 3 | 2);
        self.raw_varint(inner.bytes.len() as u64);
        self.bytes.append(&mut inner.bytes);
        self
    }

    fn raw_varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_reads_back() {
        let mut writer = Writer::default();
        writer.varint(1, 300).double(2, -0.0).text(3, "odom").doubles(4, &[1.0, 2.0]);
        writer.message(5, |inner| _ = inner.double(1, 0.5)).varint(6, 0);
        writer.bytes.extend([7 << 3 | 5, 9, 0, 0, 0]);
        let mut fields = Fields::new(&writer.bytes);
        let mut next = || fields.next_field().expect("readable").expect("a field");
        assert_eq!(next().varint(), Ok(300));
        assert_eq!(next().double().map(f64::to_bits), Ok((-0.0_f64).to_bits()));
        assert_eq!(next().text(), Ok("odom"));
        let mut list = Vec::new();
        let field = next();
        field.doubles(&mut list, 2).expect("two doubles");
        assert_eq!(list, [1.0, 2.0]);
        assert!(field.doubles(&mut list, 3).is_err());
        let inner = next().message().expect("a message").next_field().expect("readable");
        assert_eq!(inner.map(|field| field.double()), Some(Ok(0.5)));
        assert_eq!(next().fixed32(), Ok(9));
        assert_eq!(fields.next_field(), Ok(None));
    }

    #[test]
    fn broken_fields_are_located() {
        let told = |bytes: &[u8]| {
            let mut fields = Fields::new(bytes);
            loop {
                match fields.next_field() {
                    Ok(Some(_)) => {}
                    Ok(None) => return None,
                    Err(error) => return Some((error.at, error.found)),
                }
            }
        };
        assert_eq!(
            told(&[0x08, 1, 0x0a, 5, 1]),
            Some((4, "a field that is longer than its message"))
        );
        assert_eq!(told(&[0x09, 1]), Some((1, "the end of the message within a field")));
        assert_eq!(told(&[0xff; 20]), Some((10, "a whole number of more than ten bytes")));
        assert_eq!(told(&[0x0b]), Some((0, "a field of an unknown kind")));
        assert_eq!(told(&[0x00, 0]), Some((0, "a field without a number")));
        assert_eq!(told(&[]), None);
    }
}
