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

/// What a file is that [`laser::read`](formats::laser::read) cannot read, and what it should be; `None` where it
/// is a log of a laser, with something wrong inside that the reader tells better.
pub(crate) fn no_laser_log(bytes: &[u8]) -> Option<FormatError> {
    const EXPECTED: &str = "an MCAP file, a bag of ROS 1, a log of CARMEN with a FLASER or ROBOTLASER1 \
                            line, or a JSON map of scans";
    let bytes = gzip::unpack(bytes).ok()?;
    let found = match bytes.iter().find(|byte| !byte.is_ascii_whitespace()) {
        None => "an empty file".to_owned(),
        Some(b'{') => return None,
        Some(_) if is_carmen(&bytes) => return None,
        Some(_) => match sniff(&bytes, None) {
            Kind::Unknown => "a file of no known kind".to_owned(),
            kind => format!("{} file", name_of(kind)),
        },
    };
    let at = Position::Byte(0);
    Some(FormatError::Unexpected { at, found, expected: EXPECTED.to_owned() })
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
    fn what_is_no_log_of_a_laser_is_named_with_all_that_would_be() {
        let told = |bytes: &[u8]| no_laser_log(bytes).map(|error| error.to_string());
        for (bytes, found) in [
            (&b"\x89PNG\r\n\x1a\n\0\0"[..], "found a PNG file"),
            (b"", "found an empty file"),
            (b" \n", "found an empty file"),
            (b"0 1 2\0\x01", "found a file of no known kind"),
            (b"10 1 2 3 0 0 0.6 0.8\n", "found a TUM file"),
        ] {
            let told = told(bytes).expect(found);
            assert!(told.contains(found), "{told}");
            for form in ["MCAP", "bag of ROS 1", "CARMEN with a FLASER", "JSON"] {
                assert!(told.contains(form), "{told}");
            }
        }
        for bytes in [&b"ODOM 1\nFLASER 3 1\n"[..], b"ROBOTLASER1 x", b" {\"map\": 1}"] {
            assert_eq!(told(bytes), None);
        }
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
