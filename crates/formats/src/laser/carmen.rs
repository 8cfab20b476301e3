//! Text logs of CARMEN, one message per line.
//!
//! | line | read as |
//! |---|---|
//! | `FLASER n r1..rn x y th ox oy oth t host t2` | a scan over half a circle ahead; `ox oy oth` is the odometry |
//! | `ROBOTLASER1 type start fov step max accuracy remission n r1..rn m ... lx ly lth ox oy oth ...  t host t2` | a scan that says what it covers |
//! | `ODOM x y th tv rv accel t host t2` | a pose |
//! | `PARAM robot_frontlaser_offset d ...` | the sensor is d ahead of the body, in what follows |
//!
//! Everything else is passed over and counted. A `FLASER` of n rays has its first at -90 degrees; the
//! angle between rays is 180 degrees by n, or by n - 1 where n is odd: 180 and 360 rays leave the last
//! bearing out, 181 and 361 do not. Both pose triples are poses in the odometry's frame; the second,
//! the body's, is the odometry. In logs that somebody corrected, all poses are corrected ones.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use pose::Se2;
use sensing::Scan;

use super::{LaserLog, LoggedPose, LoggedScan};
use crate::FormatError;
use crate::binary::refuse_binary;
use crate::error::quote;
use crate::lexer::Lexer;
use crate::lines::with_line_feeds;

/// Ranges from here on are "no return" in a `FLASER` line, metres: what a SICK laser gives at most
/// is 81.83 m, and some logs say 80.99.
pub const FLASER_MAX_M: f64 = 80.0;

/// The most rays that a line may announce.
const MAX_RAYS: u64 = 1 << 20;

/// Reads a log; see the module's page for what each line means.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column: a number that is none, is not finite or is
/// missing in a line of a known kind; rays that do not fit into a circle; a file without a scan.
pub fn read(bytes: &[u8]) -> Result<LaserLog, FormatError> {
    const EXPECTED: &str = "a log of CARMEN with a FLASER or ROBOTLASER1 line";
    refuse_binary(bytes, EXPECTED)?;
    let bytes = with_line_feeds(bytes);
    let mut reader = Reader {
        lexer: Lexer::new(&bytes),
        log: LaserLog::default(),
        offset_m: 0.0,
        passed_over: BTreeMap::new(),
    };
    while reader.lexer.next_line() {
        reader.line()?;
    }
    if reader.log.scans.is_empty() {
        return Err(reader.lexer.unexpected(EXPECTED));
    }
    for (tag, (line, count)) in reader.passed_over {
        reader
            .log
            .warnings
            .push(format!("line {line}: {count} line(s) start with {tag}; left out"));
    }
    Ok(reader.log)
}

struct Reader<'a> {
    lexer: Lexer<'a>,
    log: LaserLog,
    /// How far the sensor is ahead of the body, metres.
    offset_m: f64,
    /// Tags that mean nothing here: the first line and the count.
    passed_over: BTreeMap<String, (usize, usize)>,
}

