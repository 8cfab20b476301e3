//! Any log that is read message by message.

use std::io::Read;

use super::{Damage, Log, Message, ReadOptions, Topic};
use crate::FormatError;
use crate::bag::{self, BagReader};
use crate::error::{Position, quote};
use crate::mcap::{self, McapReader};

/// A log that is read message by message, told by its first bytes.
#[derive(Debug)]
pub enum LogReader<R> {
    /// An MCAP file.
    Mcap(McapReader<Rest<R>>),
    /// A bag of ROS 1.
    Bag(BagReader<Rest<R>>),
}

/// A file whose first bytes were looked at.
pub type Rest<R> = std::io::Chain<std::io::Cursor<Vec<u8>>, R>;

impl<R: Read> LogReader<R> {
    /// A reader at the start of a file.
    ///
    /// # Errors
    /// [`FormatError::Unexpected`] for what is neither an MCAP file nor a bag of ROS 1,
    /// [`FormatError::Scale`] for a scale of depth images that is no scale.
    pub fn new(mut source: R, options: &ReadOptions) -> Result<Self, FormatError> {
        let mut head = Vec::new();
        let looked = source.by_ref().take(bag::MAGIC.len() as u64).read_to_end(&mut head);
        if let Err(error) = looked {
            let found = format!("a file that cannot be read ({error})");
            return Err(FormatError::unexpected(Position::Byte(0), found, "a log"));
        }
        let (is_mcap, is_bag) = (head.starts_with(&mcap::MAGIC), head.starts_with(b"#ROSBAG"));
        let shown = quote(&String::from_utf8_lossy(&head));
        let source = std::io::Cursor::new(head).chain(source);
        match (is_mcap, is_bag) {
            (true, _) => McapReader::new(source, options).map(Self::Mcap),
            (_, true) => BagReader::new(source, options).map(Self::Bag),
            _ => {
                let expected = "an MCAP file or a bag of ROS 1";
                Err(FormatError::unexpected(Position::Byte(0), shown, expected))
            }
        }
    }

    /// The topics that were named so far, with counts of what was read so far.
    pub fn topics(&self) -> &[Topic] {
        match self {
            Self::Mcap(reader) => reader.topics(),
            Self::Bag(reader) => reader.topics(),
        }
    }

    /// Where the reading ended before the end of the file.
    pub fn damage(&self) -> Option<&Damage> {
        match self {
            Self::Mcap(reader) => reader.damage(),
            Self::Bag(reader) => reader.damage(),
        }
    }

    /// What was odd so far.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::Mcap(reader) => reader.warnings(),
            Self::Bag(reader) => reader.warnings(),
        }
    }

    /// Reads what is left, and keeps all of it in memory.
    pub fn into_log(self) -> Log {
        match self {
            Self::Mcap(reader) => reader.into_log(),
            Self::Bag(reader) => reader.into_log(),
        }
    }
}

impl<R: Read> Iterator for LogReader<R> {
    type Item = Message;

    fn next(&mut self) -> Option<Message> {
        match self {
            Self::Mcap(reader) => reader.next_message(),
            Self::Bag(reader) => reader.next_message(),
        }
    }
}
