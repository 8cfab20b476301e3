//! Where the knots of a polyline may be, and how they get there exactly.

use nalgebra::Vector3;
use solid::Point3;
use solid::query::closest_on_triangle;

use super::super::corridor::{Corridor, Knot};
use super::super::space::{Exit, Space, middle_of};
use super::program::{HalfSpace, Room};

/// Knots keep this from the borders of their faces, metres, for rounding; less on small faces.
const INSET_M: f64 = 1e-6;
/// On small faces: this share of the radius of the circle or ball inside.
const INSET_SHARE: f64 = 0.05;

/// The room of a knot's place.
pub(super) fn room(space: &Space, corridor: &Corridor, knot: &Knot) -> Room {
    let index = (knot.place / 2) as usize;
    let tetrahedra = &corridor.tetrahedra;
    if knot.place.is_multiple_of(2) {
        return in_space(knot.at, within(space, tetrahedra[index]));
    }
    match corridor.exits[index] {
        Exit::Face(corners) => in_plane(&space.points(corners)),
        Exit::Overlap(at) => {
            let mut limits = within(space, tetrahedra[index]);
            limits.extend(within(space, tetrahedra[index + 1]));
            in_space(at, limits)
        }
    }
}

fn in_space(origin: Point3, limits: Vec<HalfSpace>) -> Room {
    Room { origin, basis: vec![Vector3::x(), Vector3::y(), Vector3::z()], limits }
}

fn in_plane([a, b, c]: &[Point3; 3]) -> Room {
    let normal = (b - a).cross(&(c - a));
    let area2 = normal.norm();
    let sides = [(a, b), (b, c), (c, a)];
    let around: f64 = sides.iter().map(|(p, q)| (*q - *p).norm()).sum();
    let unit = normal.try_normalize(0.0);
    let along = (b - a).try_normalize(0.0);
    let (Some(unit), Some(along)) = (unit, along) else {
        // So thin that doubles know no plane: the knot stays where it is.
        return Room { origin: middle_of([a, b, c]), basis: Vec::new(), limits: Vec::new() };
    };
    let inset = INSET_M.min(INSET_SHARE * area2 / around);
    let limits = sides.map(|(p, q)| {
        let inward = unit.cross(&(q - p)).try_normalize(0.0).unwrap_or_default();
        HalfSpace { normal: -inward, limit: -(inward.dot(&p.coords) + inset) }
    });
    Room {
        origin: middle_of([a, b, c]),
        basis: vec![along, unit.cross(&along)],
        limits: limits.to_vec(),
    }
}

/// The inside of a tetrahedron.
fn within(space: &Space, tetrahedron: u32) -> Vec<HalfSpace> {
    let [a, b, c, d] = space.corners(tetrahedron);
    let volume6 = (b - a).cross(&(c - a)).dot(&(d - a));
    let faces = [(a, c, b), (a, b, d), (b, c, d), (c, a, d)];
    let normals = faces.map(|(p, q, r)| (q - p).cross(&(r - p)));
    let surface: f64 = normals.iter().map(|normal| normal.norm()).sum();
    let inset = INSET_M.min(INSET_SHARE * volume6 / surface);
    let limits = faces.iter().zip(normals).map(|(&(p, ..), normal)| {
        let outward = normal.try_normalize(0.0).unwrap_or_default();
        HalfSpace { normal: outward, limit: outward.dot(&p.coords) - inset }
    });
    limits.collect()
}

/// A point next to `at` that is exactly where the knot's place says.
pub(super) fn placed(space: &Space, corridor: &Corridor, place: u32, at: Point3) -> Knot {
    let index = (place / 2) as usize;
    let tetrahedra = &corridor.tetrahedra;
    let knot = |at| Knot { place, at };
    if place.is_multiple_of(2) {
        return knot(super::super::frontier::held(space, tetrahedra[index], at));
    }
    let [t, u] = [tetrahedra[index], tetrahedra[index + 1]];
    match corridor.exits[index] {
        Exit::Face(corners) => {
            let face = space.points(corners);
            let near = drawn_in(&face, at);
            if space.holds(t, &near) || space.holds(u, &near) {
                return knot(near);
            }
            let inner = space.middle(t);
            let moved = (0..16).map(|i| near + (inner - near) * (1e-15 * 8.0_f64.powi(i)));
            knot(moved.into_iter().find(|p| space.holds(t, p)).unwrap_or(face[0]))
        }
        Exit::Overlap(via) => {
            let shares = [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.03, 0.3];
            let moved = shares.map(|share| at + (via - at) * share);
            let both = |p: &&Point3| space.holds(t, p) && space.holds(u, p);
            knot(*moved.iter().find(both).unwrap_or(&via))
        }
    }
}

/// The point of a face, drawn in by a hair, that is nearest.
fn drawn_in(face: &[Point3; 3], at: Point3) -> Point3 {
    let [a, b, c] = face;
    let sides = [(b - c).norm(), (c - a).norm(), (a - b).norm()];
    let around: f64 = sides.iter().sum();
    let radius = (b - a).cross(&(c - a)).norm() / around;
    if radius.is_nan() || radius <= 0.0 {
        return middle_of([a, b, c]);
    }
    let weighted = a.coords * sides[0] + b.coords * sides[1] + c.coords * sides[2];
    let center = Point3::from(weighted / around);
    let share = (0.9 * INSET_M / radius).min(INSET_SHARE);
    let drawn = face.map(|corner| corner + (center - corner) * share);
    closest_on_triangle(&at, [&drawn[0], &drawn[1], &drawn[2]])
}

/// The knot once on each side of its face: between the two the polyline passes the face where it is.
pub(super) fn doubled(space: &Space, corridor: &Corridor, knot: &Knot) -> Option<[Knot; 2]> {
    let index = (knot.place / 2) as usize;
    if knot.place.is_multiple_of(2) || !matches!(corridor.exits[index], Exit::Face(_)) {
        return None;
    }
    let side = |tetrahedron: u32| {
        let inner = space.middle(tetrahedron);
        let moved = (0..18).map(|i| knot.at + (inner - knot.at) * (1e-13 * 4.0_f64.powi(i)));
        moved.into_iter().find(|p| space.holds(tetrahedron, p))
    };
    let (before, after) =
        (side(corridor.tetrahedra[index])?, side(corridor.tetrahedra[index + 1])?);
    let first = Knot { place: knot.place - 1, at: before };
    let second = Knot { place: knot.place + 1, at: after };
    corridor.meets(space, knot.place / 2, &before, &after).then_some([first, second])
}
