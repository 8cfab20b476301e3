//! Logs in text, told apart by their lines.

use formats::laser::{carmen, gfs, relations};
use formats::log::{Log, plain};
use formats::{FormatError, Kind, Position, gzip, sniff, tum};

const EXPECTED: &str = "an MCAP file, a bag of ROS 1, a log of CARMEN, a JSON map of scans, relations, \
                        a TUM trajectory, or a folder of depth images";

/// Reads text of any kind, packed with gzip or not.
pub(super) fn read(bytes: &[u8], extension: Option<&str>) -> Result<Log, FormatError> {
    let bytes = gzip::unpack(bytes)?;
    if bytes.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{') {
        return Ok(plain::of_laser(&gfs::read(&bytes)?, "json map"));
    }
    // Programs that align logs leave edges of a graph before the scans.
    if is_carmen(&bytes) {
        return Ok(plain::of_laser(&carmen::read(&bytes)?, "carmen"));
    }
    match sniff(&bytes, None) {
        Kind::Tum if extension == Some("tum") => trajectory(&bytes),
        Kind::Tum if extension == Some("relations") => related(&bytes),
        // Both have eight numbers in a line.
        Kind::Tum if has_unit_quaternions(&bytes) => trajectory(&bytes),
        Kind::Tum => related(&bytes),
        Kind::Unknown => Ok(plain::of_laser(&carmen::read(&bytes)?, "carmen")),
        kind => {
            let found = format!("{} file", name_of(kind));
            let at = Position::Byte(0);
            Err(FormatError::Unexpected { at, found, expected: EXPECTED.to_owned() })
        }
    }
}

/// Whether a line is a scan of CARMEN.
fn is_carmen(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|&byte| byte == b'\n');
    lines.any(|line| line.starts_with(b"FLASER ") || line.starts_with(b"ROBOTLASER1 "))
}

fn trajectory(bytes: &[u8]) -> Result<Log, FormatError> {
    Ok(plain::of_trajectory(&tum::read(bytes)?))
}

fn related(bytes: &[u8]) -> Result<Log, FormatError> {
    Ok(plain::of_relations(&relations::read(bytes)?))
}

/// Whether the last four numbers of each of the first lines are a rotation: a relation ends with a roll and a
/// pitch, which are 0, and a yaw.
fn has_unit_quaternions(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(1 << 14)]);
    let lines = head.lines().filter(|line| !line.trim_start().starts_with('#'));
    let mut norms = lines.filter_map(|line| {
        let numbers: Vec<f64> =
            line.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let [_, _, _, _, rotation @ ..] = &numbers[..] else { return None };
        (rotation.len() == 4).then(|| rotation.iter().map(|x| x * x).sum::<f64>().sqrt())
    });
    norms.by_ref().take(64).all(|norm| (norm - 1.0).abs() < 0.01)
}

const fn name_of(kind: Kind) -> &'static str {
    match kind {
        Kind::MapServerYaml => "a map_server YAML",
        Kind::Pgm => "a PGM",
        Kind::Png => "a PNG",
        Kind::MovingAi => "a MovingAI",
        Kind::G2o => "a g2o",
        Kind::Toro => "a TORO",
        Kind::Tum => "a TUM",
        Kind::Toml => "a TOML",
        Kind::Unknown => "an unknown",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoding(text: &str, extension: Option<&str>) -> String {
        read(text.as_bytes(), extension).expect(text).topics[0].encoding.clone()
    }

    #[test]
    fn lines_tell_what_a_file_is() {
        let relation = "10 11 1 2 0 0 0 0.5\n11 12 1 2 0 0 0 1.0\n";
        assert_eq!(encoding(relation, None), "relations");
        assert_eq!(encoding("10 1 2 3 0 0 0.6 0.8\n", None), "tum");
        assert_eq!(encoding("10 1 2 3 0 0 0 2\n", Some("tum")), "tum");
        assert_eq!(encoding("10 11 1 2 0 0 0 1\n", Some("relations")), "relations");
        assert_eq!(encoding("FLASER 2 1 1 0 0 0 0 0 0 1 h 1\n", None), "carmen");
        assert_eq!(
            encoding("EDGE2 0 1 1 0 0 1 0 1 1 0 0\nFLASER 2 1 1 0 0 0 0 0 0 1 h 1\n", None),
            "carmen"
        );
        let gfs = r#"{"map": {"1": {"range": [1, 2], "x": 0, "y": 0, "theta": 0}}}"#;
        assert_eq!(encoding(gfs, None), "json map");
    }

    #[test]
    fn other_files_are_refused_by_name() {
        for (text, found) in [
            ("VERTEX_SE2 0 0 0 0\n", "byte 0: found a g2o file, expected an MCAP file"),
            ("P2 1 1 255 0", "found a PGM file"),
            ("hello\n", "expected a log of CARMEN"),
            ("", "expected a log of CARMEN"),
        ] {
            let error = read(text.as_bytes(), None).expect_err(text).to_string();
            assert!(error.contains(found), "{error}");
        }
    }
}
