//! Which way to turn on the spot (step 1).

use geometry::Point3;

use super::FlightExplorer;

/// How far from the border of the image a point must be to count as in it, pixels.
pub(super) const BORDER_PX: f64 = 3.0;

/// How far within an image a direction is that was looked into, pixels. Its sides are frontier themselves.
const LOOKED_PX: f64 = 1.5;

/// What must have been looked at on both sides of a flight, radians: beside it a wall may stand, and be as
/// near as noise pushed the robot.
const ROOM_RAD: f64 = 30.0 * std::f64::consts::PI / 180.0;

impl FlightExplorer {
    /// The yaw towards a place in the frame of the vertex, where nobody looked that way from here with room on
    /// both sides; `None` where somebody did, or looking would not help.
    pub(super) fn blind_yaw(&self, place: &Point3) -> Option<f64> {
        let lens = self.lens?;
        let seen = self.seen.get(self.hovering.vertex)?;
        if place.x.hypot(place.y) < 1e-3 {
            return None;
        }
        let yaw_rad = place.y.atan2(place.x);
        let sides = [-1.0, 0.0, 1.0].map(|side| {
            let (sin, cos) = (yaw_rad + side * ROOM_RAD).sin_cos();
            Point3::new(cos, sin, 0.0)
        });
        let is_blind = sides.iter().any(|side| !seen.has_in_view(side, 0.0));
        let helps = sides.iter().all(|side| lens.sees(yaw_rad, side, 0.0));
        (is_blind && helps).then_some(yaw_rad)
    }

    /// The yaw in the frame of the vertex from which most of the frontier that nobody looked at from here
    /// comes into view: targets that the robot came for, and what the views of here leave open.
    ///
    /// `None` where that is less than `least_m2`.
    pub(super) fn best_yaw(&self, least_m2: f64) -> Option<f64> {
        let lens = self.lens?;
        let here = self.hovering.vertex;
        let seen = self.seen.get(here)?;
        let mut points: Vec<(Point3, f64)> = self
            .targets
            .iter()
            .filter(|target| !seen.has_in_view(&target.at, BORDER_PX))
            .map(|target| (target.at, target.area_m2))
            .collect();
        let is_news = |point: &Point3| !seen.has_in_view(point, LOOKED_PX);
        for patch in self.patches.iter().filter(|patch| patch.owner == here) {
            let news = patch.points.iter().filter(|point| is_news(&point.in_body));
            points.extend(news.map(|point| (point.in_body, point.area_m2)));
        }
        let gain_m2 = |yaw_rad: f64| -> f64 {
            let in_view = points.iter().filter(|(point, _)| lens.sees(yaw_rad, point, BORDER_PX));
            in_view.map(|(_, area_m2)| area_m2).sum()
        };
        let best = |yaws: &[f64]| -> Option<(f64, f64)> {
            let mut best: Option<(f64, f64)> = None;
            for &yaw_rad in yaws {
                let gain_m2 = gain_m2(yaw_rad);
                if best.is_none_or(|(most_m2, _)| gain_m2 > 1.001 * most_m2) {
                    best = Some((gain_m2, yaw_rad));
                }
            }
            best.filter(|(gain_m2, _)| *gain_m2 > 0.0 && *gain_m2 >= least_m2)
        };
        // Quarter turns overlap least; any other yaw only where it shows clearly more.
        let first_rad = seen.first_yaw_rad.unwrap_or(self.yaw_rad());
        let turns = |step_rad: f64, count: u32| -> Vec<f64> {
            (0..count).map(|i| first_rad + step_rad * f64::from(i)).collect()
        };
        let straight = points.iter().take(32).map(|(point, _)| point.y.atan2(point.x));
        let mut any = turns(std::f64::consts::FRAC_PI_4, 8);
        any.extend(straight);
        let any = best(&any)?;
        let quarter = best(&turns(std::f64::consts::FRAC_PI_2, 4));
        let is_new = !seen.is_empty();
        let chosen = quarter.filter(|quarter| is_new && quarter.0 > 0.7 * any.0).unwrap_or(any);
        Some(chosen.1)
    }
}
