//! Thinning of a line while it is drawn: points that the eye could not tell from the straight line.

/// The straight line that is being drawn: from where, and which slopes still pass all its points.
///
/// Keeps, in coordinates along and across the first direction, the slopes under which a straight
/// line from the anchor passes every point left out by no more than the tolerance, across that
/// direction. Its distance across the final line is then smaller still. Cost: a few operations per
/// point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sleeve {
    anchor: [f32; 2],
    /// The first direction, of length one; none while no point but the anchor is known.
    along: Option<[f32; 2]>,
    slopes: [f32; 2],
    reach_m: f32,
}

impl Sleeve {
    /// A line that starts at a point.
    pub fn at(anchor: [f32; 2]) -> Self {
        Self { anchor, along: None, slopes: [f32::MIN, f32::MAX], reach_m: 0.0 }
    }

    /// Takes the next point; whether the one before it may be left out.
    ///
    /// Where it may not, the line goes on from the point before, `last`.
    pub fn take(&mut self, last: [f32; 2], next: [f32; 2], tolerance_m: f32) -> bool {
        if self.goes_on(next, tolerance_m) {
            return true;
        }
        *self = Self::at(last);
        self.goes_on(next, tolerance_m);
        false
    }

    /// Whether a straight line to the point passes all before it; then the point is taken.
    ///
    /// A line that turns back, however straight, does not go on: its tip would be lost.
    fn goes_on(&mut self, next: [f32; 2], tolerance_m: f32) -> bool {
        let away = [next[0] - self.anchor[0], next[1] - self.anchor[1]];
        let first = self.along.is_none();
        let along = *self.along.get_or_insert_with(|| {
            let length = away[0].hypot(away[1]).max(f32::MIN_POSITIVE);
            away.map(|a| a / length)
        });
        let reach_m = along[0] * away[0] + along[1] * away[1];
        let slope = (along[0] * away[1] - along[1] * away[0]) / reach_m;
        if reach_m <= self.reach_m || slope < self.slopes[0] || slope > self.slopes[1] {
            return false;
        }
        self.reach_m = reach_m;
        let leeway = tolerance_m / reach_m;
        self.slopes = [self.slopes[0].max(slope - leeway), self.slopes[1].min(slope + leeway)];
        !first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of a line.
    fn thinned(points: &[[f32; 2]], tolerance_m: f32) -> Vec<[f32; 2]> {
        let mut kept = vec![points[0]];
        let mut sleeve = Sleeve::at(points[0]);
        for &point in &points[1..] {
            let last = kept[kept.len() - 1];
            if sleeve.take(last, point, tolerance_m) {
                kept.pop();
            }
            kept.push(point);
        }
        kept
    }

    fn distance(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
        let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let t = ((d[0] * q[0] + d[1] * q[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
        (q[0] - t * d[0]).hypot(q[1] - t * d[1])
    }

    #[test]
    fn a_straight_wall_is_two_points_and_a_corner_stays() {
        let mut wall: Vec<_> = (0..50).map(|i| [i as f32 * 0.1, 0.001 * (i % 3) as f32]).collect();
        wall.extend((1..50).map(|i| [4.9, i as f32 * 0.1]));
        let kept = thinned(&wall, 0.01);
        assert_eq!(kept.len(), 3, "{kept:?}");
        assert!((kept[1][0] - 4.9).abs() < 1e-6 && kept[1][1] < 0.01);
    }

    #[test]
    fn a_needle_keeps_its_tip() {
        let needle = [[0.0, 0.0], [1.0, 0.0], [5.0, 0.0], [1.0, 0.0], [1.0, 2.0]];
        assert!(thinned(&needle, 0.01).contains(&[5.0, 0.0]));
    }

    #[test]
    fn points_that_fall_together_are_survived() {
        let kept = thinned(&[[1.0, 1.0], [1.0, 1.0], [2.0, 1.0], [2.0, 1.0], [3.0, 1.0]], 0.01);
        assert!(kept.iter().flatten().all(|x| x.is_finite()));
        assert_eq!((kept[0], kept[kept.len() - 1]), ([1.0, 1.0], [3.0, 1.0]));
    }

    #[test]
    fn nothing_left_out_is_farther_from_the_line_than_the_tolerance() {
        // A walk whose steps grow wilder, so that every kind of bend comes up.
        let mut state = 7_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1_u64 << 24) as f32 - 0.5
        };
        let mut at = [0.0_f32, 0.0];
        let walk: Vec<_> = (0..2_000)
            .map(|i| {
                let wild = i as f32 / 2_000.0;
                at = [at[0] + 0.05 + wild * 0.1 * random(), at[1] + wild * 0.2 * random()];
                at
            })
            .collect();
        let kept = thinned(&walk, 0.02);
        assert!(kept.len() > 10 && kept.len() < walk.len());
        let mut from = 0;
        for pair in kept.windows(2) {
            let to = from + walk[from..].iter().position(|p| *p == pair[1]).unwrap();
            for p in &walk[from..=to] {
                assert!(distance(*p, pair[0], pair[1]) < 0.02 + 1e-4);
            }
            from = to;
        }
    }
}
