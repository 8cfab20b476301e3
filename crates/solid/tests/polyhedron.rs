//! What a polyhedron holds, and what it is told when it cannot.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use solid::mesh::{position_classes, weld};
use solid::predicates::orient3;
use solid::{Label, Origin, Point3, Polyhedron, SolidError, check};

fn p(x: f64, y: f64, z: f64) -> Point3 {
    Point3::new(x, y, z)
}

fn cube() -> Polyhedron {
    Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &p(1.0, 1.0, 1.0), Label::Obstacle)
}

#[test]
fn every_broken_part_is_named() {
    let three = vec![p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0)];
    let label = vec![Label::Frontier];
    let made = |vertices: &[Point3], faces: &[[u32; 3]], labels: &[Label]| {
        Polyhedron::try_new(vertices.to_vec(), faces.to_vec(), labels.to_vec())
    };
    assert!(made(&three, &[[0, 1, 2]], &label).is_ok());
    assert_eq!(
        made(&three, &[[0, 1, 2]], &[]),
        Err(SolidError::LabelCount { faces: 1, labels: 0 })
    );
    assert_eq!(
        made(&three, &[[0, 1, 3]], &label),
        Err(SolidError::UnknownVertex { face: 0, vertex: 3, vertices: 3 })
    );
    for (corners, vertex) in [([0, 0, 1], 0), ([1, 0, 1], 1), ([0, 2, 2], 2)] {
        assert_eq!(
            made(&three, &[corners], &label),
            Err(SolidError::RepeatedCorner { face: 0, vertex })
        );
    }
    for bad in [f64::NAN, f64::INFINITY, 1e51, 1e-46] {
        let mut vertices = three.clone();
        vertices[1].y = bad;
        let refused = made(&vertices, &[[0, 1, 2]], &label);
        assert!(
            matches!(refused, Err(SolidError::OutsideEnvelope { vertex: 1, .. })),
            "{bad}: {refused:?}"
        );
    }
    let mut vertices = three.clone();
    vertices[1].y = 1e-300;
    let refused = made(&vertices, &[[0, 1, 2]], &label).expect_err("too small to decide on");
    assert!(refused.to_string().contains("1e-300"), "{refused}");
    let mesh = cube();
    assert_eq!(
        mesh.clone().with_origins(vec![Origin { view: 0, face: 0 }]),
        Err(SolidError::OriginCount { faces: 12, origins: 1 })
    );
    assert_eq!(mesh.as_view(7).origins().unwrap()[11], Origin { view: 7, face: 11 });
}

#[test]
fn a_box_measures_what_it_should() {
    let mesh = Polyhedron::cuboid(&p(-1.0, 2.0, 0.5), &p(1.0, 5.0, 4.5), Label::Frontier);
    assert_eq!(mesh.volume_m3(), 24.0);
    assert_eq!(mesh.turned_inside_out().volume_m3(), -24.0);
    let area = mesh.area_by_label();
    assert_eq!((area.obstacle_m2, area.frontier_m2), (0.0, 52.0));
    assert_eq!(mesh.bounds(), Some((p(-1.0, 2.0, 0.5), p(1.0, 5.0, 4.5))));
    assert_eq!(Polyhedron::try_new(vec![], vec![], vec![]).unwrap().bounds(), None);
}

#[test]
fn welding_joins_places_and_drops_what_is_unused() {
    let vertices = vec![
        p(9.0, 9.0, 9.0),
        p(0.0, 0.0, 0.0),
        p(1.0, 0.0, 0.0),
        p(0.0, 1.0, 0.0),
        p(-0.0, 0.0, 0.0),
        p(0.0, 0.0, 1.0),
    ];
    assert_eq!(position_classes(&vertices), [0, 1, 2, 3, 1, 5]);
    let faces = vec![[1, 3, 2], [4, 2, 5], [1, 4, 5]];
    let labels = vec![Label::Obstacle, Label::Frontier, Label::Frontier];
    let mesh =
        Polyhedron::try_new(vertices, faces, labels).expect("indices are in range").as_view(3);
    let welded = weld(&mesh);
    assert_eq!(welded.collapsed, [2]);
    assert_eq!(welded.mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(welded.mesh.labels(), [Label::Obstacle, Label::Frontier]);
    assert_eq!(welded.mesh.origins().unwrap()[1], Origin { view: 3, face: 1 });
    assert_eq!(welded.mesh.vertices().len(), 4);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn rigid_motions_keep_volume_area_and_topology(
        rotation in prop::array::uniform3(-3.0..3.0_f64),
        shift in prop::array::uniform3(-10.0..10.0_f64),
        size in prop::array::uniform3(0.1..5.0_f64),
    ) {
        let mesh = Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &Point3::from(size), Label::Obstacle);
        let map_from_sensor =
            Se3::new(Vector3::from(shift), UnitQuaternion::from_scaled_axis(Vector3::from(rotation)));
        let moved = mesh.transformed(&map_from_sensor);
        prop_assert!((moved.volume_m3() - mesh.volume_m3()).abs() < 1e-10 * mesh.volume_m3().max(1.0));
        let (was, is) = (mesh.area_by_label().total_m2(), moved.area_by_label().total_m2());
        prop_assert!((was - is).abs() < 1e-10 * was.max(1.0));
        prop_assert!(check(&moved).is_valid());
        prop_assert_eq!(moved.faces(), mesh.faces());
    }
}

/// A needle 1e-9 thick, far from the origin and turned: what its faces add to the volume cancels to one part in
/// 1e16.
#[test]
fn the_volume_of_a_needle_keeps_its_digits() {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.3, 0.8));
    let at = Vector3::new(3.0, -7.0, 2.0);
    let needle = Polyhedron::tetrahedron(
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(1e-9, 0.0, 0.0),
        Point3::new(0.0, 1e-9, 0.0),
        Point3::new(3e-10, 2e-10, 8.0),
        Label::Obstacle,
    );
    let needle = needle.transformed(&Se3::new(at, turn));
    let [a, b, c, d] = [0, 1, 2, 3].map(|v| &needle.vertices()[v]);
    let exact = orient3(a, b, c, d).abs() / 6.0;
    assert!(exact > 1e-19 && exact < 1e-17, "{exact:e}");
    let off = (needle.volume_m3() / exact - 1.0).abs();
    assert!(off < 1e-10, "{off:e}");
}
