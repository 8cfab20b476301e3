//! Why a command failed, and the exit code that says so.

use std::fmt;

use crate::config::ConfigError;
use crate::replay::ReplayError;
use crate::run::FolderError;

/// A command's failure.
#[derive(Debug)]
pub(super) enum Failure {
    /// Bad usage or bad input.
    Input(anyhow::Error),
    /// The work failed.
    Work(anyhow::Error),
}

impl Failure {
    pub(super) fn code(&self) -> u8 {
        match self {
            Self::Work(_) => 1,
            Self::Input(_) => 2,
        }
    }

    /// The work failed for this reason.
    pub(super) fn work(reason: impl Into<anyhow::Error>) -> Self {
        Self::Work(reason.into())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Input(error) | Self::Work(error)) = self;
        write!(f, "{error:#}")
    }
}

impl From<ConfigError> for Failure {
    fn from(error: ConfigError) -> Self {
        Self::Input(error.into())
    }
}

impl From<ReplayError> for Failure {
    fn from(error: ReplayError) -> Self {
        if error.is_input() { Self::Input(error.into()) } else { Self::Work(error.into()) }
    }
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::Occupied { .. } | FolderError::Unwritable { .. } => {
                Self::Input(error.into())
            }
            _ => Self::Work(error.into()),
        }
    }
}
