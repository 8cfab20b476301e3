//! Where a run came from: program, seed, inputs, and how it ended.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use sha2::{Digest, Sha256};

/// The commit that the program was built from; empty where that could not be told.
pub const GIT_HASH: &str = env!("DRIFTLAB_GIT_HASH");

/// The version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// One file that went into a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Input {
    /// The file, as it was named; letters that are no UTF-8 are replaced.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
}

impl Input {
    /// Notes a file that was read.
    pub fn new(path: &Path, content: &[u8]) -> Self {
        let sha256 = Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { path: path.display().to_string(), bytes: content.len() as u64, sha256 }
    }
}

/// What `provenance.toml` says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// Version of driftlab.
    pub version: &'static str,
    /// Commit that it was built from; empty where that could not be told.
    pub git_hash: &'static str,
    /// Seed of the run.
    pub seed: u64,
    /// How the run of each map ended.
    pub termination: BTreeMap<String, String>,
    /// Every file that went into it, the config first.
    pub inputs: Vec<Input>,
}

impl Provenance {
    /// Where a run of this program came from: its seed, how each map's run ended, and its files.
    pub fn of(
        seed: u64,
        termination: impl Iterator<Item = (String, String)>,
        inputs: Vec<Input>,
    ) -> Self {
        let termination = termination.collect();
        Self { version: VERSION, git_hash: GIT_HASH, seed, termination, inputs }
    }

    /// The text of `provenance.toml`.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_told_by_content() {
        // FIPS 180-2, appendix B.1.
        let input = Input::new(Path::new("a"), b"abc");
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!((input.bytes, input.sha256.as_str()), (3, expected));
    }

    #[test]
    fn the_text_parses_again() {
        let provenance = Provenance {
            version: VERSION,
            git_hash: GIT_HASH,
            seed: 3,
            termination: [("grid".to_owned(), "complete".to_owned())].into(),
            inputs: vec![Input::new(Path::new("a b"), b"")],
        };
        let table: toml::Table = provenance.to_toml().unwrap().parse().unwrap();
        assert_eq!(table["seed"].as_integer(), Some(3));
        assert_eq!(table["inputs"][0]["path"].as_str(), Some("a b"));
        assert_eq!(table["termination"]["grid"].as_str(), Some("complete"));
    }
}
