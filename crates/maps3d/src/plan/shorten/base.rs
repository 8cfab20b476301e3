//! A polyline that keeps the radius from obstacles, to begin with.

use solid::Point3;

use super::super::bottleneck::clearest;
use super::super::corridor::{Corridor, Knot};
use super::super::obstacles::crossing;
use super::super::space::{Exit, Space};
use super::rooms::placed;

/// Where a corridor turned out too narrow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Narrow {
    /// The gate to be blocked.
    pub gate: u32,
    pub at: Point3,
    pub clearance_m: f64,
}

/// The first choice of a knot keeps this much more than the radius.
const AMPLE: f64 = 1.1;

/// A knot that leads round something lies so far towards a corner of its tetrahedron, as shares of the way there.
const CORNER_SHARES: [f64; 4] = [0.5, 0.75, 0.9, 0.25];

/// One knot on each gate, where the way passes it or else where it is clearest, and where a segment
/// between two comes too near, one more inside of the tetrahedron.
pub(super) fn clear(
    space: &Space,
    corridor: &Corridor,
    radius_m: f64,
    way: &[Knot],
) -> Result<Vec<Knot>, Narrow> {
    let obstacles = space.obstacles();
    let mut points = Vec::with_capacity(corridor.exits.len());
    for (gate, exit) in corridor.exits.iter().enumerate() {
        let gate = gate as u32;
        let at = match *exit {
            Exit::Overlap(at) => at,
            Exit::Face(corners) => {
                let face = space.points(corners);
                let passed = passes(way, gate, &face);
                match passed.filter(|p| obstacles.within(p, AMPLE * radius_m).is_none()) {
                    Some(at) => at,
                    None => clearest(&face, AMPLE * radius_m, obstacles).0,
                }
            }
        };
        if let Some(clearance_m) = obstacles.within(&at, radius_m) {
            return Err(Narrow { gate, at, clearance_m });
        }
        points.push(placed(space, corridor, 2 * gate + 1, at));
    }
    let mut knots = Vec::with_capacity(2 * points.len() + 2);
    knots.push(way[0]);
    let last = way[way.len() - 1];
    for to in points.into_iter().chain([last]) {
        let from = knots[knots.len() - 1];
        if let Some(near) = obstacles.near_segment(&from.at, &to.at, radius_m) {
            // Both lie in the tetrahedron between their gates.
            let tetrahedron = to.place / 2;
            let around = detour(space, corridor, radius_m, tetrahedron, &from.at, &to.at);
            match around {
                Some(knot) => knots.push(knot),
                None => {
                    let gate = tetrahedron.min(corridor.exits.len().saturating_sub(1) as u32);
                    // Of the two gates of the tetrahedron the one that lies nearer to what is in the way.
                    let before = (from.at - near.on_obstacle).norm();
                    let after = (to.at - near.on_obstacle).norm();
                    let gate =
                        if before < after && tetrahedron > 0 { tetrahedron - 1 } else { gate };
                    let (at, clearance_m) = (near.on_segment, near.distance_m);
                    return Err(Narrow { gate, at, clearance_m });
                }
            }
        }
        knots.push(to);
    }
    Ok(knots)
}

/// A point of the tetrahedron by which one gets from one point to another.
fn detour(
    space: &Space,
    corridor: &Corridor,
    radius_m: f64,
    index: u32,
    from: &Point3,
    to: &Point3,
) -> Option<Knot> {
    let tetrahedron = *corridor.tetrahedra.get(index as usize)?;
    let obstacles = space.obstacles();
    let ends_clear = |at: &Point3| {
        obstacles.near_segment(from, at, radius_m).is_none()
            && obstacles.near_segment(at, to, radius_m).is_none()
    };
    let middle = space.middle(tetrahedron);
    if ends_clear(&middle) {
        return Some(Knot { place: 2 * index, at: middle });
    }
    away_from_obstacles(space, radius_m, tetrahedron, from, to)
        .or_else(|| {
            // Towards a corner: in a fan the gates of a tetrahedron meet at the camera, and may be wide there only.
            let between = nalgebra::center(from, to);
            let towards = |share: f64| {
                space.corners(tetrahedron).map(|corner| between + (corner - between) * share)
            };
            CORNER_SHARES
                .into_iter()
                .flat_map(towards)
                .find(|at| space.holds(tetrahedron, at) && ends_clear(at))
        })
        .map(|at| Knot { place: 2 * index, at })
}

/// The point between two, moved away from what is nearest, again and again; inside of the tetrahedron.
fn away_from_obstacles(
    space: &Space,
    radius_m: f64,
    tetrahedron: u32,
    from: &Point3,
    to: &Point3,
) -> Option<Point3> {
    let obstacles = space.obstacles();
    let mut at = nalgebra::center(from, to);
    for _ in 0..6 {
        let near = [(from, &at), (&at, to)]
            .into_iter()
            .filter_map(|(a, b)| obstacles.near_segment(a, b, radius_m))
            .min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
        let Some(near) = near else {
            return space.holds(tetrahedron, &at).then_some(at);
        };
        let away = (near.on_segment - near.on_obstacle).try_normalize(1e-12)?;
        at += away * (AMPLE * radius_m - near.distance_m) * 1.5;
    }
    None
}

/// Where the way through the middles passes a gate.
fn passes(way: &[Knot], gate: u32, face: &[Point3; 3]) -> Option<Point3> {
    let after = way.partition_point(|knot| knot.place <= 2 * gate);
    let (before, next) = (way.get(after.checked_sub(1)?)?, way.get(after)?);
    if next.place == 2 * gate + 1 {
        return Some(next.at);
    }
    crossing(&before.at, &next.at, face)
}
