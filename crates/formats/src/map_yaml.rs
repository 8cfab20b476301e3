//! The YAML file beside a map image, as ROS's map_server writes and reads it.

mod flat;

use crate::FormatError;
use crate::error::{Position, quote};

use flat::{Entry, Value};

/// How map_server turns shades into cells (its key `mode`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapMode {
    /// Occupied, free or unknown by two thresholds.
    #[default]
    Trinary,
    /// As trinary, but shades between the thresholds are probabilities; transparency is unknown.
    Scale,
    /// The level itself is the cost, 0 to 100; above that, unknown.
    Raw,
}

/// What a map_server YAML file says.
#[derive(Clone, Debug, PartialEq)]
pub struct MapYaml {
    /// Path of the image, relative to the folder of the YAML file unless absolute.
    pub image: String,
    /// Side of a pixel, metres; above 0.
    pub resolution_m: f64,
    /// Pose of the lower-left corner of the image in the map frame: x and y in metres, yaw in
    /// radians. Most ROS software ignores the yaw.
    pub origin: [f64; 3],
    /// Whether white means occupied; as a rule black does.
    pub negate: bool,
    /// Occupancies above this are occupied; from 0 to 1.
    pub occupied_thresh: f64,
    /// Occupancies below this are free; from 0 to `occupied_thresh`.
    pub free_thresh: f64,
    /// How the shades between are read.
    pub mode: MapMode,
    /// What was let pass: unknown keys and defaults taken, one line each.
    pub warnings: Vec<String>,
}

/// Reads the text of a map_server YAML file.
///
/// It needs `image`, `resolution` and `origin`; without `negate`, `occupied_thresh` and
/// `free_thresh` it takes map_server's 0, 0.65 and 0.196 with a warning. Read is the flat part of
/// YAML that such files use: `key: value`, lists in brackets or with dashes, quotes and comments.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column.
pub fn read(text: &str) -> Result<MapYaml, FormatError> {
    let (entries, end) = flat::entries(text)?;
    let mut fields = Fields { entries, end, warnings: Vec::new() };
    let image =
        fields.required("image", "the path of the image")?.scalar("the path of the image")?;
    if image.text.is_empty() {
        return Err(FormatError::unexpected(image.at, "nothing", "the path of the image"));
    }
    let image = image.text.clone();
    let resolution_m = fields.required("resolution", "metres per pixel")?.scalar(POSITIVE)?;
    let resolution_m = resolution_m.number(POSITIVE, |number| number > 0.0)?;
    let origin = read_origin(fields.required("origin", ORIGIN)?)?;
    let negate = match fields.optional("negate", "0") {
        Some(entry) => {
            let scalar = entry.scalar("0 or 1")?;
            match scalar.text.to_ascii_lowercase().as_str() {
                "0" | "false" | "no" | "off" => false,
                "1" | "true" | "yes" | "on" => true,
                _ => return Err(FormatError::unexpected(scalar.at, quote(&scalar.text), "0 or 1")),
            }
        }
        None => false,
    };
    let share = |number: f64| (0.0..=1.0).contains(&number);
    let occupied_thresh = match fields.optional("occupied_thresh", "0.65") {
        Some(entry) => entry.scalar(SHARE)?.number(SHARE, share)?,
        None => 0.65,
    };
    let free_thresh = match fields.optional("free_thresh", "0.196") {
        Some(entry) => entry.scalar(SHARE)?.number(SHARE, share)?,
        None => 0.196_f64.min(occupied_thresh),
    };
    if free_thresh > occupied_thresh {
        let at = fields.position("free_thresh");
        let expected = format!("at most occupied_thresh, {occupied_thresh}");
        return Err(FormatError::unexpected(at, format!("free_thresh {free_thresh}"), expected));
    }
    let mode = read_mode(fields.find("mode"))?;
    let warnings = fields.into_warnings();
    Ok(MapYaml {
        image,
        resolution_m,
        origin,
        negate,
        occupied_thresh,
        free_thresh,
        mode,
        warnings,
    })
}

const POSITIVE: &str = "a length in metres above 0";
const SHARE: &str = "a number from 0 to 1";
const ORIGIN: &str = "a list of three numbers: x, y, yaw";
const KNOWN: [&str; 7] =
    ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

fn read_origin(entry: &Entry) -> Result<[f64; 3], FormatError> {
    match &entry.value {
        Value::List(items) if items.len() == 3 => {
            let mut origin = [0.0; 3];
            for (number, item) in origin.iter_mut().zip(items) {
                *number = item.number("a finite number", |_| true)?;
            }
            Ok(origin)
        }
        Value::List(items) => {
            let found = format!("a list of {}", items.len());
            Err(FormatError::unexpected(entry.value_at, found, ORIGIN))
        }
        other => Err(FormatError::unexpected(entry.value_at, other.describe(), ORIGIN)),
    }
}

fn read_mode(entry: Option<&Entry>) -> Result<MapMode, FormatError> {
    const MODES: &str = "`trinary`, `scale` or `raw`";
    let Some(entry) = entry else { return Ok(MapMode::default()) };
    let scalar = entry.scalar(MODES)?;
    match scalar.text.as_str() {
        "trinary" => Ok(MapMode::Trinary),
        "scale" => Ok(MapMode::Scale),
        "raw" => Ok(MapMode::Raw),
        _ => Err(FormatError::unexpected(scalar.at, quote(&scalar.text), MODES)),
    }
}

