//! Configs that are no experiment: a text read as its type, checked, with the places of its keys.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::DeTable;

use super::ConfigError;
use super::document::{Spans, spans};
use super::explain::explained;
use super::source::{Place, Sources};

/// A type that a whole file is read as.
pub(super) trait Checked: DeserializeOwned {
    /// What the file should be, for the message where it cannot be read.
    const WHAT: &'static str;

    /// The key of the first value out of range, what was found, and what was expected.
    fn fault(&self) -> Option<(String, String, String)>;
}

/// Reads and checks a file.
///
/// # Errors
/// The first thing wrong, with file, line and column.
pub(super) fn read<T: Checked>(path: &Path) -> Result<T, ConfigError> {
    let text = std::fs::read_to_string(path).map_err(|reason| ConfigError::Unreadable {
        path: path.to_owned(),
        reason,
        expected: T::WHAT.into(),
    })?;
    from_text(path, &text)
}

/// As [`read`], from the text of the file.
///
/// # Errors
/// As there.
pub(super) fn from_text<T: Checked>(path: &Path, text: &str) -> Result<T, ConfigError> {
    let typed = Typed::<T>::from_text(path, text)?;
    match typed.value.fault() {
        None => Ok(typed.value),
        Some((key, found, expected)) => Err(typed.refused(&key, &found, expected)),
    }
}

/// What a file says, and where each key of it stands.
struct Typed<T> {
    value: T,
    path: PathBuf,
    sources: Sources,
    spans: BTreeMap<String, Spans>,
}

impl<T: DeserializeOwned> Typed<T> {
    /// Reads a text; `path` is where it came from.
    fn from_text(path: &Path, text: &str) -> Result<Self, ConfigError> {
        let mut sources = Sources::default();
        let base = sources.add_file(path, text.to_owned());
        let parsed = DeTable::parse(text);
        let parsed = parsed.map_err(|error| explained(&error, base, &sources, &BTreeMap::new()))?;
        let root = parsed.span();
        let document = parsed.into_inner();
        let spans = spans(&document);
        let parser = toml::de::Deserializer::from(Spanned::new(root, document));
        let value =
            T::deserialize(parser).map_err(|error| explained(&error, base, &sources, &spans))?;
        Ok(Self { value, path: path.to_owned(), sources, spans })
    }
}

impl<T> Typed<T> {
    /// The message for a key whose value is out of range.
    fn refused(&self, key: &str, found: &str, expected: String) -> ConfigError {
        let place = self
            .spans
            .get(key)
            .map_or_else(|| Place::file(&self.path), |at| self.sources.place(at.value.clone()));
        ConfigError::Value { place, found: format!("{found} for `{key}`"), expected }
    }
}
