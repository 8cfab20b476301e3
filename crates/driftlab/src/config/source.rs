//! Where a piece of a config came from: every text has its own range of one address space.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What kind of text a piece of the config stands in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Nobody wrote it: the built-in default.
    Default,
    /// A line of the config file, counted from 1.
    File {
        /// The config, as it was named on the command line.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
    },
    /// An argument of `--set`, as it was typed.
    Set(String),
    /// The file named by `--world`.
    World(PathBuf),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("default"),
            Self::File { path, line } => write!(f, "{}:{line}", path.display()),
            Self::Set(argument) => write!(f, "--set {argument}"),
            Self::World(path) => write!(f, "--world {}", path.display()),
        }
    }
}

/// One place in one of the texts, ready to be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// `FILE`, or the command-line argument.
    pub text: String,
    /// Line and column from 1, in characters; `None` for a whole text.
    pub line_column: Option<(usize, usize)>,
    /// The line itself with carets under the piece; empty for a whole text.
    pub excerpt: String,
}

impl Place {
    /// A whole file.
    pub fn file(path: &Path) -> Self {
        Self { text: path.display().to_string(), line_column: None, excerpt: String::new() }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)?;
        if let Some((line, column)) = self.line_column {
            write!(f, ":{line}:{column}")?;
        }
        Ok(())
    }
}

#[derive(Clone, Debug)]
enum Kind {
    File(PathBuf),
    Set,
    World(PathBuf),
}

#[derive(Clone, Debug)]
struct Text {
    kind: Kind,
    text: String,
    base: usize,
}

/// All texts that one config was put together from; a span says which text and where in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Sources {
    texts: Vec<Text>,
    end: usize,
}

impl Sources {
    pub(super) fn add_file(&mut self, path: &Path, text: String) -> usize {
        self.add(Kind::File(path.to_owned()), text)
    }

    pub(super) fn add_set(&mut self, argument: &str) -> usize {
        self.add(Kind::Set, argument.to_owned())
    }

    pub(super) fn add_world(&mut self, path: &Path, text: String) -> usize {
        self.add(Kind::World(path.to_owned()), text)
    }

    fn add(&mut self, kind: Kind, text: String) -> usize {
        let base = self.end;
        // One unused address between texts, so that a span at the end of one is not in the next.
        self.end += text.len() + 1;
        self.texts.push(Text { kind, text, base });
        base
    }

    fn text_at(&self, address: usize) -> Option<&Text> {
        self.texts.iter().rev().find(|text| text.base <= address)
    }

    /// Where the piece at `address` was written.
    pub(super) fn origin(&self, address: usize) -> Origin {
        match self.text_at(address) {
            None => Origin::Default,
            Some(Text { kind: Kind::Set, text, .. }) => Origin::Set(text.clone()),
            Some(Text { kind: Kind::World(path), .. }) => Origin::World(path.clone()),
            Some(Text { kind: Kind::File(path), text, base }) => Origin::File {
                path: path.clone(),
                line: 1 + newlines(&text.as_bytes()[..(address - base).min(text.len())]),
            },
        }
    }

    /// The words at `span`.
    pub(super) fn words(&self, span: Range<usize>) -> &str {
        let Some(Text { text, base, .. }) = self.text_at(span.start) else { return "" };
        let end = floor_char(text, span.end.saturating_sub(*base));
        let start = floor_char(text, span.start - base).min(end);
        &text[start..end]
    }

    /// The piece at `span`, with the line that it stands on.
    pub(super) fn place(&self, span: Range<usize>) -> Place {
        let Some(Text { kind, text, base }) = self.text_at(span.start) else {
            return Place { text: "config".into(), line_column: None, excerpt: String::new() };
        };
        let start = floor_char(text, span.start - base);
        let end = floor_char(text, (span.end - base).min(text.len())).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let line_text = text[line_start..line_end].trim_end_matches('\r');
        let line = 1 + newlines(&text.as_bytes()[..start]);
        let column = 1 + text[line_start..start].chars().count();
        let carets = text[start..end.min(line_end)].chars().count().max(1);
        match kind {
            Kind::World(path) => Place {
                text: format!("--world {}", path.display()),
                line_column: None,
                excerpt: String::new(),
            },
            Kind::Set => Place {
                text: format!("--set {text}"),
                line_column: None,
                excerpt: excerpt("", line_text, column, carets),
            },
            Kind::File(path) => Place {
                text: path.display().to_string(),
                line_column: Some((line, column)),
                excerpt: excerpt(&line.to_string(), line_text, column, carets),
            },
        }
    }
}

fn excerpt(label: &str, line: &str, column: usize, carets: usize) -> String {
    // Tabs are kept in the margin, so that the carets stand under the piece.
    let margin: String =
        line.chars().take(column - 1).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
    let gutter = " ".repeat(label.len());
    format!(" {label} | {line}\n {gutter} | {margin}{}", "^".repeat(carets))
}

fn newlines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte == b'\n').count()
}

fn floor_char(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_found_in_its_own_text_and_line() {
        let mut sources = Sources::default();
        let file = sources.add_file(Path::new("a.toml"), "x = 1\n\tåy = 23\n".into());
        let set = sources.add_set("odometry.scale=2");
        let y = file + "x = 1\n\tåy = ".len();
        let place = sources.place(y..y + 2);
        assert_eq!(place.to_string(), "a.toml:2:7");
        assert_eq!(place.excerpt, " 2 | \tåy = 23\n   | \t     ^^");
        assert_eq!(sources.origin(y), Origin::File { path: "a.toml".into(), line: 2 });
        assert_eq!(sources.origin(set + 3), Origin::Set("odometry.scale=2".into()));
        assert_eq!(sources.place(set + 15..set + 16).to_string(), "--set odometry.scale=2");
    }

    #[test]
    fn a_span_at_the_end_of_the_text_or_inside_a_letter_is_shown() {
        let mut sources = Sources::default();
        sources.add_file(Path::new("a.toml"), "name = \"å".into());
        assert_eq!(sources.place(10..10).to_string(), "a.toml:1:10");
        assert_eq!(sources.place(9..40).to_string(), "a.toml:1:9");
    }
}
