//! A text read as its type, with the places of its keys.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::DeTable;

use super::ConfigError;
use super::document::{Spans, spans};
use super::explain::explained;
use super::source::{Place, Sources};

/// What a file says, and where each key of it stands.
pub(super) struct Typed<T> {
    pub value: T,
    path: PathBuf,
    sources: Sources,
    spans: BTreeMap<String, Spans>,
}

impl<T: DeserializeOwned> Typed<T> {
    /// Reads a text; `path` is where it came from.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, ConfigError> {
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
    pub fn refused(&self, key: &str, found: &str, expected: String) -> ConfigError {
        let place = self
            .spans
            .get(key)
            .map_or_else(|| Place::file(&self.path), |at| self.sources.place(at.value.clone()));
        ConfigError::Value { place, found: format!("{found} for `{key}`"), expected }
    }
}
