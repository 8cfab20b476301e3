//! Why a replay fails.

use std::path::PathBuf;

use instrument::InstrumentError;
use maps3d::Maps3dError;

use crate::config::ConfigError;
use crate::logs::LogError;
use crate::run::RunError;

/// Why a log cannot be replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// A file that was named cannot be taken.
    #[error("{}: {message}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// What was found, and what was expected.
        message: String,
    },
    /// The log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A map whose parameters do not go together.
    #[error(transparent)]
    Map(#[from] Maps3dError),
    /// The config does not fit a log.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] InstrumentError),
    /// A report cannot be put into its form.
    #[error(transparent)]
    Report(#[from] RunError),
}

impl ReplayError {
    /// A file that cannot be taken.
    pub(super) fn input(path: impl Into<PathBuf>, message: impl ToString) -> Self {
        Self::Input { path: path.into(), message: message.to_string() }
    }

    /// Whether the input is to blame, not the work.
    pub fn is_input(&self) -> bool {
        matches!(self, Self::Input { .. } | Self::Log(_) | Self::Map(_) | Self::Config(_))
    }
}
