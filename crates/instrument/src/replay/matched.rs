//! Matches of scans: both before and after, and what was found of them.

use geometry::Point2;
use places::{Matched, Verdict};
use pose::Se2;
use pose::nalgebra::Matrix2;
use rerun::{RecordingStream, TextDocument};

use crate::InstrumentError;
use crate::columns::{Lines, Now, Points, Rgba};
use crate::palette;

/// Points of either side that are drawn, at most.
const DRAWN: usize = 500;

/// Ellipses are drawn with this many standard deviations.
const SIGMAS: f64 = 3.0;

/// Rows of `match/..`.
pub(super) struct Matches {
    known: Points,
    before: Points,
    after: Points,
    ellipse: Lines,
    robots: [Lines; 2],
}

fn of(verdict: Verdict) -> Rgba {
    match verdict {
        Verdict::Believed => palette::BEST,
        Verdict::Waits => palette::WORST,
        _ => palette::GOAL,
    }
}

impl Matches {
    pub fn new() -> Self {
        let robot = |name: &str| Lines::new(format!("match/{name}/robot"), -1.6, 40.0);
        Self {
            known: Points::new("match/known", -1.6, 5.0),
            before: Points::new("match/before/current", -1.6, 10.0),
            after: Points::new("match/after/current", -1.6, 10.0),
            ellipse: Lines::new("match/after/covariance", -1.2, 30.0),
            robots: [robot("before"), robot("after")],
        }
    }

    /// Draws a match, in the frame of the known keyframe.
    pub fn draw(&mut self, matched: &Matched<'_>, now: &Now) {
        let every = |count: usize| count.div_ceil(DRAWN).max(1);
        for point in matched.known_points.iter().step_by(every(matched.known_points.len())) {
            self.known.point(&point.point, palette::WALL_CLOSED);
        }
        self.known.end_row(now);
        let step = every(matched.current_points.len());
        let colour = of(matched.verdict);
        for point in matched.current_points.iter().step_by(step) {
            self.before.point(&matched.before.transform(&point.point), palette::MISS);
            self.after.point(&matched.after.transform(&point.point), colour);
        }
        self.before.end_row(now);
        self.after.end_row(now);
        let poses = [&matched.before, &matched.after];
        for (lines, pose) in self.robots.iter_mut().zip(poses) {
            crate::recorder::draw_robot(lines, pose);
            lines.end_row(now);
        }
        if let Some(ellipse) = ellipse(&matched.after, &matched.covariance) {
            self.ellipse.strip(ellipse, palette::ROBOT);
        }
        self.ellipse.end_row(now);
    }

    /// Says in words what came of a match.
    pub fn tell(matched: &Matched<'_>, stream: &RecordingStream) -> Result<(), InstrumentError> {
        let sigma = |i: usize| matched.covariance[(i, i)].max(0.0).sqrt();
        let moved = matched.before.inverse_mul(&matched.after);
        let mut page = format!(
            "## {}\n\nkeyframe {} against {}\n\n| | |\n|---|---|\n| moved by the match | {:.3} m, {:.2} deg |\n\
             | residual | {:.3} m |\n| deviations along, across, of the heading | {:.3} m, {:.3} m, {:.2} deg |\n\
             | explained | {:.0} % |\n| contradicted | {:.0} % |\n",
            matched.verdict.name(),
            matched.current,
            matched.known,
            moved.distance(),
            moved.angle().to_degrees(),
            matched.residual_m,
            sigma(0),
            sigma(1),
            sigma(2).to_degrees(),
            100.0 * matched.agreement.overlap,
            100.0 * matched.agreement.contradiction,
        );
        if let Some(found) = &matched.found {
            page.push_str(&format!(
                "| score, and of the best pose elsewhere | {:.2}, {:.2} |\n",
                found.score, found.elsewhere
            ));
        }
        stream.log("match/verdict", &TextDocument::from_markdown(page)).map_err(|error| {
            InstrumentError::Rows { entity: "match/verdict".into(), reason: error.to_string() }
        })
    }

    pub fn held_bytes(&self) -> usize {
        self.known.held_bytes() + self.before.held_bytes() + self.after.held_bytes()
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.known.send(stream)?;
        self.before.send(stream)?;
        self.after.send(stream)?;
        self.ellipse.send(stream)?;
        self.robots.iter_mut().try_for_each(|lines| lines.send(stream))
    }
}

/// The ellipse of a position's covariance, which is given in the frame of the pose.
fn ellipse(
    known_from_current: &Se2,
    covariance: &pose::nalgebra::Matrix3<f64>,
) -> Option<Vec<Point2>> {
    const CORNERS: u32 = 24;
    let block = Matrix2::new(
        covariance[(0, 0)],
        covariance[(0, 1)],
        covariance[(1, 0)],
        covariance[(1, 1)],
    );
    // What is not known at all has no ellipse.
    let eigen = block.symmetric_eigen();
    if eigen.eigenvalues.iter().any(|value| !value.is_finite() || *value < 0.0 || *value > 100.0) {
        return None;
    }
    let axes = eigen.eigenvectors * Matrix2::from_diagonal(&eigen.eigenvalues.map(f64::sqrt));
    let corner = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(CORNERS)).sin_cos();
        let offset = axes * pose::nalgebra::Vector2::new(cos, sin) * SIGMAS;
        known_from_current.transform(&Point2::from(offset))
    };
    Some((0..=CORNERS).map(corner).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pose::nalgebra::{Matrix3, Vector3};

    #[test]
    fn an_ellipse_has_the_deviations_as_axes() {
        let covariance = Matrix3::from_diagonal(&Vector3::new(0.04, 0.01, 1.0));
        let corners = ellipse(&Se2::new(1.0, 2.0, 0.0), &covariance).expect("finite");
        let reach =
            |along: fn(&Point2) -> f64| corners.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        assert!((reach(|p| p.x) - 1.6).abs() < 1e-9 && (reach(|p| p.y) - 2.3).abs() < 1e-9);
        assert_eq!(ellipse(&Se2::identity(), &(Matrix3::identity() * 1e6)), None);
    }
}
