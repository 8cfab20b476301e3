//! The parser's messages, told as what was found and what was expected.

use std::collections::BTreeMap;

use super::document::Spans;
use super::source::Sources;
use super::{ConfigError, meaning};

/// A message of the TOML parser or of serde, placed and in our words.
///
/// `spans` are the keys of the document (none if it did not parse).
pub(super) fn explained(
    error: &toml::de::Error,
    base: usize,
    sources: &Sources,
    spans: &BTreeMap<String, Spans>,
) -> ConfigError {
    let span = error.span().map_or(base..base, |span| span.start + base..span.end + base);
    let place = sources.place(span.clone());
    let message = error.message();
    let (found, expected) = message.split_once(", expected ").unwrap_or((message, ""));

    if let Some(name) = quoted_after(found, "unknown field ") {
        let key = path_at(spans, |at| at.key == span).unwrap_or_else(|| name.to_owned());
        let known = expected.trim_start_matches("one of ");
        let expected = match nearest(name, known) {
            Some(near) => format!("one of {known}; did you mean `{near}`?"),
            None if known.is_empty() => "no key here".to_owned(),
            None => format!("one of {known}"),
        };
        return ConfigError::Value { place, found: format!("unknown key `{key}`"), expected };
    }
    if let Some(name) = quoted_after(found, "missing field ") {
        let table = path_at(spans, |at| at.value == span);
        let path = table.map_or_else(|| name.to_owned(), |table| format!("{table}.{name}"));
        return ConfigError::Value {
            place,
            found: format!("no `{path}`"),
            expected: with_meaning("this key", &path),
        };
    }

    let path = path_at(spans, |at| at.value == span);
    let key = path.as_ref().map_or_else(String::new, |path| format!(" for `{path}`"));
    let (found, expected) = if let Some(name) = quoted_after(found, "unknown variant ") {
        (format!("`{name}`"), expected.to_owned())
    } else if let Some(value) = found.strip_prefix("invalid type: ").or_else(|| {
        found.strip_prefix("invalid value: ").or_else(|| found.strip_prefix("invalid length "))
    }) {
        (plain_found(value), plain_expected(expected))
    } else if message == "wanted string or table" {
        (sources.words(span).to_owned(), "text in quotes".to_owned())
    } else if message == "duplicate key" {
        ("a key for the second time".to_owned(), "each key once".to_owned())
    } else if message.starts_with("string values must be quoted") {
        ("no value".to_owned(), "a number, true, false, a list, or text in quotes".to_owned())
    } else if expected.is_empty() {
        (found.to_owned(), if spans.is_empty() { "valid TOML" } else { "another value" }.to_owned())
    } else {
        (found.to_owned(), expected.to_owned())
    };
    let expected = match &path {
        Some(path) => with_meaning(&expected, path),
        None => expected,
    };
    ConfigError::Value { place, found: format!("{found}{key}"), expected }
}

/// `expected`, and in brackets what the key means.
pub(super) fn with_meaning(expected: &str, path: &str) -> String {
    match meaning(path) {
        Some(meaning) => format!("{expected} ({})", lower_first(&meaning)),
        None => expected.to_owned(),
    }
}

/// The text as the middle of a sentence.
fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_lowercase().chain(letters).collect(),
        None => String::new(),
    }
}

fn path_at(spans: &BTreeMap<String, Spans>, is_it: impl Fn(&Spans) -> bool) -> Option<String> {
    spans.iter().find(|(_, at)| is_it(at)).map(|(path, _)| path.clone())
}

fn quoted_after<'m>(message: &'m str, start: &str) -> Option<&'m str> {
    message.strip_prefix(start)?.strip_prefix('`')?.split('`').next()
}

fn plain_found(value: &str) -> String {
    match value {
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        "unit variant" => "text".to_owned(),
        other => {
            other.replace('`', "").replace(" as i128", "").replacen("floating point", "number", 1)
        }
    }
}

fn plain_expected(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" | "u64" | "usize" => "a whole number, 0 or more".to_owned(),
        "newtype variant" => "a table".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "path string" => "a file name in quotes".to_owned(),
        "a sequence" => "a list".to_owned(),
        "an array of length 2" => "two numbers".to_owned(),
        other if other.starts_with("struct ") || other == "a map" => "a table".to_owned(),
        other => other.to_owned(),
    }
}

/// The known key that is most like `name`, if one is near enough to be meant.
fn nearest<'k>(name: &str, known: &'k str) -> Option<&'k str> {
    let names = known.split('`').skip(1).step_by(2);
    let best = names.map(|key| (distance(name, key), key)).min()?;
    (best.0 <= 1 + name.len() / 3).then_some(best.1)
}

/// Edits between two words, where a word that the other starts with is near.
fn distance(a: &str, b: &str) -> usize {
    if !a.is_empty() && (b.starts_with(a) || a.starts_with(b)) {
        return 1;
    }
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..b.len() {
            let substitute = diagonal + usize::from(b[j] != letter);
            diagonal = row[j + 1];
            row[j + 1] = substitute.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_between_words_are_counted() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("fov", "fov_deg"), 1);
        assert_eq!(nearest("rnage_m", "`fov_deg`, `range_m`, `rays`"), Some("range_m"));
        assert_eq!(nearest("colour", "`fov_deg`, `range_m`, `rays`"), None);
    }
}
