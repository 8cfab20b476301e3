//! Step 2: frontier along a wall is wall.

use solid::{Label, Polyhedron};

use super::surface::Surface;

/// A face counts as lying along a wall where the wall looks the same way at least by this cosine.
const SAME_WAY: f64 = 0.5;

/// The map with every frontier face made obstacle that lies within `wall_m` of obstacle faces of the two
/// operands which look about the same way: with its middle and with all of its corners. Tells how many.
///
/// A wall that one view sees along its surface is frontier there, because depth jumps from pixel to pixel;
/// another view that sees it from before knows better, but by no more than its error in depth. The rule for
/// coincident faces needs them to coincide to rounding.
pub(super) fn settle(map: Polyhedron, operands: [&Surface; 2], wall_m: f64) -> (Polyhedron, usize) {
    let Some((low, high)) = operands[1].mesh.bounds().filter(|_| wall_m > 0.0) else {
        return (map, 0);
    };
    let mut labels = map.labels().to_vec();
    let mut settled = 0;
    for (face, label) in labels.iter_mut().enumerate() {
        if *label != Label::Frontier {
            continue;
        }
        let corners = map.corners(face);
        // What the new operand does not come near is settled already.
        let reached = (0..3).all(|axis| {
            let [a, b, c] = corners.map(|corner| corner[axis]);
            a.min(b).min(c) <= high[axis] + wall_m && a.max(b).max(c) >= low[axis] - wall_m
        });
        let Some(normal) = map.scaled_normal(face).try_normalize(0.0).filter(|_| reached) else {
            continue;
        };
        let middle = super::patches::middle(corners);
        let by_wall = |at: &solid::Point3| {
            operands.iter().any(|operand| operand.is_wall(at, &normal, SAME_WAY, wall_m))
        };
        if by_wall(&middle) && corners.iter().all(|corner| by_wall(corner)) {
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
