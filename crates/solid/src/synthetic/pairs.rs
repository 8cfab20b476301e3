//! Twenty pairs at which engines for booleans break.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};

use super::{Camera, World, view};
use crate::boolean::jittered;
use crate::{Label, Point3, Polyhedron};

/// Two polyhedra, and what is known of their union.
#[derive(Clone, Debug)]
pub struct Pair {
    /// What is hard about it.
    pub name: &'static str,
    /// The first, all obstacle where it is no view.
    pub a: Polyhedron,
    /// The second, all frontier where it is no view.
    pub b: Polyhedron,
    /// Volume of the union, cubic metres, where it can be told.
    pub union_m3: Option<f64>,
}

fn cube(low: [f64; 3], high: [f64; 3], label: Label) -> Polyhedron {
    Polyhedron::cuboid(&Point3::from(low), &Point3::from(high), label)
}

/// Identical views, views moved by next to nothing, cubes that share faces, edges, corners and planes,
/// a sliver and a needle.
pub fn degenerate_pairs() -> Vec<Pair> {
    let world_from_sensor = Se3::new(
        Vector3::new(1.2, 4.4, 1.2),
        UnitQuaternion::from_scaled_axis(Vector3::new(0.02, 0.1, 0.2)),
    );
    let camera = |columns: u32| Camera {
        world_from_sensor,
        map_from_sensor: world_from_sensor,
        cells: [columns, columns * 3 / 4],
        noise: 0.0,
        seed: u64::from(columns),
    };
    let hall = World::hall();
    let seen = view(&hall, &camera(20));
    let volume = Some(seen.volume_m3());
    let mut pairs = Vec::new();
    let mut push = |name, a: &Polyhedron, b: Polyhedron, union_m3| {
        pairs.push(Pair { name, a: a.clone(), b, union_m3 });
    };
    push("identical views", &seen, seen.clone(), volume);
    push("view moved by 1e-15", &seen, jittered(&seen, 1, 1e-15), volume);
    push("view moved by 1e-12", &seen, jittered(&seen, 2, 1e-12), volume);
    push("view moved by 1e-9", &seen, jittered(&seen, 3, 1e-9), None);
    push("view moved by 1e-6", &seen, jittered(&seen, 4, 1e-6), None);
    push("view moved by 1e-4", &seen, jittered(&seen, 5, 1e-4), None);
    push("the same view on another grid", &seen, view(&hall, &camera(27)), None);

    let (obstacle, frontier) = (Label::Obstacle, Label::Frontier);
    let unit = cube([0.0; 3], [1.0; 3], obstacle);
    let beside = cube([1.0, 0.0, 0.0], [2.0, 1.0, 1.0], frontier);
    let smaller = cube([1.0, 0.25, 0.25], [2.0, 0.75, 0.75], frontier);
    let shifted = cube([0.5, 0.0, 0.0], [1.5, 1.0, 1.0], frontier);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, 0.0, 0.0))
        * UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, 0.5));
    let turned = |mesh: &Polyhedron| mesh.transformed(&Se3::new(Vector3::zeros(), turn));
    push("cubes share a face", &unit, beside.clone(), Some(2.0));
    push("cubes share a part of a face", &unit, smaller.clone(), Some(1.25));
    push("turned cubes share a face", &turned(&unit), turned(&beside), Some(2.0));
    push("turned cubes share a part of a face", &turned(&unit), turned(&smaller), Some(1.25));
    push(
        "cubes touch at an edge",
        &unit,
        cube([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], frontier),
        Some(2.0),
    );
    push("cubes touch at a corner", &unit, cube([1.0; 3], [2.0; 3], frontier), Some(2.0));
    push("cubes with coplanar sides", &unit, shifted.clone(), Some(1.5));
    push("turned cubes with coplanar sides", &turned(&unit), turned(&shifted), Some(1.5));
    let near = |x: f64| cube([x, 0.0, 0.0], [2.0, 1.0, 1.0], frontier);
    push("a gap of 1e-12", &unit, near(1.0 + 1e-12), Some(2.0));
    push("an overlap of 1e-12", &unit, near(1.0 - 1e-12), Some(2.0));
    let little = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 1.0) * 1e-12);
    let same = cube([0.0; 3], [1.0; 3], frontier);
    push(
        "a cube turned by 1e-12",
        &unit,
        same.transformed(&Se3::new(Vector3::zeros(), little)),
        Some(1.0),
    );
    let p = Point3::new;
    let sliver = Polyhedron::tetrahedron(
        p(0.0, 0.0, 0.0),
        p(1.0, 0.0, 0.0),
        p(0.5, 1e-7, 0.0),
        p(0.5, 0.5e-7, 1.0),
        frontier,
    );
    push("a sliver of 1e-7", &unit, sliver, Some(1.0));
    let needle = Polyhedron::tetrahedron(
        p(0.2, 0.2, -1.0),
        p(0.2 + 1e-5, 0.2, -1.0),
        p(0.2, 0.2 + 1e-5, -1.0),
        p(0.2, 0.2, 2.0),
        frontier,
    );
    push("a needle of 1e-5", &unit, needle, None);
    pairs
}
