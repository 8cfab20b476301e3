//! Which kind of world a map file is.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use formats::Kind;

use super::{ConfigError, Place};

/// Bytes at the start of a file that tell its kind.
const HEAD: u64 = 1 << 16;

/// How the names of mesh files end.
const MESHES: [&str; 4] = ["obj", "stl", "ply", "off"];

/// Whether reading this might wait for ever: a pipe or a device. Folders fail by themselves.
pub fn never_ends(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// The key under `[world]` that reads this file, told by its content: `map_server`, `image` or
/// `moving_ai`; or `mesh`, the one under `[world3d]`, told by its name.
///
/// # Errors
/// A file that cannot be read, or of another kind.
pub fn world_kind_of_file(path: &Path) -> Result<&'static str, ConfigError> {
    let expected =
        "a map (map_server YAML, PGM, PNG or MovingAI .map) or a mesh (.obj, .stl, .ply or .off)";
    if never_ends(path) {
        return Err(ConfigError::Value {
            place: Place::file(path),
            found: "no ordinary file".into(),
            expected: expected.into(),
        });
    }
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.map_err(|reason| ConfigError::Unreadable {
        path: path.to_owned(),
        reason,
        expected: expected.into(),
    })?;
    let extension = path.extension().and_then(|extension| extension.to_str());
    let is_mesh = |name: &str| MESHES.iter().any(|mesh| name.eq_ignore_ascii_case(mesh));
    if extension.is_some_and(is_mesh) {
        return Ok("mesh");
    }
    match formats::sniff(&head, extension) {
        Kind::MapServerYaml => Ok("map_server"),
        Kind::Pgm | Kind::Png => Ok("image"),
        Kind::MovingAi => Ok("moving_ai"),
        kind @ (Kind::Toml | Kind::G2o | Kind::Toro | Kind::Tum | Kind::Unknown) => {
            let found = match kind {
                Kind::Toml => "a TOML file",
                Kind::G2o | Kind::Toro => "a pose graph",
                Kind::Tum => "a trajectory",
                _ => "no known kind of map",
            };
            Err(ConfigError::Value {
                place: Place::file(path),
                found: found.into(),
                expected: expected.into(),
            })
        }
    }
}
