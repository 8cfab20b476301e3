//! Place matches that somebody else found: a file, or a topic of the log.

use std::fs;
use std::path::Path;

use formats::log::{EdgeMessage, Transform, planar};
use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};

use super::ReplayError;
use crate::run::Input;

/// Standard deviation of a match that tells none, metres.
const SIGMA_M: f64 = 0.05;
/// The same of its heading, degrees.
const SIGMA_DEG: f64 = 1.0;

/// Which scan a match speaks of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// The one nearest to this time, seconds.
    Stamp(f64),
    /// That of the keyframe of this number.
    Keyframe(u32),
}

/// A place that was recognised elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenMatch {
    /// The line of the file that says so; `None` of a topic.
    pub line: Option<usize>,
    /// When the place was seen first.
    pub known: Moment,
    /// When it was recognised.
    pub current: Moment,
    /// The sensor at the later time in its frame at the earlier one.
    pub known_from_current: Se2,
    /// Covariance of that, in the frame of the later one.
    pub covariance: Matrix3<f64>,
}

impl GivenMatch {
    fn new(
        known: Moment,
        current: Moment,
        known_from_current: Se2,
        sigma_m: f64,
        sigma_deg: f64,
    ) -> Self {
        let turn = sigma_deg.to_radians();
        let variances = Vector3::new(sigma_m, sigma_m, turn).map(|sigma| sigma * sigma);
        let covariance = Matrix3::from_diagonal(&variances);
        let given = Self { line: None, known, current, known_from_current, covariance };
        let is_late = match (known, current) {
            (Moment::Stamp(known), Moment::Stamp(current)) => known > current,
            (Moment::Keyframe(known), Moment::Keyframe(current)) => known > current,
            _ => false,
        };
        if is_late { given.other_way() } else { given }
    }

    /// The same match told from the other end: what was recognised is the later of the two, always.
    fn other_way(self) -> Self {
        let carried = self.known_from_current.adjoint();
        Self {
            line: self.line,
            known: self.current,
            current: self.known,
            known_from_current: self.known_from_current.inverse(),
            covariance: carried * self.covariance * carried.transpose(),
        }
    }

    /// A transform between two frames whose names end in the stamps of the two scans, in seconds.
    pub(super) fn of_transform(transform: &Transform) -> Option<Self> {
        let stamp = |name: &str| {
            let number = name.rsplit(['/', '_', ' ']).next()?;
            number.parse::<f64>().ok().filter(|secs| secs.is_finite()).map(Moment::Stamp)
        };
        let (known, current) = (stamp(&transform.header.frame)?, stamp(&transform.child_frame)?);
        let pose = planar(&transform.parent_from_child);
        Some(Self::new(known, current, pose, SIGMA_M, SIGMA_DEG))
    }

    /// A place edge between two keyframes.
    pub(super) fn of_edge(edge: &EdgeMessage) -> Option<Self> {
        let (known, current) = (Moment::Keyframe(edge.a), Moment::Keyframe(edge.b));
        edge.place.then(|| Self::new(known, current, edge.a_from_b, SIGMA_M, SIGMA_DEG))
    }
}

/// Reads matches, one `t_known t_current x y theta [sigma_m sigma_deg]` a line; comments start with `#`.
///
/// A line whose first time is the later one says the same from the other end, and is turned round.
///
/// # Errors
/// [`ReplayError::Input`] with the line that is not so.
pub fn read_matches(path: &Path) -> Result<(Vec<GivenMatch>, Input), ReplayError> {
    let expected = "expected `t_known t_current x y theta [sigma_m sigma_deg]`";
    let refuse = |message: String| ReplayError::input(path, message);
    let bytes =
        fs::read(path).map_err(|error| refuse(format!("cannot be read ({error}); {expected}")))?;
    let text = formats::text(&bytes).map_err(|error| refuse(error.to_string()))?;
    let mut matches = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        let wrong =
            |found: String| refuse(format!("line {}: found {found}, {expected}", number + 1));
        let words: Vec<&str> = line.split_whitespace().collect();
        let mut numbers = Vec::with_capacity(7);
        for word in &words {
            match word.parse::<f64>() {
                Ok(value) if value.is_finite() => numbers.push(value),
                _ => return Err(wrong(format!("`{}`", word.escape_debug()))),
            }
        }
        let (pose, sigmas) = match numbers[..] {
            [a, b, x, y, theta] => ([a, b, x, y, theta], (SIGMA_M, SIGMA_DEG)),
            [a, b, x, y, theta, m, deg] if m > 0.0 && deg > 0.0 => ([a, b, x, y, theta], (m, deg)),
            [_, _, _, _, _, m, deg] => {
                return Err(wrong(format!("the deviations {m} m and {deg} deg, not above 0")));
            }
            _ => return Err(wrong(format!("{} number(s)", numbers.len()))),
        };
        let [known, current, x, y, theta] = pose;
        let (known, current) = (Moment::Stamp(known), Moment::Stamp(current));
        let measured = Se2::new(x, y, theta);
        let given = GivenMatch::new(known, current, measured, sigmas.0, sigmas.1);
        matches.push(GivenMatch { line: Some(number + 1), ..given });
    }
    Ok((matches, Input::new(path, &bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_become_matches_and_bad_ones_are_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("places.txt");
        let read = |text: &str| {
            fs::write(&path, text).expect("a disk");
            read_matches(&path).map_err(|error| error.to_string())
        };
        let (matches, input) =
            read("# head\n1 2.5 0.1 0 3 0.2 2 # far\n\n1 3 0 0 0\n").expect("good");
        assert_eq!((matches.len(), input.bytes), (2, 44));
        assert_eq!(matches[0].known, Moment::Stamp(1.0));
        assert!((matches[0].covariance[(0, 0)] - 0.04).abs() < 1e-12);
        assert_eq!((matches[0].line, matches[1].line), (Some(2), Some(4)));

        // The later time first is the same match from the other end.
        let (turned, _) = read("2.5 1 0.4 -0.3 2 0.2 2\n").expect("good");
        let one = turned[0];
        assert_eq!((one.known, one.current), (Moment::Stamp(1.0), Moment::Stamp(2.5)));
        let there_and_back = one.known_from_current * Se2::new(0.4, -0.3, 2.0);
        assert!(there_and_back.log().norm() < 1e-12, "{there_and_back:?}");
        // As far as it is unsure of the turn, it is unsure of what lies across at 0.5 m.
        let turn = 2.0_f64.to_radians();
        let expected = 2.0 * 0.04 + (0.5 * turn).powi(2);
        assert!((one.covariance[(0, 0)] + one.covariance[(1, 1)] - expected).abs() < 1e-12);

        for (text, found) in [
            ("1 2 3\n", "line 1: found 3 number(s)"),
            ("\n1 2 x 0 0\n", "line 2: found `x`"),
            ("1 2 0 0 0 0 1\n", "found the deviations 0 m"),
            ("1 2 inf 0 0\n", "found `inf`"),
        ] {
            let message = read(text).expect_err(text);
            assert!(message.contains(found) && message.contains("t_known"), "{message}");
        }
    }
}
