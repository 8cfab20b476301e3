//! Logs of robots, whatever file or folder they come in.
//!
//! | file | what |
//! |---|---|
//! | `source` | which reader a file or folder takes, and its messages one by one |
//! | `folder` | depth images of a folder as messages, read as they come |
//! | `text` | logs in text, told apart by their lines |

mod folder;
mod source;
mod text;

pub use source::{LogError, LogSource};
pub(crate) use text::no_laser_log;
