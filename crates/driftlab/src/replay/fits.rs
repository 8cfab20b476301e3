//! Whether what is given beside a log speaks of it: matches and relations of another log say nothing of this one.

use formats::laser::relations::Relation;

use super::PlanarLog;
use super::between::nearest;
use super::given::{GivenMatch, Moment};
use super::relations::is_within;

/// A scan farther from the time of a given match is not the one that it speaks of, seconds.
const NEAR_SECS: f64 = 0.5;

/// The scan that a match means by a time, if any is near enough; seconds.
pub(super) fn scan_at(log: &PlanarLog, secs: f64) -> Option<usize> {
    let (scan, gap_secs) = nearest(log, secs)?;
    (gap_secs <= NEAR_SECS && !log.scans[scan].scan.is_empty()).then_some(scan)
}

/// What of the matches is left out, one line each; nothing where all of them speak of two scans of the log.
pub fn unmatched(log: &PlanarLog, matches: &[GivenMatch]) -> Vec<String> {
    if matches.is_empty() {
        return vec!["found no place match".to_owned()];
    }
    let scan = |moment: Moment| match moment {
        Moment::Stamp(secs) => scan_at(log, secs),
        // There are not more keyframes than scans.
        Moment::Keyframe(keyframe) => Some(keyframe as usize).filter(|&at| at < log.scans.len()),
    };
    let (mut unknown, mut single) = (Lost::default(), Lost::default());
    for (index, one) in matches.iter().enumerate() {
        match (scan(one.known), scan(one.current)) {
            (Some(known), Some(current)) if known == current => single.note(one, index),
            (Some(_), Some(_)) => {}
            _ => unknown.note(one, index),
        }
    }
    let all = matches.len();
    let none_near = format!("have no scan of the log within {NEAR_SECS} s of one of their times");
    let lost = [(unknown, none_near), (single, "name the same scan twice".to_owned())];
    lost.iter().filter_map(|(lost, why)| lost.told(all, why)).collect()
}

/// That no relation lies within the time of the log, if it is so.
pub fn unrelated(log: &PlanarLog, relations: &[Relation]) -> Option<String> {
    if relations.iter().any(|relation| is_within(log, relation)) {
        return None;
    }
    let (first, last) = (log.scans.first()?.stamp_secs, log.scans.last()?.stamp_secs);
    let count = relations.len();
    Some(format!("none of {count} relation(s) lies within the log, from {first} s to {last} s"))
}

/// Matches that are left out for one reason.
#[derive(Clone, Debug, Default)]
struct Lost {
    count: usize,
    first: String,
}

impl Lost {
    fn note(&mut self, one: &GivenMatch, index: usize) {
        if self.count == 0 {
            self.first = match one.line {
                Some(line) => format!("line {line}"),
                None => format!("match {}", index + 1),
            };
        }
        self.count += 1;
    }

    fn told(&self, all: usize, why: &str) -> Option<String> {
        let Self { count, first } = self;
        let told = || format!("{count} of {all} place match(es) {why}; left out, first {first}");
        (*count > 0).then(told)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formats::laser::LoggedScan;
    use pose::Se2;
    use pose::nalgebra::Matrix3;
    use sensing::Scan;

    fn log() -> PlanarLog {
        let scan = |i: u32| LoggedScan {
            stamp_secs: f64::from(i) * 2.0,
            odom_from_sensor: Se2::identity(),
            scan: Scan::new(0.0, 0.1, vec![1.0], 5.0),
        };
        PlanarLog { scans: (0..4).map(scan).collect(), ..PlanarLog::default() }
    }

    #[test]
    fn what_speaks_of_no_scan_is_counted_and_its_first_line_named() {
        let one = |line: usize, known: f64, current: f64| GivenMatch {
            line: Some(line),
            known: Moment::Stamp(known),
            current: Moment::Stamp(current),
            known_from_current: Se2::identity(),
            covariance: Matrix3::identity(),
        };
        assert_eq!(unmatched(&log(), &[one(1, 0.1, 5.9), one(2, 2.4, 6.4)]), [""; 0]);
        assert_eq!(unmatched(&log(), &[]), ["found no place match"]);
        let all = [one(2, 0.0, 2.0), one(3, 0.0, 6.6), one(4, 1.0, 2.0), one(7, 1.9, 2.1)];
        let told = unmatched(&log(), &all);
        assert_eq!(
            told,
            [
                "2 of 4 place match(es) have no scan of the log within 0.5 s of one of their times; \
                 left out, first line 3",
                "1 of 4 place match(es) name the same scan twice; left out, first line 7",
            ]
        );
        let keyframes = GivenMatch {
            line: None,
            known: Moment::Keyframe(0),
            current: Moment::Keyframe(4),
            ..one(0, 0.0, 0.0)
        };
        let told = unmatched(&log(), &[keyframes]);
        assert!(told[0].ends_with("first match 1"), "{told:?}");
    }

    #[test]
    fn relations_of_another_log_are_told() {
        let one =
            |from_secs, to_secs| Relation { from_secs, to_secs, from_from_to: Se2::identity() };
        assert_eq!(unrelated(&log(), &[one(90.0, 91.0), one(0.0, 6.0)]), None);
        let told = unrelated(&log(), &[one(90.0, 91.0), one(0.0, 7.0)]);
        let expected = "none of 2 relation(s) lies within the log, from 0 s to 6 s";
        assert_eq!(told.as_deref(), Some(expected));
    }
}
