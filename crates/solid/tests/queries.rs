//! Rays and membership against closed forms.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use solid::{Label, Point3, Polyhedron, Side, Solid};

fn p(x: f64, y: f64, z: f64) -> Point3 {
    Point3::new(x, y, z)
}

/// A box with a box-shaped cavity.
fn hollow() -> Polyhedron {
    let outer = Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &p(4.0, 4.0, 4.0), Label::Obstacle);
    let inner = Polyhedron::cuboid(&p(1.0, 1.0, 1.0), &p(3.0, 3.0, 3.0), Label::Frontier);
    let inner = inner.turned_inside_out();
    let vertices = outer.vertices().iter().chain(inner.vertices()).copied().collect();
    let faces = (outer.faces().iter().copied())
        .chain(inner.faces().iter().map(|face| face.map(|v| v + 8)))
        .collect();
    let labels = outer.labels().iter().chain(inner.labels()).copied().collect();
    Polyhedron::try_new(vertices, faces, labels).expect("indices are in range")
}

/// Where a point lies, from coordinates alone.
fn side_of_hollow(q: &Point3) -> Side {
    let in_box = |low: f64, high: f64, strict: bool| {
        q.iter().all(|&c| if strict { low < c && c < high } else { low <= c && c <= high })
    };
    if in_box(1.0, 3.0, true) || !in_box(0.0, 4.0, false) {
        Side::Outside
    } else if in_box(0.0, 4.0, true) && !in_box(1.0, 3.0, false) {
        Side::Inside
    } else {
        Side::Boundary
    }
}

#[test]
fn every_half_grid_point_is_told_right() {
    let mesh = hollow();
    let solid = Solid::new(&mesh);
    for i in -1..10 {
        for j in -1..10 {
            for k in -1..10 {
                let q = p(f64::from(i) * 0.5, f64::from(j) * 0.5, f64::from(k) * 0.5);
                assert_eq!(solid.side(&q), side_of_hollow(&q), "{q}");
            }
        }
    }
}

#[test]
fn rays_meet_the_sheets_in_order() {
    let mesh = hollow();
    let solid = Solid::new(&mesh);
    let hits = solid.segment_hits(&p(-1.0, 1.7, 2.2), &p(5.0, 1.7, 2.2));
    let places: Vec<(f64, bool)> = hits.iter().map(|hit| (hit.at.x, hit.enters)).collect();
    assert_eq!(places, [(0.0, true), (1.0, false), (3.0, true), (4.0, false)]);
    let first = solid.first_hit(&p(2.0, 1.7, 2.2), &Vector3::new(0.0, 0.0, -7.0), 10.0).unwrap();
    assert_eq!((first.at.z, first.enters), (1.0, true));
    assert_eq!(mesh.labels()[first.face as usize], Label::Frontier);
    assert!(solid.first_hit(&p(2.0, 1.7, 2.2), &Vector3::x(), 0.5).is_none());
}

#[test]
fn a_ray_through_an_edge_is_not_lost() {
    let mesh = hollow();
    let solid = Solid::new(&mesh);
    // Along a diagonal of the grid: through the shared edges of the two triangles of each side.
    let hits = solid.segment_hits(&p(-1.0, 2.0, 2.0), &p(5.0, 2.0, 2.0));
    let mut places: Vec<f64> = hits.iter().map(|hit| hit.at.x).collect();
    places.dedup();
    assert_eq!(places, [0.0, 1.0, 3.0, 4.0]);
}

#[test]
fn nothing_is_inside_an_empty_mesh() {
    let mesh = Polyhedron::try_new(vec![], vec![], vec![]).unwrap();
    assert_eq!(Solid::new(&mesh).side(&p(0.0, 0.0, 0.0)), Side::Outside);
    assert!(Solid::new(&mesh).segment_hits(&p(0.0, 0.0, 0.0), &p(1.0, 0.0, 0.0)).is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn membership_moves_with_the_mesh(
        at in prop::array::uniform3(-1.0..5.0_f64),
        rotation in prop::array::uniform3(-3.0..3.0_f64),
        shift in prop::array::uniform3(-10.0..10.0_f64),
    ) {
        let q = Point3::from(at);
        // Away from the surface by more than rounding.
        prop_assume!(q.iter().all(|c| [0.0, 1.0, 3.0, 4.0].iter().all(|s: &f64| (c - s).abs() > 1e-9)));
        let map_from_sensor =
            Se3::new(Vector3::from(shift), UnitQuaternion::from_scaled_axis(Vector3::from(rotation)));
        let moved = hollow().transformed(&map_from_sensor);
        let solid = Solid::new(&moved);
        prop_assert_eq!(solid.side(&map_from_sensor.transform(&q)), side_of_hollow(&q));
    }
}
