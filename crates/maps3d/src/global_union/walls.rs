//! Step 2: frontier along a wall is wall.

use solid::{Label, Point3, Polyhedron};

use super::patches::{middle, pieces_of};
use super::view::View;

/// Pieces of a frontier face that are asked for, each by its middle, have no longer edge than this, metres.
const PIECE_M: f64 = 0.3;

/// The map with every frontier face made obstacle that the views account for: its corners and the middles of
/// its pieces lie, along the rays of one view or another, no farther than `wall_m` of depth behind an
/// obstacle face of it. `views` are those in the map, the new one last; faces that come nowhere near that
/// one are left alone. Tells how many there are.
///
/// A wall that one view sees along its surface is frontier there, because depth jumps from pixel to pixel;
/// another view that sees it from before knows better, but by no more than its error in depth. And where a
/// wall ends for one view, another one's surface lies a hair before it or behind: a step that nobody looks
/// behind. The rule for coincident faces needs them to coincide to rounding.
pub(super) fn settle(map: Polyhedron, views: &[View], wall_m: f64) -> (Polyhedron, usize) {
    let Some((low, high)) = views.last().filter(|_| wall_m > 0.0).and_then(View::bounds_in_map)
    else {
        return (map, 0);
    };
    // One that asks them all starts with those that came last: they are the nearest, mostly.
    let near: Vec<&View> = views.iter().rev().filter(|view| view.comes_near(&low, &high)).collect();
    let is_wall = |at: &Point3| near.iter().any(|view| view.is_wall(at, wall_m));
    let mut labels = map.labels().to_vec();
    let mut settled = 0;
    for (face, label) in labels.iter_mut().enumerate() {
        if *label != Label::Frontier {
            continue;
        }
        let corners = map.corners(face);
        // What the new view does not come near is settled already.
        let reached = (0..3).all(|axis| {
            let [a, b, c] = corners.map(|corner| corner[axis]);
            a.min(b).min(c) <= high[axis] + wall_m && a.max(b).max(c) >= low[axis] - wall_m
        });
        if reached
            && is_wall(&middle(corners))
            && corners.iter().all(|corner| is_wall(corner))
            && pieces_of(corners, PIECE_M).all(|at| is_wall(&at))
        {
            *label = Label::Obstacle;
            settled += 1;
        }
    }
    if settled == 0 {
        return (map, 0);
    }
    match map.clone().with_labels(labels) {
        Ok(map) => (map, settled),
        // One label for each face, so this is never refused.
        Err(_) => (map, 0),
    }
}
