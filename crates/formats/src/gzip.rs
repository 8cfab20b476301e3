//! Files packed with gzip.

use std::borrow::Cow;
use std::io::Read;

use flate2::bufread::MultiGzDecoder;

use crate::FormatError;
use crate::error::Position;

/// What a packed byte may grow to before the file is refused: text packs by ten, hardly ever by more.
const GROWTH: u64 = 200;

/// Bytes that any file may grow to, whatever it packs.
const ALWAYS: u64 = 1 << 20;

/// The bytes of a file, unpacked where they start as gzip does; borrowed where they do not.
///
/// # Errors
/// [`FormatError::Unexpected`] where the stream is damaged or ends too early, with the byte of the
/// unpacked file up to which it could be read; [`FormatError::TooLarge`] where it grows to more than
/// 200 times its size and 1 MiB, checked before that is held in memory.
pub fn unpack(bytes: &[u8]) -> Result<Cow<'_, [u8]>, FormatError> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(Cow::Borrowed(bytes));
    }
    let limit = (bytes.len() as u64).saturating_mul(GROWTH).saturating_add(ALWAYS);
    let mut unpacked = Vec::new();
    let read = MultiGzDecoder::new(bytes).take(limit + 1).read_to_end(&mut unpacked);
    if unpacked.len() as u64 > limit {
        let at = Position::Byte(0);
        return Err(FormatError::TooLarge { at, columns: limit + 1, rows: 1, limit });
    }
    match read {
        Ok(_) => Ok(Cow::Owned(unpacked)),
        Err(error) => Err(FormatError::unexpected(
            Position::Byte(unpacked.len()),
            format!("{error} (byte of the unpacked file)"),
            "a whole gzip stream",
        )),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(bytes).expect("memory takes all");
        encoder.finish().expect("memory takes all")
    }

    #[test]
    fn what_is_packed_comes_back_and_the_rest_stays() {
        let text = b"FLASER 3 1 2 3\n".repeat(1000);
        assert_eq!(*unpack(&packed(&text)).expect("whole"), *text);
        assert!(matches!(unpack(b"FLASER"), Ok(Cow::Borrowed(b"FLASER"))));
        assert!(matches!(unpack(b""), Ok(Cow::Borrowed(b""))));
    }

    #[test]
    fn every_cut_and_a_bomb_are_refused() {
        let whole = packed(b"ODOM 0 0 0 0 0 0 1 host 1\n");
        for length in 2..whole.len() {
            let error = unpack(&whole[..length]).expect_err("cut").to_string();
            assert!(error.contains("expected a whole gzip stream"), "{error}");
        }
        let bomb = packed(&vec![0; 32 << 20]);
        assert!(matches!(unpack(&bomb), Err(FormatError::TooLarge { .. })), "{}", bomb.len());
    }
}
