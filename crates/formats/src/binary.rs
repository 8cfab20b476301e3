//! Files that are no text at all, told by their first bytes.

use crate::FormatError;
use crate::error::Position;

/// What compressed and archived files start with, what they are, and what makes text of them.
const PACKED: [(&[u8], &str); 6] = [
    (b"\x1f\x8b", "a gzip-compressed file (decompress it first: gunzip)"),
    (b"\x28\xb5\x2f\xfd", "a zstd-compressed file (decompress it first: unzstd)"),
    (b"\xfd7zXZ\0", "an xz-compressed file (decompress it first: unxz)"),
    (b"BZh", "a bzip2-compressed file (decompress it first: bunzip2)"),
    (b"PK\x03\x04", "a zip archive (unpack it first: unzip)"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive (unpack it first)"),
];

/// The bytes at the start in which a zero tells that this is no text.
const LOOKED_AT: usize = 1 << 10;

/// Refuses bytes that are no text.
///
/// # Errors
/// [`FormatError::Unexpected`] at byte 0 for a compressed file or an archive, else at the first zero among
/// the first bytes, which no text holds.
pub(crate) fn refuse_binary(bytes: &[u8], expected: &str) -> Result<(), FormatError> {
    if let Some((_, found)) = PACKED.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Err(FormatError::unexpected(Position::Byte(0), *found, expected));
    }
    match bytes.iter().take(LOOKED_AT).position(|&byte| byte == 0) {
        Some(at) => {
            let found = "a zero byte, so no text";
            Err(FormatError::unexpected(Position::Byte(at), found, expected))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_is_named_and_other_bytes_are_located() {
        let told = |bytes: &[u8]| refuse_binary(bytes, "text").err().map(|error| error.to_string());
        let gzip =
            "byte 0: found a gzip-compressed file (decompress it first: gunzip), expected text";
        assert_eq!(told(b"\x1f\x8b\x08\0\0").as_deref(), Some(gzip));
        let zero = "byte 2: found a zero byte, so no text, expected text";
        assert_eq!(told(b"ab\0c").as_deref(), Some(zero));
        for text in [&b""[..], b"VERTEX_SE2 0 0 0 0\n", b"\xff\xfe"] {
            assert_eq!(told(text), None);
        }
    }
}
