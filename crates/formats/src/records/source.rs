//! Bytes of a file as they come, with the place of each.

use std::io::{BufReader, ErrorKind, Read};

/// How many bytes are asked for at once.
const STEP: usize = 16 << 20;

/// Why no more could be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Stopped {
    /// The file ends; so many bytes of what was asked for were there.
    End(usize),
    /// The file cannot be read on.
    Failed(String),
}

/// A file that is read from start to end.
#[derive(Debug)]
pub(crate) struct Source<R> {
    inner: BufReader<R>,
    at: u64,
}

impl<R: Read> Source<R> {
    pub(crate) fn new(inner: R) -> Self {
        Self { inner: BufReader::with_capacity(1 << 16, inner), at: 0 }
    }

    /// Bytes from the start of the file.
    pub(crate) fn at(&self) -> u64 {
        self.at
    }

    /// Fills an array.
    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], Stopped> {
        let mut array = [0; N];
        let mut filled = 0;
        while filled < N {
            match self.inner.read(&mut array[filled..]) {
                Ok(0) => return Err(Stopped::End(filled)),
                Ok(count) => {
                    filled += count;
                    self.at += count as u64;
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(Stopped::Failed(error.to_string())),
            }
        }
        Ok(array)
    }

    /// Puts the next `length` bytes into `body`; memory grows with what is really there.
    pub(crate) fn body(&mut self, length: usize, body: &mut Vec<u8>) -> Result<(), Stopped> {
        body.clear();
        while body.len() < length {
            let step = (length - body.len()).min(STEP);
            body.reserve_exact(step);
            let read = self.inner.by_ref().take(step as u64).read_to_end(body);
            match read {
                Ok(count) if count == step => self.at += count as u64,
                Ok(count) => {
                    self.at += count as u64;
                    return Err(Stopped::End(body.len()));
                }
                Err(error) => return Err(Stopped::Failed(error.to_string())),
            }
        }
        Ok(())
    }

    /// Steps over bytes.
    pub(crate) fn skip(&mut self, length: u64) -> Result<(), Stopped> {
        let copied = std::io::copy(&mut self.inner.by_ref().take(length), &mut std::io::sink());
        match copied {
            Ok(count) => {
                self.at += count;
                if count == length { Ok(()) } else { Err(Stopped::End(count as usize)) }
            }
            Err(error) => Err(Stopped::Failed(error.to_string())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_ends_are_told() {
        let mut source = Source::new(&b"abcdefgh"[..]);
        assert_eq!(source.array::<2>(), Ok(*b"ab"));
        let mut body = Vec::new();
        assert_eq!((source.body(3, &mut body), &body[..]), (Ok(()), &b"cde"[..]));
        assert_eq!((source.skip(1), source.at()), (Ok(()), 6));
        assert_eq!(source.body(usize::MAX, &mut body), Err(Stopped::End(2)));
        assert_eq!((source.array::<1>(), source.at()), (Err(Stopped::End(0)), 8));
        assert_eq!(source.skip(1), Err(Stopped::End(0)));
    }
}
