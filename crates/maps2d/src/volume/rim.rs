//! What bounds a view, by direction: an index over the boundary that answers "nothing near" at once.

use geometry::Point2;
use geometry::planar::{StarPolygon, point_segment_distance};
use geometry::predicates::cross;

use super::ObstacleEdge;

/// Directions that are told apart. More cost memory in every volume and answer hardly better: a laser's
/// rays are half a degree apart or more, and frontier edges span many of them.
const DIRECTIONS: usize = 64;

/// The angle between neighbouring directions is at least this, radians: a quarter turn is cut into equal
/// parts of `y / (x + y)`, of which a radian spans one at most.
const LEAST_ANGLE_RAD: f64 = 4.0 / DIRECTIONS as f64;

/// How far a view reaches, and what is solid in it, by direction; anchor frame.
///
/// An index and nothing more: it only leaves out what is certainly far, by a margin above rounding.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rim {
    /// The farthest boundary point in each direction, metres; 0 where nothing was seen.
    farthest_m: Vec<f64>,
    /// Where the solid parts of each direction start in `solid`; one more than directions.
    starts: Vec<u32>,
    /// Numbers of solid parts, obstacle edges and then posts, in each direction that they are seen in;
    /// and whether they are seen in the one before as well.
    solid: Vec<(u32, bool)>,
}

impl Rim {
    /// The rim of nothing.
    pub fn empty() -> Self {
        Self {
            farthest_m: vec![0.0; DIRECTIONS],
            starts: vec![0; DIRECTIONS + 1],
            solid: Vec::new(),
        }
    }

    /// The rim of a view. O(n).
    pub fn new(polygon: &StarPolygon, obstacles: &[ObstacleEdge], posts: &[Point2]) -> Self {
        let mut rim = Self::empty();
        for i in (0..polygon.len()).filter(|&i| !polygon.is_gap(i)) {
            let (from, to) = (polygon.vertex(i), polygon.vertex(polygon.next(i)));
            rim.reach(&from, &to);
        }
        // A post may stand between two gaps, where no chord tells of it.
        for post in posts {
            rim.reach(post, post);
        }
        let walls = obstacles.iter().map(|wall| (wall.from, wall.to));
        let parts = walls.chain(posts.iter().map(|post| (*post, *post)));
        let mut by_direction: Vec<(usize, (u32, bool))> = Vec::new();
        for (number, (from, to)) in parts.enumerate() {
            let arc = Arc::over(&from, &to);
            let part = |d: usize| (d, (number as u32, d != arc.first));
            by_direction.extend(arc.directions().map(part));
        }
        by_direction.sort_unstable();
        rim.solid = by_direction.iter().map(|part| part.1).collect();
        for direction in 0..=DIRECTIONS {
            rim.starts[direction] = by_direction.partition_point(|part| part.0 < direction) as u32;
        }
        rim
    }

    fn reach(&mut self, from: &Point2, to: &Point2) {
        let reach_m = from.coords.norm().max(to.coords.norm());
        for direction in Arc::over(from, to).directions() {
            self.farthest_m[direction] = self.farthest_m[direction].max(reach_m);
        }
    }

    /// Whether a segment is certainly farther than a margin from everything that was seen: no point of
    /// it lies inside the view, or so near its boundary.
    pub fn is_clear_of(&self, from: &Point2, to: &Point2, margin_m: f64) -> bool {
        self.near(from, to, margin_m).is_none()
    }

    /// The directions in which what was seen may come so near to a segment; none where it certainly does not.
    fn near(&self, from: &Point2, to: &Point2, margin_m: f64) -> Option<Arc> {
        let nearest_m = point_segment_distance(&Point2::origin(), from, to);
        let arc = Arc::around(from, to, nearest_m, margin_m);
        let farthest_m = arc.directions().map(|d| self.farthest_m[d]).fold(0.0, f64::max);
        let is_clear = nearest_m > (farthest_m + margin_m) * (1.0 + 1e-9);
        (!is_clear).then_some(arc)
    }

    /// The numbers of the solid parts that may come so near to a segment, each once, in the order of
    /// their directions; obstacle edges first, then posts. Replaces what `out` holds.
    pub fn solid_near(&self, from: &Point2, to: &Point2, margin_m: f64, out: &mut Vec<u32>) {
        out.clear();
        let Some(arc) = self.near(from, to, margin_m) else { return };
        for (i, direction) in arc.directions().enumerate() {
            let (start, end) = (self.starts[direction], self.starts[direction + 1]);
            let parts = &self.solid[start as usize..end as usize];
            out.extend(parts.iter().filter(|part| i == 0 || !part.1).map(|part| part.0));
        }
    }

    pub fn heap_bytes(&self) -> usize {
        self.farthest_m.len() * size_of::<f64>()
            + self.starts.len() * size_of::<u32>()
            + self.solid.len() * size_of::<(u32, bool)>()
    }
}

/// Neighbouring directions, counter-clockwise.
#[derive(Clone, Copy, Debug)]
struct Arc {
    first: usize,
    count: usize,
}

