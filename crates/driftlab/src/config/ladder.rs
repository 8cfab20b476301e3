//! The config of a ladder: one depth image, reduced further and further by several methods.

use std::path::Path;

use maps3d::reduce::{HoleMethod, Method};
use serde::Deserialize;
use worlds::DepthRoom;

use super::ConfigError;
use super::check::{FOLDER_NAME, is_folder_name};
use super::typed::{self, Checked};

/// More vertices than pixels of the largest image.
const MOST_VERTICES: usize = 1 << 28;

/// A ladder of reductions.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ladder {
    /// What it is called: the recording's name.
    pub name: String,
    /// How the image is made ready.
    #[serde(default)]
    pub depth: LadderDepth,
    /// The made-up room that is looked at where no image is given.
    #[serde(default, with = "RoomTable")]
    pub room: DepthRoom,
    /// How it is reduced.
    pub ladder: Rungs,
}

/// How the image is made ready.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LadderDepth {
    /// Pixels cut off on each side.
    pub crop: usize,
    /// Depth at which missing data is placed, metres.
    pub far_m: f64,
    /// Whether faces across depth gaps are frontier.
    pub occlusion: bool,
}

impl Default for LadderDepth {
    fn default() -> Self {
        Self { crop: 0, far_m: 8.0, occlusion: true }
    }
}

/// The table of the made-up room.
#[derive(Deserialize)]
#[serde(remote = "DepthRoom", deny_unknown_fields, default = "DepthRoom::default")]
struct RoomTable {
    columns: usize,
    rows: usize,
    seed: u32,
    noise_share: f64,
    speckle_share: f64,
    patch: bool,
}

/// Methods, and numbers of vertices.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rungs {
    /// How vertices are chosen, as `driftlab mesh polyhedron --reduce` names it; shown side by side.
    pub methods: Vec<String>,
    /// How holes are triangulated.
    #[serde(default = "ear_clipping")]
    pub hole: String,
    /// Numbers of vertices at which the mesh is shown; none for the full grid alone.
    pub vertices: Vec<usize>,
}

fn ear_clipping() -> String {
    "ear-clipping".to_owned()
}

impl Ladder {
    /// Reads and checks a config.
    ///
    /// # Errors
    /// The first thing wrong, with file, line and column.
    pub fn read(path: &Path) -> Result<Self, ConfigError> {
        typed::read(path)
    }

    /// As [`read`](Self::read), from the text of the file.
    ///
    /// # Errors
    /// As there.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, ConfigError> {
        typed::from_text(path, text)
    }

    /// The methods, in order.
    pub fn methods(&self) -> Vec<Method> {
        let hole = HoleMethod::named(&self.ladder.hole).unwrap_or_default();
        self.ladder.methods.iter().filter_map(|name| Method::named(name, hole)).collect()
    }

    /// The key of the first value out of range, what was found and what was expected.
    fn first_fault(&self) -> Option<(&'static str, String, String)> {
        let rungs = &self.ladder;
        let hole = HoleMethod::named(&rungs.hole);
        if hole.is_none() {
            let expected = format!("one of {}", HoleMethod::ALL.map(HoleMethod::name).join(", "));
            return Some(("ladder.hole", format!("{:?}", rungs.hole), expected));
        }
        let unknown =
            rungs.methods.iter().find(|name| Method::named(name, HoleMethod::default()).is_none());
        if let Some(name) = unknown {
            let expected = format!("some of {}", Method::NAMES.join(", "));
            return Some(("ladder.methods", format!("{name:?}"), expected));
        }
        if rungs.methods.is_empty() {
            return Some(("ladder.methods", "an empty list".into(), "at least one method".into()));
        }
        let twice =
            rungs.methods.iter().enumerate().find(|(at, m)| rungs.methods[..*at].contains(m));
        if let Some((_, name)) = twice {
            let found = format!("{name:?} twice");
            return Some(("ladder.methods", found, "each method once".into()));
        }
        if let Some(wrong) =
            rungs.vertices.iter().find(|count| !(4..=MOST_VERTICES).contains(*count))
        {
            let expected = "numbers from 4, the corners of the image, to 2^28";
            return Some(("ladder.vertices", wrong.to_string(), expected.into()));
        }
        if !is_folder_name(&self.name) {
            return Some(("name", format!("{:?}", self.name), FOLDER_NAME.into()));
        }
        let room = &self.room;
        let sides = [("room.columns", room.columns), ("room.rows", room.rows)];
        if let Some((key, _)) = sides.iter().find(|(_, pixels)| !(2..=4096).contains(pixels)) {
            let found = format!("{} x {} pixels", room.columns, room.rows);
            return Some((key, found, "2 to 4096 each way".into()));
        }
        [
            ("room.noise_share", room.noise_share, 0.0..=0.2),
            ("room.speckle_share", room.speckle_share, 0.0..=1.0),
            ("depth.far_m", self.depth.far_m, 0.001..=1e6),
        ]
        .into_iter()
        .find(|(_, value, range)| !range.contains(value))
        .map(|(key, value, range)| {
            let expected = format!("a number from {} to {}", range.start(), range.end());
            (key, value.to_string(), expected)
        })
    }
}

impl Checked for Ladder {
    const WHAT: &'static str = "the TOML config of a ladder";

    fn fault(&self) -> Option<(String, String, String)> {
        self.first_fault().map(|(key, found, expected)| (key.to_owned(), found, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "name = \"a\"\n[ladder]\nmethods = [\"centroid\"]\nvertices = [9]\n";

    #[test]
    fn a_ladder_is_read() {
        let ladder = Ladder::from_text(Path::new("a.toml"), GOOD).expect("a good config");
        assert_eq!(ladder.methods().len(), 1);
        assert_eq!(ladder.depth, LadderDepth::default());
    }

    #[test]
    fn mistakes_are_told_with_their_line() {
        for (from, to, words) in [
            ("vertices", "verties", "a.toml:4:1: found unknown key"),
            ("centroid", "median", "a.toml:3:11: found \"median\" for `ladder.methods`"),
            ("[9]", "[9, 3]", "a.toml:4:12: found 3 for `ladder.vertices`"),
            ("[\"centroid\"]", "[]", "a.toml:3:11: found an empty list"),
            ("[ladder]", "[room]\nrows = 1\n[ladder]", "a.toml:3:8: found 640 x 1 pixels"),
            ("[ladder]", "[depth]\nfar_m = nan\n[ladder]", "a.toml:3:9: found NaN"),
            ("\"a\"", "\"a/b\"", "a.toml:1:8: found \"a/b\""),
        ] {
            let text = GOOD.replacen(from, to, 1);
            let error = Ladder::from_text(Path::new("a.toml"), &text).expect_err(to).to_string();
            assert!(error.starts_with(words), "{error}");
        }
    }
}
