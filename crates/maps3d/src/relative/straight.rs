//! A path through several volumes without bends that it can do without.

use solid::Point3;

use crate::plan::Space;

/// Tetrahedra that leave a gap no longer than this on a line leave none, metres: points are rounded.
const GAP_M: f64 = 1e-6;

/// Whether a ball may go straight from one point to another: the line lies in volumes, whichever, and no obstacle
/// face of any is nearer to it than `keeps_m`.
pub(super) fn is_open(space: &Space, from: &Point3, to: &Point3, keeps_m: f64) -> bool {
    space.obstacles().near_segment(from, to, keeps_m).is_none() && space.covers(from, to, GAP_M)
}

/// The same path without bends that it can do without. Where one volume is left for another a plan passes
/// through tetrahedra of both, wherever these are.
///
/// From each point it goes straight to the last that it may. O(n²) lines for n points.
pub(super) fn drawn_straight(space: &Space, path: &[Point3], keeps_m: f64) -> Vec<Point3> {
    let mut points = Vec::with_capacity(path.len());
    let mut at = 0;
    while let Some(point) = path.get(at) {
        points.push(*point);
        let farther = (at + 2..path.len()).rev();
        let next = farther.into_iter().find(|&to| is_open(space, point, &path[to], keeps_m));
        at = next.unwrap_or(at + 1);
    }
    points
}

#[cfg(test)]
mod tests {
    use solid::{Label, Polyhedron, Tetrahedra, tetrahedralize};

    use super::*;
    use crate::plan::polyline_m;

    fn room(low: [f64; 3], high: [f64; 3], label: Label) -> Tetrahedra {
        let room = Polyhedron::cuboid(&Point3::from(low), &Point3::from(high), label);
        tetrahedralize(&room).expect("a box")
    }

    /// Two boxes that overlap in a corner: an L.
    fn corner() -> Space {
        let along = room([0.0, 0.0, 0.0], [6.0, 1.0, 2.0], Label::Frontier);
        let across = room([5.0, 0.0, 0.0], [6.0, 6.0, 2.0], Label::Frontier);
        Space::new(&[&along, &across]).expect("two boxes")
    }

    #[test]
    fn bends_within_what_is_free_are_left_out_and_corners_stay() {
        let space = corner();
        let path =
            [[0.5, 0.5], [2.0, 0.9], [3.0, 0.1], [5.5, 0.5], [5.2, 2.0], [5.9, 3.0], [5.5, 5.5]];
        let path = path.map(|[x, y]| Point3::new(x, y, 1.0));
        let drawn = drawn_straight(&space, &path, 1e-3);
        assert_eq!(drawn, [path[0], path[3], path[6]]);
        assert!(polyline_m(&drawn) < polyline_m(&path));
        assert!(!is_open(&space, &path[0], &path[6], 1e-3));
        assert_eq!(drawn_straight(&space, &path[..1], 1e-3), path[..1]);
        assert!(drawn_straight(&space, &[], 1e-3).is_empty());
    }

    #[test]
    fn what_is_too_near_to_an_obstacle_is_no_straight_line() {
        let room = room([0.0, 0.0, 0.0], [6.0, 3.0, 2.0], Label::Obstacle);
        let space = Space::new(&[&room]).expect("a box");
        let path = [[0.5, 0.5], [3.0, 1.5], [5.5, 0.5]].map(|[x, y]| Point3::new(x, y, 1.0));
        assert_eq!(drawn_straight(&space, &path, 0.49), [path[0], path[2]]);
        assert_eq!(drawn_straight(&space, &path, 0.51), path);
        assert!(is_open(&space, &path[0], &path[2], 0.49));
        // Beyond the wall there is nothing to go through.
        assert!(!is_open(&space, &path[0], &Point3::new(0.5, -1.0, 1.0), 1e-3));
    }
}
