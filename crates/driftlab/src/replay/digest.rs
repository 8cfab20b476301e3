//! What was read of a file, told by content while it passes by.

use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::run::Input;

/// A reader that counts and digests what it hands on.
pub(super) struct Digesting<R> {
    inner: R,
    bytes: u64,
    digest: Sha256,
}

impl<R: Read> Digesting<R> {
    pub fn new(inner: R) -> Self {
        Self { inner, bytes: 0, digest: Sha256::new() }
    }

    /// The note of the file; all of it must have passed by.
    pub fn into_input(self, path: &Path) -> Input {
        let sha256 = self.digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Input { path: path.display().to_string(), bytes: self.bytes, sha256 }
    }
}

impl<R: Read> Read for Digesting<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        self.digest.update(&buffer[..count]);
        self.bytes += count as u64;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_passed_by_is_noted_as_if_read_at_once() {
        let content = vec![7_u8; 100_000];
        let mut digesting = Digesting::new(&content[..]);
        io::copy(&mut digesting, &mut io::sink()).expect("memory");
        assert_eq!(digesting.into_input(Path::new("a")), Input::new(Path::new("a"), &content));
    }
}
