//! `[replay]` and `[sensor]` as the algorithms want them: radians, plain parameters.

use std::f64::consts::TAU;

use places::{KeyframeParams, OdometryNoise, PlaceParams};
use sensing::Scan;

use crate::config::{Replay, Sensor};

impl From<&Replay> for PlaceParams {
    fn from(replay: &Replay) -> Self {
        let mut params = Self::default();
        params.keyframes = KeyframeParams {
            distance_m: replay.keyframe_distance_m,
            angle_rad: replay.keyframe_angle_deg.to_radians(),
        };
        params.odometry = OdometryNoise {
            sigma_translation: replay.wheels_sigma_translation,
            sigma_rotation_rad: replay.wheels_sigma_rotation.to_radians(),
            sigma_turn_rad: replay.wheels_sigma_turn.to_radians(),
            ..params.odometry
        };
        params.matching.range_m = replay.match_range_m;
        params.matching.range_sigma_m = replay.range_sigma_m;
        params.candidates.radius_m = replay.place_radius_m;
        params.candidates.loop_m = replay.loop_m;
        params.candidates.sigma_limit_m = replay.place_sigma_limit_m;
        params.candidates.search_m = replay.search_m;
        params.candidates.tried = replay.tried as usize;
        params.rejection.overlap = replay.overlap;
        params.rejection.contradiction = replay.contradiction;
        params.rejection.ambiguity = replay.ambiguity;
        params.rejection.agreeing = replay.agreeing as usize;
        params
    }
}

/// Rays this much outside of the field of view still count, radians.
const SLACK_RAD: f64 = 1e-6;

impl Sensor {
    /// The part of a scan that lies in the field of view around straight ahead.
    ///
    /// A scan that lies in it as a whole stays as it is, bit for bit. One that goes round from straight ahead
    /// to straight ahead has its two ends there: they are put together. Of one that does not close, the
    /// longer end is kept.
    pub(super) fn in_view(&self, scan: Scan) -> Scan {
        let half_rad = 0.5 * self.fov_deg.to_radians() + SLACK_RAD;
        if self.fov_deg >= 360.0 || scan.is_empty() {
            return scan;
        }
        let seen = |i: usize| pose::wrap_angle(scan.bearing_rad(i)).abs() <= half_rad;
        // Rays of one turn, where the first follows the last; a ray that repeats the first does not count.
        let turn = (TAU / scan.bearing_step_rad).round();
        let is_even = (turn * scan.bearing_step_rad - TAU).abs() <= 0.5 * scan.bearing_step_rad;
        let round = (is_even && turn <= scan.len() as f64).then_some(turn as usize);
        let rays = round.unwrap_or(scan.len());
        let run = |first: usize| {
            let all = (first..first + rays).map(|i| i % rays);
            let end = if round.is_some() { rays } else { rays - first };
            all.take(end).take_while(|&i| seen(i)).count()
        };
        let starts = (0..rays).filter(|&i| {
            let before = if i > 0 { Some(i - 1) } else { round.map(|rays| rays - 1) };
            seen(i) && !before.is_some_and(seen)
        });
        let longest = starts
            .map(|first| (run(first), first))
            .max_by_key(|&(count, first)| (count, std::cmp::Reverse(first)));
        let Some((count, first)) = longest else {
            // Nothing is seen, or everything.
            return if seen(0) { scan } else { Scan { ranges_m: Vec::new(), ..scan } };
        };
        if (first, count) == (0, scan.len()) {
            return scan;
        }
        let first_bearing_rad = match first + count > rays {
            true => pose::wrap_angle(scan.bearing_rad(first)),
            false => scan.bearing_rad(first),
        };
        let ranges_m = (first..first + count).map(|i| scan.ranges_m[i % rays]).collect();
        Scan { first_bearing_rad, ranges_m, ..scan }
    }

    /// The scan as maps take it: what is farther than the range is free up to there, and unknown behind.
    pub(super) fn within_range(&self, scan: &Scan) -> Scan {
        Scan { range_max_m: scan.range_max_m.min(self.range_m), ..scan.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_algorithm() {
        assert_eq!(PlaceParams::from(&Replay::default()), PlaceParams::default());
    }

    #[test]
    fn a_scan_that_starts_straight_ahead_keeps_both_sides() {
        let step_rad = TAU / 12.0;
        let scan = Scan::new(0.0, step_rad, (0..12).map(f64::from).collect(), 30.0);
        let half = Sensor { fov_deg: 180.0, range_m: 5.0, ..Sensor::default() };
        let cut = half.in_view(scan.clone());
        assert_eq!(&cut.ranges_m[..], &[9.0, 10.0, 11.0, 0.0, 1.0, 2.0, 3.0][..]);
        assert!((cut.first_bearing_rad + 0.25 * TAU).abs() < 1e-12);
        // The same with a last ray that repeats the first, and one that ends before it closes.
        let closed = Scan::new(0.0, step_rad, (0..13).map(f64::from).collect(), 30.0);
        assert_eq!(half.in_view(closed).ranges_m, cut.ranges_m);
        let open = Scan::new(0.0, step_rad, (0..10).map(f64::from).collect(), 30.0);
        assert_eq!(&half.in_view(open).ranges_m[..], &[0.0, 1.0, 2.0, 3.0][..]);
    }

    #[test]
    fn a_view_is_cut_to_the_field_of_view() {
        let scan = Scan::new(-2.0, 0.5, (0..9).map(f64::from).collect(), 30.0);
        let narrow = Sensor { fov_deg: 2.1_f64.to_degrees(), range_m: 5.0, ..Sensor::default() };
        let cut = narrow.in_view(scan.clone());
        assert_eq!(
            (cut.first_bearing_rad, &cut.ranges_m[..]),
            (-1.0, &[2.0, 3.0, 4.0, 5.0, 6.0][..])
        );
        let wide = Sensor { fov_deg: 360.0, ..narrow };
        assert_eq!(wide.in_view(scan.clone()), scan);
        assert_eq!(wide.within_range(&scan).range_max_m, 5.0);
    }
}
