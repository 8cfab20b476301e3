//! Chunks that were packed with zstd or lz4.

use std::io::Read;

use zstd::bulk::Decompressor;

/// The most bytes that a chunk may hold when unpacked, 2^29.
pub(crate) const MAX_UNPACKED: u64 = 1 << 29;

/// How a chunk is packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packing {
    Zstd,
    Lz4,
}

/// Unpacks chunk after chunk.
#[derive(Default)]
pub(crate) struct Unpacker {
    zstd: Option<Decompressor<'static>>,
}

impl std::fmt::Debug for Unpacker {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Unpacker").finish_non_exhaustive()
    }
}

impl Unpacker {
    /// Unpacks a chunk that says how large it is; never more than that, nor than [`MAX_UNPACKED`].
    pub(crate) fn unpack(
        &mut self,
        packing: Packing,
        packed: &[u8],
        size: u64,
        unpacked: &mut Vec<u8>,
    ) -> Result<(), String> {
        if size > MAX_UNPACKED {
            return Err(format!("a chunk of {size} bytes, at most {MAX_UNPACKED} are read"));
        }
        let size = size as usize;
        unpacked.clear();
        unpacked.reserve_exact(size);
        match packing {
            Packing::Zstd => {
                if self.zstd.is_none() {
                    self.zstd = Some(Decompressor::new().map_err(|error| error.to_string())?);
                }
                if let Some(zstd) = &mut self.zstd {
                    let told = zstd.decompress_to_buffer(packed, unpacked);
                    told.map_err(|error| format!("a chunk that zstd cannot unpack ({error})"))?;
                }
            }
            Packing::Lz4 => {
                let failed = |error| format!("a chunk that lz4 cannot unpack ({error})");
                let decoder = lz4::Decoder::new(packed).map_err(failed)?;
                decoder.take(size as u64 + 1).read_to_end(unpacked).map_err(failed)?;
            }
        }
        if unpacked.len() != size {
            let found = unpacked.len().min(size + 1);
            return Err(format!("a chunk of {found} bytes or more that should have {size}"));
        }
        Ok(())
    }
}
