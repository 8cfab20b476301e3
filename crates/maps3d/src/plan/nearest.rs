//! The goal next to a point: a tree of points, split at medians.

use solid::Point3;

/// Points per leaf.
const LEAF: usize = 8;

/// A tree of points.
#[derive(Clone, Debug, Default)]
pub(super) struct NearestPoint {
    /// Halved again and again: the middle of each range splits it along the axis of its depth.
    points: Vec<Point3>,
    axes: Vec<u8>,
}

impl NearestPoint {
    /// O(n log n).
    pub fn new(mut points: Vec<Point3>) -> Self {
        let mut axes = vec![0; points.len()];
        let mut waiting = vec![(0, points.len())];
        while let Some((start, end)) = waiting.pop() {
            if end - start <= LEAF {
                continue;
            }
            let range = &mut points[start..end];
            let (low, high) =
                range.iter().fold((range[0], range[0]), |(low, high), p| (low.inf(p), high.sup(p)));
            let axis = (high - low).imax();
            let half = range.len() / 2;
            range.select_nth_unstable_by(half, |p, q| p[axis].total_cmp(&q[axis]));
            axes[start + half] = axis as u8;
            waiting.extend([(start, start + half), (start + half + 1, end)]);
        }
        Self { points, axes }
    }

    /// Distance to the nearest point, metres; infinite without points. O(log n) expected.
    pub fn distance_m(&self, from: &Point3) -> f64 {
        let mut least = f64::INFINITY;
        self.search(from, 0, self.points.len(), &mut least);
        least.sqrt()
    }

    /// Depth of the recursion is the logarithm of the number of points.
    fn search(&self, from: &Point3, start: usize, end: usize, least: &mut f64) {
        if end - start <= LEAF {
            for point in &self.points[start..end] {
                *least = least.min((point - from).norm_squared());
            }
            return;
        }
        let middle = start + (end - start) / 2;
        let (point, axis) = (&self.points[middle], usize::from(self.axes[middle]));
        *least = least.min((point - from).norm_squared());
        let beyond = from[axis] - point[axis];
        let (near, far) = if beyond < 0.0 {
            ((start, middle), (middle + 1, end))
        } else {
            ((middle + 1, end), (start, middle))
        };
        self.search(from, near.0, near.1, least);
        if beyond * beyond <= *least {
            self.search(from, far.0, far.1, least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_agrees_with_looking_at_all() {
        let mut state = 1_u64;
        let mut unit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let mut point = || Point3::new(unit(), unit(), (unit() * 4.0).floor());
        for count in [0, 1, 8, 9, 300] {
            let points: Vec<Point3> = (0..count).map(|_| point()).collect();
            let tree = NearestPoint::new(points.clone());
            for _ in 0..100 {
                let from = point();
                let all =
                    points.iter().map(|p| (p - from).norm_squared()).fold(f64::INFINITY, f64::min);
                assert_eq!(tree.distance_m(&from), all.sqrt());
            }
        }
    }
}
