//! Opening a log, and reading it message by message.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use formats::FormatError;
use formats::log::{Damage, Log, LogReader, Message, ReadOptions, Topic};

use super::folder::FolderLog;
use super::text;

/// Why a log cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The system refused.
    #[error("{}: {reason}; expected a log or a folder of depth images", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// Its bytes are no log.
    #[error("{}: {error}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        error: FormatError,
    },
    /// A folder is none of depth images.
    #[error("{}: {error}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it.
        error: formats::depth_folder::DepthFolderError,
    },
    /// Nothing before the damage can be read.
    #[error("{}: {what}", path.display())]
    Nothing {
        /// The file.
        path: PathBuf,
        /// Where the reading ended, or what is there instead.
        what: String,
    },
}

/// A log on its way: recordings and folders are read as their messages are asked for, text is in memory.
#[derive(Debug)]
pub struct LogSource {
    path: PathBuf,
    inner: Inner,
    warnings: Vec<String>,
}

#[derive(Debug)]
enum Inner {
    Recording(Box<LogReader<BufReader<File>>>),
    Text(Box<Log>, std::vec::IntoIter<Message>),
    Folder(Box<FolderLog>),
}

impl LogSource {
    /// Opens a log, told by its content: MCAP, a bag of ROS 1, CARMEN, a JSON map of scans, relations, a TUM
    /// trajectory (text packed with gzip or not), or a folder of depth images with poses.
    ///
    /// # Errors
    /// [`LogError`] with the file, the place in it, what was found and what was expected.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        let unreadable = |reason| LogError::Unreadable { path: path.to_owned(), reason };
        let format = |error| LogError::Format { path: path.to_owned(), error };
        let inner = if path.is_dir() {
            Inner::Folder(Box::new(FolderLog::open(path)?))
        } else {
            let mut file = File::open(path).map_err(unreadable)?;
            let mut head = Vec::new();
            file.by_ref().take(8).read_to_end(&mut head).map_err(unreadable)?;
            if head.starts_with(b"\x89MCAP") || head.starts_with(b"#ROSBAG") {
                let file = BufReader::new(File::open(path).map_err(unreadable)?);
                let options = ReadOptions::default();
                Inner::Recording(Box::new(LogReader::new(file, &options).map_err(format)?))
            } else {
                let bytes = std::fs::read(path).map_err(unreadable)?;
                let extension = path.extension().and_then(|extension| extension.to_str());
                let mut log = text::read(&bytes, extension).map_err(format)?;
                let messages = std::mem::take(&mut log.messages);
                Inner::Text(Box::new(log), messages.into_iter())
            }
        };
        Ok(Self { path: path.to_owned(), inner, warnings: Vec::new() })
    }

    /// The topics that were named so far, with counts of what was read so far; of text all of them.
    pub fn topics(&self) -> &[Topic] {
        match &self.inner {
            Inner::Recording(reader) => reader.topics(),
            Inner::Text(log, _) => &log.topics,
            Inner::Folder(folder) => folder.topics(),
        }
    }

    /// Where the reading ended before the end of the file.
    pub fn damage(&self) -> Option<&Damage> {
        match &self.inner {
            Inner::Recording(reader) => reader.damage(),
            Inner::Text(log, _) => log.damage.as_ref(),
            Inner::Folder(_) => None,
        }
    }

    /// What was odd so far, the damage at the end.
    pub fn warnings(&self) -> Vec<String> {
        let inner = match &self.inner {
            Inner::Recording(reader) => reader.warnings(),
            Inner::Text(log, _) => &log.warnings,
            Inner::Folder(folder) => folder.warnings(),
        };
        let damage = self.damage().map(ToString::to_string);
        inner.iter().chain(&self.warnings).cloned().chain(damage).collect()
    }

    /// Whether it is a recording whose frames are its own, not text or a folder.
    pub fn is_recording(&self) -> bool {
        matches!(self.inner, Inner::Recording(_))
    }

    /// The share that was read, where that is known.
    pub fn share(&self) -> Option<f64> {
        match &self.inner {
            Inner::Folder(folder) => Some(folder.share()),
            Inner::Recording(_) | Inner::Text(..) => None,
        }
    }

    /// The next message that is read; `None` at the end or at damage.
    ///
    /// # Errors
    /// A file of a folder that cannot be read.
    pub fn next_message(&mut self) -> Result<Option<Message>, LogError> {
        match &mut self.inner {
            Inner::Recording(reader) => Ok(reader.next()),
            Inner::Text(_, messages) => Ok(messages.next()),
            Inner::Folder(folder) => folder.next_message(),
        }
    }

    /// Whether a log that was read to its end held anything; where damage left nothing, its place.
    ///
    /// # Errors
    /// [`LogError::Nothing`]
    pub fn expect_topics(&self) -> Result<(), LogError> {
        if !self.topics().is_empty() {
            return Ok(());
        }
        let what = match self.damage() {
            Some(Damage { at, what }) => format!("byte {at}: {what}"),
            None => "found no topic, expected a log with messages".to_owned(),
        };
        Err(LogError::Nothing { path: self.path.clone(), what })
    }
}
