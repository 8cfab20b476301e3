//! The compression of `binary_compressed` clouds: LZF, by M. Lehmann.

/// Decompresses into exactly `size` bytes; the offset in `packed` at which it goes wrong otherwise.
///
/// A control byte below 32 is followed by that many literal bytes and one more; any other says how
/// far back (13 bits) and how many bytes (3 bits, or 7 and a byte more; plus 2) are repeated. Cost:
/// linear in `size`, which is allocated as it fills.
pub(crate) fn decompress(packed: &[u8], size: usize) -> Result<Vec<u8>, usize> {
    // No control byte makes more than 264 bytes out of three.
    let mut out = Vec::with_capacity(size.min(packed.len().saturating_mul(90)));
    let mut at = 0;
    while let Some(&control) = packed.get(at) {
        let started = at;
        at += 1;
        if control < 32 {
            let end = at + usize::from(control) + 1;
            out.extend_from_slice(packed.get(at..end).ok_or(started)?);
            at = end;
        } else {
            let mut length = usize::from(control >> 5);
            if length == 7 {
                length += usize::from(*packed.get(at).ok_or(started)?);
                at += 1;
            }
            let low = usize::from(*packed.get(at).ok_or(started)?);
            at += 1;
            let back = (usize::from(control & 31) << 8 | low) + 1;
            let from = out.len().checked_sub(back).ok_or(started)?;
            for place in from..from + length + 2 {
                let byte = out[place];
                out.push(byte);
            }
        }
        if out.len() > size {
            return Err(started);
        }
    }
    if out.len() == size { Ok(out) } else { Err(at) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_and_repeats() {
        // Three letters, then 5 bytes from 3 back, then 11 from 1 back.
        let packed = [2, b'a', b'b', b'c', 3 << 5, 2, 7 << 5, 2, 0];
        assert_eq!(decompress(&packed, 19).as_deref(), Ok(&b"abcabcabbbbbbbbbbbb"[..]));
        assert_eq!(decompress(&packed, 18), Err(6));
        assert_eq!(decompress(&packed, 20), Err(9));
        assert_eq!(decompress(&packed[..2], 3), Err(0));
        assert_eq!(decompress(&[3 << 5, 0], 5), Err(0));
        assert_eq!(decompress(&[], 0), Ok(vec![]));
    }
}
