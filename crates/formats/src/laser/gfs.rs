//! JSON maps `{"map": {"STAMP": {"range": [..], "x": .., "y": .., "theta": ..}, ..}}`: scans with the
//! pose of the laser, as exported from logs of GMapping's grid filter.
//!
//! Rays and "no return" are those of CARMEN's `FLASER` (see [`super::carmen`]).

use std::f64::consts::{FRAC_PI_2, PI};

use pose::Se2;
use sensing::Scan;

use super::carmen::FLASER_MAX_M;
use super::json::Json;
use super::{LaserLog, LoggedScan};
use crate::FormatError;

/// Reads a map of scans; they come in the order of their stamps, whatever that of the file.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column: no JSON, a stamp that is no number, a scan
/// without one of its parts, a file without a scan.
pub fn read(bytes: &[u8]) -> Result<LaserLog, FormatError> {
    let mut json = Json::new(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let mut log = LaserLog::default();
    json.object("an object with a `map` of scans", |json, name| match name {
        b"map" => json.object("an object of scans", |json, stamp| {
            let stamp_secs = match fast_float2::parse::<f64, _>(stamp) {
                Ok(stamp_secs) if stamp_secs.is_finite() => stamp_secs,
                _ => return Err(json.unexpected("a scan under a time stamp, a number")),
            };
            log.scans.push(scan(json, stamp_secs)?);
            Ok(())
        }),
        _ => json.skip(),
    })?;
    json.end()?;
    if log.scans.is_empty() {
        return Err(json.unexpected("a `map` with a scan"));
    }
    log.scans.sort_by(|a, b| a.stamp_secs.total_cmp(&b.stamp_secs));
    Ok(log)
}

fn scan(json: &mut Json<'_>, stamp_secs: f64) -> Result<LoggedScan, FormatError> {
    let mut ranges_m: Vec<f64> = Vec::new();
    let (mut x, mut y, mut theta) = (None, None, None);
    json.object("a scan `range`, `x`, `y`, `theta`", |json, name| {
        let number = |json: &mut Json<'_>| {
            let value = json.number("a finite number")?;
            if value.is_finite() { Ok(value) } else { Err(json.unexpected("a finite number")) }
        };
        match name {
            b"range" => json.array("an array of ranges", |json| {
                ranges_m.push(json.number("a range")?);
                Ok(())
            })?,
            b"x" => x = Some(number(json)?),
            b"y" => y = Some(number(json)?),
            b"theta" => theta = Some(number(json)?),
            _ => json.skip()?,
        }
        Ok(())
    })?;
    let (Some(x), Some(y), Some(theta), false) = (x, y, theta, ranges_m.is_empty()) else {
        return Err(json.unexpected("a scan with `range`, `x`, `y` and `theta` before"));
    };
    let rays = ranges_m.len();
    let parts = if rays.is_multiple_of(2) { rays } else { (rays - 1).max(1) };
    let scan = Scan::new(-FRAC_PI_2, PI / parts as f64, ranges_m, FLASER_MAX_M);
    Ok(LoggedScan { stamp_secs, odom_from_sensor: Se2::new(x, y, theta), scan })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scans_come_in_the_order_of_their_stamps() {
        let text = r#"{"about": [1, {"a": null, "b": "\"}"}, true], "map": {
            "20.5": {"theta": 0.5, "x": 1, "y": -2e0, "range": [1, 81.83], "more": {}},
            "10": {"range": [3.5], "x": 0, "y": 0, "theta": 0}}}"#;
        let log = read(text.as_bytes()).expect("good");
        assert_eq!(log.scans[0].scan.ranges_m, [3.5]);
        assert_eq!(log.scans[1].stamp_secs, 20.5);
        assert_eq!(log.scans[1].odom_from_sensor, Se2::new(1.0, -2.0, 0.5));
    }

    #[test]
    fn what_does_not_fit_is_named_with_its_place() {
        let nested = format!("{{\"a\": {}", "[".repeat(100));
        for (text, message) in [
            ("{\n \"map\": {\"x\": 1}}", "line 2, column 15: found `1`, expected a scan under"),
            ("{\"map\": {\"1\": {\"range\": [1], \"x\": 2}}}", "expected a scan with `range`"),
            ("{\"map\": {\"1\": {\"range\": [1, ]}}}", "column 29: found `]`, expected a range"),
            ("{\"map\": {}}", "expected a `map` with a scan"),
            ("{\"map\"", "found the end of the file, expected `:`"),
            ("{\"map\": {\"1\": {\"x\": nan}}}", "expected a finite number"),
            ("{} x", "found `x`, expected the end of the file"),
            ("\"", "expected an object"),
            (&nested, "nested at most 32 deep"),
        ] {
            let error = read(text.as_bytes()).expect_err(text).to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
