//! What can go wrong with recordings.

use std::path::PathBuf;

/// Why a recording could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum InstrumentError {
    /// The file could not be created, or its writer stopped.
    #[error("cannot write the recording {}: {reason}", path.display())]
    Write {
        /// The recording.
        path: PathBuf,
        /// What the writer said.
        reason: String,
    },
    /// The file could not be opened.
    #[error("cannot read {}: {source}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is no recording at all: nothing in it could be read.
    #[error("{} is not a Rerun recording: {reason}", path.display())]
    NotARecording {
        /// The file.
        path: PathBuf,
        /// What was found instead.
        reason: String,
    },
    /// Rows could not be put into the viewer's form: a bug of ours.
    #[error("rows for {entity} do not fit together: {reason}")]
    Rows {
        /// The entity.
        entity: String,
        /// What the encoder said.
        reason: String,
    },
}
