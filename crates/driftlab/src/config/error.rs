//! What can be wrong with a config.

use std::path::PathBuf;

use super::Place;

/// A config that cannot be used; the message names the place, what was found and what was expected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A file that is not there or cannot be read.
    #[error("{}: cannot be read ({reason}); expected {expected}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: std::io::Error,
        /// What it should have been.
        expected: String,
    },
    /// A piece of the config that is not what it should be.
    #[error("{place}: found {found}, expected {expected}{}", on_next_line(&place.excerpt))]
    Value {
        /// Where it stands.
        place: Place,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A map file that the config names and that cannot be used.
    #[error("{place}: {message}{}", on_next_line(&place.excerpt))]
    World {
        /// The line of the config that names it.
        place: Place,
        /// What the reader said, with the position in the map file.
        message: String,
    },
}

fn on_next_line(excerpt: &str) -> String {
    if excerpt.is_empty() { String::new() } else { format!("\n{excerpt}") }
}
