//! Chunk by chunk through a file, as far as it can be read.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use rerun::external::re_log_encoding::Decoder;
use rerun::log::{Chunk, LogMsg};

use crate::InstrumentError;

/// How far a file could be read.
#[derive(Clone, Debug, Default)]
pub(super) struct Reading {
    /// Size of the file, bytes.
    pub bytes: u64,
    /// What is wrong with it, if anything is.
    pub damage: Option<String>,
    /// Whether it holds a layout.
    pub has_layout: bool,
}

/// Shows every chunk of recorded data to `visit`, with its size in the file; stops at damage and tells of it.
///
/// # Errors
/// A file that cannot be opened, or in which nothing could be read.
pub(super) fn read(
    path: &Path,
    mut visit: impl FnMut(&Chunk, u64),
) -> Result<Reading, InstrumentError> {
    let open = |source| InstrumentError::Open { path: path.to_owned(), source };
    let file = File::open(path).map_err(open)?;
    let bytes = file.metadata().map_err(open)?.len();
    let mut reading = Reading { bytes, ..Reading::default() };
    let mut messages = Decoder::<LogMsg>::decode_lazy(BufReader::new(file));
    let mut count = 0_usize;
    let mut recordings = std::collections::BTreeSet::new();
    loop {
        let at = messages.num_bytes_processed();
        let message = match messages.next() {
            None => break,
            Some(Ok(message)) => message,
            Some(Err(error)) => {
                reading.damage = Some(format!("unreadable from byte {at} on: {error}"));
                break;
            }
        };
        count += 1;
        match message {
            LogMsg::SetStoreInfo(info) => {
                let id = info.info.store_id;
                if id.is_recording() {
                    recordings.insert(id.recording_id().to_string());
                } else {
                    reading.has_layout = true;
                }
            }
            LogMsg::ArrowMsg(store, message) if store.is_recording() => {
                match Chunk::from_arrow_msg(&message) {
                    Ok(chunk) => visit(&chunk, messages.num_bytes_processed() - at),
                    Err(error) => {
                        let what = format!("unreadable data before byte {at}: {error}");
                        reading.damage.get_or_insert(what);
                    }
                }
            }
            _ => {}
        }
    }
    if count == 0 {
        let reason = reading.damage.unwrap_or_else(|| match bytes {
            0 => "it is empty".to_owned(),
            bytes => format!("no message in its {bytes} bytes"),
        });
        return Err(InstrumentError::NotARecording { path: path.to_owned(), reason });
    }
    let closed = messages.rrd_manifests().is_ok_and(|manifests| !manifests.is_empty());
    if reading.damage.is_none() && !closed {
        let at = messages.num_bytes_processed();
        let left = bytes.saturating_sub(at);
        reading.damage = Some(if left > 0 {
            format!("not closed: the writer stopped, the last {left} of {bytes} bytes are cut off")
        } else {
            format!("not closed: the writer stopped after byte {bytes}")
        });
    }
    if recordings.len() > 1 {
        let what = format!("{} recordings in one file are taken together", recordings.len());
        reading.damage.get_or_insert(what);
    }
    Ok(reading)
}
