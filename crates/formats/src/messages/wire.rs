//! Numbers and texts of ROS messages, from bytes.
//!
//! ROS 2 writes CDR: four bytes that say the order of bytes, then values that stand at multiples of
//! their own size, counted from behind those four. ROS 1 writes the same values little-endian and
//! without gaps. Texts of CDR end with a zero that counts as part of them.

use super::Malformed;

/// How values are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// Little-endian, without gaps.
    Ros1,
    /// Common data representation, versions 1 and 2, plain.
    Cdr,
}

/// A place in a message.
pub(crate) struct Wire<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Where alignment is counted from.
    origin: usize,
    /// The largest multiple that a value is aligned to; 1 for no gaps.
    alignment: usize,
    big_endian: bool,
    pub(crate) layout: Layout,
}

macro_rules! number {
    ($name:ident, $type:ty) => {
        pub(crate) fn $name(&mut self) -> Result<$type, Malformed> {
            const SIZE: usize = size_of::<$type>();
            self.align(SIZE);
            let bytes = self.array::<SIZE>()?;
            Ok(if self.big_endian {
                <$type>::from_be_bytes(bytes)
            } else {
                <$type>::from_le_bytes(bytes)
            })
        }
    };
}

impl<'a> Wire<'a> {
    /// The values of a message.
    pub(crate) fn new(bytes: &'a [u8], layout: Layout) -> Result<Self, Malformed> {
        if layout == Layout::Ros1 {
            return Ok(Self { bytes, at: 0, origin: 0, alignment: 1, big_endian: false, layout });
        }
        let Some(&[high, kind, _, _]) = bytes.first_chunk::<4>() else {
            return Err(Malformed { at: 0, found: "less than the four bytes before CDR" });
        };
        let (big_endian, alignment) = match (high, kind) {
            (0, 0) => (true, 8),
            (0, 1) => (false, 8),
            (0, 6) => (true, 4),
            (0, 7) => (false, 4),
            _ => return Err(Malformed { at: 0, found: "CDR with lists of parameters, not plain" }),
        };
        Ok(Self { bytes, at: 4, origin: 4, alignment, big_endian, layout })
    }

    number!(u8, u8);
    number!(u32, u32);
    number!(i32, i32);
    number!(f32, f32);
    number!(f64, f64);

    /// Bytes from the start of the message.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// A complaint about the place where the reader stands.
    pub(crate) fn malformed<T>(&self, found: &'static str) -> Result<T, Malformed> {
        Err(Malformed { at: self.at, found })
    }

    /// Numbers of a fixed count.
    pub(crate) fn floats<const N: usize>(&mut self) -> Result<[f64; N], Malformed> {
        let mut floats = [0.0; N];
        for float in &mut floats {
            *float = self.f64()?;
        }
        Ok(floats)
    }

    /// Steps over `count` values of `size` bytes each.
    pub(crate) fn skip(&mut self, count: usize, size: usize) -> Result<(), Malformed> {
        self.align(size);
        self.take(count.saturating_mul(size)).map(|_| ())
    }

    /// The count before a list.
    pub(crate) fn count(&mut self) -> Result<usize, Malformed> {
        self.u32().map(|count| count as usize)
    }

    /// A text; what is no UTF-8 is refused.
    pub(crate) fn text(&mut self) -> Result<&'a str, Malformed> {
        let at = self.at;
        let length = self.count()?;
        let mut bytes = self.take(length)?;
        if self.layout == Layout::Cdr {
            bytes = bytes.strip_suffix(b"\0").unwrap_or(bytes);
        }
        std::str::from_utf8(bytes).map_err(|_| Malformed { at, found: "a text that is no UTF-8" })
    }

    /// The bytes of a list of bytes.
    pub(crate) fn blob(&mut self) -> Result<&'a [u8], Malformed> {
        let length = self.count()?;
        self.take(length)
    }

    /// A list of `f32`, widened; memory is asked for once all of it is known to be there.
    pub(crate) fn widened(&mut self, most: usize) -> Result<Vec<f64>, Malformed> {
        let count = self.count()?;
        if count > most {
            return self.malformed("more numbers than a list here may have");
        }
        let bytes = self.take(count.saturating_mul(4))?;
        let (floats, _) = bytes.as_chunks::<4>();
        Ok(if self.big_endian {
            floats.iter().map(|&four| f64::from(f32::from_be_bytes(four))).collect()
        } else {
            floats.iter().map(|&four| f64::from(f32::from_le_bytes(four))).collect()
        })
    }

    fn align(&mut self, size: usize) {
        let size = size.min(self.alignment);
        self.at = self.origin + (self.at - self.origin).next_multiple_of(size);
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], Malformed> {
        let rest = self.bytes.get(self.at..).unwrap_or(&[]);
        let Some(taken) = rest.get(..length) else {
            return self.malformed("the end of the message in the middle of a value");
        };
        self.at += length;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Malformed> {
        let at = self.at;
        let short = Malformed { at, found: "the end of the message in the middle of a value" };
        let rest = self.bytes.get(at..).ok_or(short)?;
        let array = *rest.first_chunk::<N>().ok_or(short)?;
        self.at += N;
        Ok(array)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cdr_aligns_and_swaps() {
        let little = [0, 1, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f];
        let mut wire = Wire::new(&little, Layout::Cdr).expect("plain CDR");
        assert_eq!((wire.u8(), wire.f64()), (Ok(7), Ok(1.0)));
        let end = "the end of the message in the middle of a value";
        assert_eq!(wire.u8(), Err(Malformed { at: 20, found: end }));
        // The second version aligns doubles to four bytes only.
        let big = [0, 6, 0, 0, 0, 0, 0, 2, b'a', 0, 9, 9, 0x3f, 0xf0, 0, 0, 0, 0, 0, 0];
        let mut wire = Wire::new(&big, Layout::Cdr).expect("plain CDR");
        assert_eq!((wire.text(), wire.f64()), (Ok("a"), Ok(1.0)));
        assert!(Wire::new(&[0, 3, 0, 0], Layout::Cdr).is_err());
        assert!(Wire::new(&[0, 1], Layout::Cdr).is_err());
    }

    #[test]
    fn counts_are_held_against_what_is_there() {
        let bytes = [0xff, 0xff, 0xff, 0xff, 0, 0];
        let wire = || Wire::new(&bytes, Layout::Ros1).expect("no header");
        assert!(wire().text().is_err() && wire().blob().is_err());
        assert!(wire().widened(usize::MAX).is_err() && wire().widened(10).is_err());
        assert!(wire().skip(usize::MAX, 8).is_err());
    }
}