impl Reader<'_> {
    fn line(&mut self) -> Result<(), FormatError> {
        let line = self.lexer.line();
        match self.lexer.word() {
            b"FLASER" => self.flaser(),
            b"ROBOTLASER1" => self.robot_laser(),
            b"ODOM" => self.odom(),
            b"PARAM" => self.param(),
            // Messages without a meaning for a map, and those of other programs that work on logs.
            b"SYNC" | b"NEFF" | b"VERTEX2" | b"EDGE2" => Ok(()),
            tag => {
                let tag = quote(&String::from_utf8_lossy(tag));
                self.passed_over.entry(tag).or_insert((line, 0)).1 += 1;
                Ok(())
            }
        }
    }

    fn param(&mut self) -> Result<(), FormatError> {
        if self.lexer.word() == b"robot_frontlaser_offset" {
            self.offset_m = self.lexer.float("the offset of the front laser")?;
        }
        Ok(())
    }

    fn odom(&mut self) -> Result<(), FormatError> {
        let [x, y, theta, _, _, _] = self.lexer.floats("x y theta tv rv accel of ODOM")?;
        let stamp_secs = self.stamp()?;
        self.log.odometry.push(LoggedPose { stamp_secs, odom_from_body: Se2::new(x, y, theta) });
        Ok(())
    }

    fn flaser(&mut self) -> Result<(), FormatError> {
        let rays = self.rays()?;
        let ranges_m = self.ranges(rays)?;
        let [_, _, _, x, y, theta] = self.lexer.floats("the two poses of FLASER")?;
        let stamp_secs = self.stamp()?;
        let parts = if rays.is_multiple_of(2) { rays } else { (rays - 1).max(1) };
        let scan = Scan::new(-FRAC_PI_2, PI / parts as f64, ranges_m, FLASER_MAX_M);
        let body_from_sensor = Se2::new(self.offset_m, 0.0, 0.0);
        let odom_from_sensor = Se2::new(x, y, theta) * body_from_sensor;
        self.log.scans.push(LoggedScan { stamp_secs, odom_from_sensor, scan });
        Ok(())
    }

    fn robot_laser(&mut self) -> Result<(), FormatError> {
        let [_, first, _, step, max_m, _, _] =
            self.lexer.floats("type start fov step max accuracy remission of ROBOTLASER1")?;
        self.lexer.at_end_of_line();
        let mark = self.lexer.mark();
        let rays = self.rays()?;
        if !(step > 0.0 && step * rays.saturating_sub(1) as f64 <= TAU + 1e-6 && max_m > 0.0) {
            let found = format!("{rays} rays {step} rad apart, up to {max_m} m");
            let expected = "rays within a circle, at a positive angle and range";
            return Err(FormatError::unexpected(self.lexer.position_of(mark), found, expected));
        }
        let ranges_m = self.ranges(rays)?;
        let remissions = self.lexer.id("the number of remissions")?;
        for _ in 0..remissions {
            self.lexer.any_float("a remission")?;
        }
        let [x, y, theta] = self.lexer.floats("the laser's pose of ROBOTLASER1")?;
        let [_, _, _] = self.lexer.floats::<3>("the robot's pose of ROBOTLASER1")?;
        let [_, _, _, _, _] = self.lexer.floats::<5>("speeds and distances of ROBOTLASER1")?;
        let stamp_secs = self.stamp()?;
        let scan = Scan::new(first, step, ranges_m, max_m);
        let odom_from_sensor = Se2::new(x, y, theta);
        self.log.scans.push(LoggedScan { stamp_secs, odom_from_sensor, scan });
        Ok(())
    }

    fn rays(&mut self) -> Result<usize, FormatError> {
        self.lexer.at_end_of_line();
        let mark = self.lexer.mark();
        let rays = self.lexer.id("the number of rays")?;
        // Each takes a digit and a blank at least.
        let limit = MAX_RAYS.min(self.lexer.left() as u64 / 2);
        if rays == 0 || rays > limit {
            let expected = format!("from 1 to {limit} rays, as many as the file has room for");
            let at = self.lexer.position_of(mark);
            return Err(FormatError::unexpected(at, rays.to_string(), expected));
        }
        Ok(rays as usize)
    }

    fn ranges(&mut self, rays: usize) -> Result<Vec<f64>, FormatError> {
        let mut ranges_m = Vec::with_capacity(rays);
        for _ in 0..rays {
            ranges_m.push(self.lexer.any_float("a range")?);
        }
        Ok(ranges_m)
    }

    /// The first stamp, the host's name and the logger's own stamp, of which the first counts.
    fn stamp(&mut self) -> Result<f64, FormatError> {
        self.lexer.float("a time stamp")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_become_scans_and_poses() {
        let text = "# CARMEN\nPARAM robot_frontlaser_offset 0.5 host 0\nPARAM x y\n\
            ODOM 1 2 0.5 0 0 0 7 host 7\n\
            FLASER 4 1 2 81.83 4 9 9 9 1 2 0 8.25 host 8\nNEFF 10\nTRUEPOS 1\n\
            ROBOTLASER1 0 -1.5 3 0.5 50 0.1 0 3 1 2 3 1 0.5 4 5 6 4 5 6 0 0 0 0 0 9 x 1\n";
        let log = read(text.as_bytes()).expect("good");
        assert_eq!(
            log.odometry,
            [LoggedPose { stamp_secs: 7.0, odom_from_body: Se2::new(1.0, 2.0, 0.5) }]
        );
        let [flaser, robot] = &log.scans[..] else { panic!("two scans") };
        assert_eq!((flaser.stamp_secs, robot.stamp_secs), (8.25, 9.0));
        assert_eq!(flaser.odom_from_sensor, Se2::new(1.5, 2.0, 0.0));
        assert_eq!(flaser.scan.bearing_step_rad, PI / 4.0);
        assert_eq!(flaser.scan.reading(2), sensing::Reading::Miss);
        assert_eq!(robot.odom_from_sensor, Se2::new(4.0, 5.0, 6.0));
        assert_eq!((robot.scan.first_bearing_rad, robot.scan.range_max_m), (-1.5, 50.0));
        assert_eq!(log.warnings, ["line 7: 1 line(s) start with `TRUEPOS`; left out"]);
        assert_eq!(log.span_secs(), 0.75);
    }

    #[test]
    fn an_odd_number_of_rays_reaches_from_side_to_side() {
        let line = format!("FLASER 181 {} 0 0 0 0 0 0 1 h 1", "1 ".repeat(181));
        let log = read(line.as_bytes()).expect("good");
        assert!((log.scans[0].scan.span_rad() - PI).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_fit_is_named_with_its_place() {
        for (text, message) in [
            ("ODOM 1 2 x 0 0 0 1 h 1", "line 1, column 10: found `x`"),
            ("FLASER 3 1 2\n", "line 1, column 8: found 3, expected from 1 to 2 rays"),
            ("FLASER 2 1 2 0 0 0 0 0\nODOM", "line 1, column 23: found the end of the line"),
            ("FLASER 99999999999 1", "line 1, column 8: found 99999999999"),
            ("FLASER 0 1", "line 1, column 8: found 0"),
            ("ODOM 1 2 3 0 0 0 1 h 1", "expected a log of CARMEN with a FLASER"),
            ("", "expected a log of CARMEN"),
            (
                "ROBOTLASER1 0 0 9 3 50 0 0 4 1 1 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1",
                "line 1, column 28: found 4 rays 3 rad apart",
            ),
        ] {
            let error = read(text.as_bytes()).expect_err(text).to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