impl Arc {
    /// The directions in which a segment is seen; rounding may add or leave out one at its ends.
    fn over(from: &Point2, to: &Point2) -> Self {
        let (from, to) = if cross(from, to) >= 0.0 { (from, to) } else { (to, from) };
        let (first, last) = (direction_of(from), direction_of(to));
        let count = (last + DIRECTIONS - first) % DIRECTIONS + 1;
        Self { first, count }
    }

    /// The directions of everything that is within a margin of a segment, whose nearest point is so far
    /// from the anchor.
    fn around(from: &Point2, to: &Point2, nearest_m: f64, margin_m: f64) -> Self {
        if nearest_m <= 2.0 * margin_m || nearest_m == 0.0 {
            return Self { first: 0, count: DIRECTIONS };
        }
        // The arc sine of at most a half is at most 1.05 times its argument.
        let angle_rad = 1.05 * margin_m / nearest_m;
        Self::over(from, to).wider(1 + (angle_rad / LEAST_ANGLE_RAD).ceil() as usize)
    }

    fn wider(self, by: usize) -> Self {
        let count = self.count + 2 * by;
        if count >= DIRECTIONS {
            return Self { first: 0, count: DIRECTIONS };
        }
        Self { first: (self.first + DIRECTIONS - by) % DIRECTIONS, count }
    }

    fn directions(self) -> impl Iterator<Item = usize> {
        (self.first..self.first + self.count).map(|d| d % DIRECTIONS)
    }
}

/// The direction of a point, counter-clockwise from the negative y axis; 0 at the anchor.
fn direction_of(p: &Point2) -> usize {
    let sum = p.x.abs() + p.y.abs();
    if sum.is_nan() || sum <= 0.0 {
        return 0;
    }
    let share = p.y / sum;
    let turned = if p.x >= 0.0 { 1.0 + share } else { 3.0 - share };
    ((turned * (DIRECTIONS as f64 / 4.0)) as usize).min(DIRECTIONS - 1)
}

#[cfg(test)]
mod tests {
    use geometry::planar::segment_segment_distance;
    use proptest::prelude::*;

    use super::*;
    use crate::volume::EdgeKey;

    fn polar(radius_m: f64, bearing_rad: f64) -> Point2 {
        Point2::new(radius_m * bearing_rad.cos(), radius_m * bearing_rad.sin())
    }

    /// A view of alternating walls and openings, with a gap where a range is below 1 m.
    fn view(ranges_m: &[f64]) -> (StarPolygon, Vec<ObstacleEdge>, Vec<Point2>) {
        let n = ranges_m.len();
        let at = |i: usize| polar(ranges_m[i % n], i as f64 / n as f64 * std::f64::consts::TAU);
        let vertices: Vec<Point2> = (0..n).map(at).collect();
        let gaps: Vec<bool> = ranges_m.iter().map(|range| *range < 1.0).collect();
        let walls = (0..n).filter(|&i| i % 2 == 0 && !gaps[i]);
        let walls = walls
            .map(|i| ObstacleEdge { key: EdgeKey(2 * i as u32), from: at(i), to: at(i + 1) })
            .collect();
        let posts = (0..n).filter(|i| i % 5 == 1).map(at).collect();
        (StarPolygon::try_new(vertices, gaps).expect("ordered by bearing"), walls, posts)
    }

    fn point() -> impl Strategy<Value = Point2> {
        (-9.0..9.0, -9.0..9.0).prop_map(|(x, y)| Point2::new(x, y))
    }

    proptest! {
        #[test]
        fn what_is_left_out_is_far(
            ranges_m in prop::collection::vec(0.3..8.0f64, 5..80),
            from in point(),
            to in point(),
            margin_m in 0.0..1.0f64,
        ) {
            let (polygon, walls, posts) = view(&ranges_m);
            let rim = Rim::new(&polygon, &walls, &posts);
            let solid = walls.iter().map(|wall| (wall.from, wall.to));
            let solid: Vec<_> = solid.chain(posts.iter().map(|post| (*post, *post))).collect();
            let mut near = Vec::new();
            rim.solid_near(&from, &to, margin_m, &mut near);
            for (number, (a, b)) in solid.iter().enumerate() {
                if segment_segment_distance(&from, &to, a, b) <= margin_m {
                    prop_assert!(near.contains(&(number as u32)), "{number} is near");
                }
            }
            if rim.is_clear_of(&from, &to, margin_m) {
                prop_assert!(near.is_empty());
                let mut inside = Vec::new();
                polygon.clip(&from, &to, &mut inside);
                prop_assert!(inside.is_empty());
            }
        }
    }

    #[test]
    fn most_of_what_is_far_is_left_out() {
        let (polygon, walls, posts) = view(&[4.0; 72]);
        let rim = Rim::new(&polygon, &walls, &posts);
        let (from, to) = (polar(5.0, 0.1), polar(5.0, 0.3));
        assert!(rim.is_clear_of(&from, &to, 0.3));
        let mut near = Vec::new();
        rim.solid_near(&polar(4.2, 0.1), &polar(4.2, 0.3), 0.3, &mut near);
        assert!(!near.is_empty() && near.len() < 20, "{}", near.len());
    }

    #[test]
    fn a_rim_of_nothing_is_clear_of_everything() {
        let rim = Rim::empty();
        assert!(rim.is_clear_of(&Point2::new(1.0, 0.0), &Point2::new(0.0, 1.0), 0.3));
    }
}