struct Fields {
    entries: Vec<Entry>,
    end: Position,
    warnings: Vec<String>,
}

impl Fields {
    fn find(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    fn position(&self, key: &str) -> Position {
        self.find(key).map_or(self.end, |entry| entry.value_at)
    }

    fn required(&self, key: &str, what: &str) -> Result<&Entry, FormatError> {
        self.find(key).ok_or_else(|| {
            let expected = format!("a key `{key}`: {what}");
            FormatError::unexpected(self.end, "the end of the file", expected)
        })
    }

    fn optional(&mut self, key: &str, default: &str) -> Option<&Entry> {
        if self.find(key).is_none() {
            self.warnings.push(format!("no key `{key}`: taken as {default}"));
        }
        self.find(key)
    }

    fn into_warnings(self) -> Vec<String> {
        let mut warnings = self.warnings;
        for entry in self.entries.iter().filter(|entry| !KNOWN.contains(&entry.key.as_str())) {
            warnings.push(format!("{}: unknown key `{}` ignored", entry.key_at, entry.key));
        }
        warnings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "image: map.pgm\nresolution: 0.050000\norigin: [-12.5, -1e1, 0.000000]\n\
        negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n";

    #[test]
    fn what_map_server_writes() {
        let map = read(FILE).expect("valid");
        assert_eq!(map.image, "map.pgm");
        assert_eq!((map.resolution_m, map.origin), (0.05, [-12.5, -10.0, 0.0]));
        assert_eq!((map.negate, map.occupied_thresh, map.free_thresh), (false, 0.65, 0.196));
        assert_eq!(map.mode, MapMode::Trinary);
        assert!(map.warnings.is_empty());
    }

    #[test]
    fn other_spellings() {
        let text = "%YAML 1.2\n---\n# a map\nmode: scale # shades\r\n\"image\": 'it''s #1.png'\n\
            resolution : 5.0e-2\norigin:\n  - 1\n  - -2.5 # y\n  - +.5\nnegate: true\n\
            free_thresh: 0.1\nextra:\n  nested: 1\n  more: [a, b]\nlist: [1,\n  2]\n...\nignored";
        let map = read(text).expect("valid");
        assert_eq!(map.image, "it's #1.png");
        assert_eq!(map.origin, [1.0, -2.5, 0.5]);
        assert_eq!((map.negate, map.mode), (true, MapMode::Scale));
        assert_eq!(
            map.warnings,
            [
                "no key `occupied_thresh`: taken as 0.65",
                "line 13, column 1: unknown key `extra` ignored",
                "line 16, column 1: unknown key `list` ignored",
            ]
        );
        let dashes = "image: \"a\\\\b\\u0041.png\"\nresolution: 1\norigin:\n- 0\n- 0\n- 0\n";
        assert_eq!(read(dashes).expect("valid").image, "a\\bA.png");
    }

    #[test]
    fn errors_say_where() {
        let with = |from: &str, to: &str| FILE.replace(from, to);
        let cases = [
            (
                String::new(),
                "line 1, column 1: found the end of the file, expected a key `image`: the path of the image",
            ),
            (
                with("resolution: 0.050000", "resolution: 0"),
                "line 2, column 13: found `0`, expected a length in metres above 0",
            ),
            (
                with("resolution: 0.050000", "resolution: nan"),
                "line 2, column 13: found `nan`, expected a length in metres above 0",
            ),
            (
                with("resolution: 0.050000", "resolution:"),
                "line 2, column 12: found nothing, expected a length in metres above 0",
            ),
            (
                with("resolution: 0.050000", "resolution 0.05"),
                "line 2, column 1: found `resolution 0.05`, expected `key: value`",
            ),
            (
                with("-1e1, ", ""),
                "line 3, column 9: found a list of 2, expected a list of three numbers: x, y, yaw",
            ),
            (with("-1e1", "west"), "line 3, column 17: found `west`, expected a finite number"),
            (
                with("0.000000]", "0.000000"),
                "line 3, column 31: found the end of the list without `]`, expected `]`",
            ),
            (with("negate: 0", "negate: 2"), "line 4, column 9: found `2`, expected 0 or 1"),
            (
                with("0.65", "1.65"),
                "line 5, column 18: found `1.65`, expected a number from 0 to 1",
            ),
            (
                with("0.65", "0.1"),
                "line 6, column 14: found free_thresh 0.196, expected at most occupied_thresh, 0.1",
            ),
            (
                with("negate: 0", "negate: 0\nnegate: 0"),
                "line 5, column 1: found a second `negate`, expected each key once",
            ),
            (
                with("map.pgm", "'map.pgm"),
                "line 1, column 8: found a quote that is not closed, expected `'`",
            ),
            (
                with("map.pgm", "[a]"),
                "line 1, column 8: found a list, expected the path of the image",
            ),
            (
                with("negate: 0", "mode: 3d"),
                "line 4, column 7: found `3d`, expected `trinary`, `scale` or `raw`",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(read(&text).expect_err(&text).to_string(), message, "{text}");
        }
    }
}
