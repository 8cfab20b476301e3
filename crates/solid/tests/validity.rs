//! Each level is broken on purpose, and the defect is found where it is.

use solid::{Contact, Defect, Label, Point3, Polyhedron, check, crossings};

fn p(x: f64, y: f64, z: f64) -> Point3 {
    Point3::new(x, y, z)
}

fn cube_at(x: f64, y: f64, z: f64) -> Polyhedron {
    Polyhedron::cuboid(&p(x, y, z), &p(x + 1.0, y + 1.0, z + 1.0), Label::Obstacle)
}

/// Several meshes as one, vertices kept apart.
fn together(parts: &[Polyhedron]) -> Polyhedron {
    let (mut vertices, mut faces, mut labels) = (Vec::new(), Vec::new(), Vec::new());
    for part in parts {
        let first = vertices.len() as u32;
        vertices.extend_from_slice(part.vertices());
        faces.extend(part.faces().iter().map(|face| face.map(|v| v + first)));
        labels.extend_from_slice(part.labels());
    }
    Polyhedron::try_new(vertices, faces, labels).expect("indices are in range")
}

fn changed(
    mesh: &Polyhedron,
    change: impl FnOnce(&mut Vec<Point3>, &mut Vec<[u32; 3]>),
) -> Polyhedron {
    let (mut vertices, mut faces, _, _) = mesh.clone().into_parts();
    change(&mut vertices, &mut faces);
    let labels = vec![Label::Obstacle; faces.len()];
    Polyhedron::try_new(vertices, faces, labels).expect("indices are in range")
}

#[test]
fn a_missing_face_leaves_three_open_edges() {
    let mesh = changed(&cube_at(0.0, 0.0, 0.0), |_, faces| {
        faces.remove(0);
    });
    let validity = check(&mesh);
    assert!(!validity.closed && validity.oriented && !validity.manifold);
    let open: Vec<[u32; 2]> = (validity.defects.iter())
        .map(|defect| match defect {
            Defect::OpenEdge { vertices, faces } if faces.len() == 1 => *vertices,
            other => panic!("{other}"),
        })
        .collect();
    assert_eq!(open, [[0, 1], [0, 3], [1, 3]]);
}

#[test]
fn a_turned_face_twists_its_edges() {
    let mesh = changed(&cube_at(0.0, 0.0, 0.0), |_, faces| faces[4].swap(0, 1));
    let validity = check(&mesh);
    assert!(validity.closed && !validity.oriented && validity.manifold);
    assert_eq!(validity.defects.len(), 3);
    assert!(validity.defects.iter().all(|defect| matches!(defect,
        Defect::TwistedEdge { faces, .. } if faces.contains(&4))));
}

#[test]
fn cubes_welded_along_an_edge_crowd_it_and_pinch_nothing_else() {
    let both = together(&[cube_at(0.0, 0.0, 0.0), cube_at(1.0, 1.0, 0.0)]);
    assert!(check(&both).is_valid(), "kept apart by index, they touch where edges coincide");
    let validity = check(&solid::mesh::weld(&both).mesh);
    assert!(validity.closed && validity.oriented && !validity.manifold);
    assert!(!validity.self_intersecting);
    assert!(matches!(&validity.defects[0], Defect::CrowdedEdge { faces, .. } if faces.len() == 4));
}

#[test]
fn cubes_welded_at_a_corner_pinch_it() {
    let both = together(&[cube_at(0.0, 0.0, 0.0), cube_at(1.0, 1.0, 1.0)]);
    let welded = solid::mesh::weld(&both).mesh;
    let corner = welded.vertices().iter().position(|v| *v == p(1.0, 1.0, 1.0)).unwrap() as u32;
    let validity = check(&welded);
    assert!(!validity.manifold && !validity.self_intersecting);
    assert_eq!(validity.defects, [Defect::PinchedVertex { vertex: corner, fans: 2 }]);
}

#[test]
fn crossing_cubes_are_found_where_they_cross() {
    let (a, b) = (cube_at(0.0, 0.0, 0.0), cube_at(0.5, 0.25, 0.125));
    let validity = check(&together(&[a, b]));
    assert!(validity.manifold && validity.self_intersecting);
    for crossing in validity.crossings() {
        assert!(crossing.faces[0] < 12 && crossing.faces[1] >= 12);
        assert_eq!(crossing.contact, Contact::Cross);
        assert!((0..3).all(|i| (-0.01..1.63).contains(&crossing.at[i])), "{crossing}");
    }
}

#[test]
fn coplanar_sides_overlap() {
    let both = together(&[cube_at(0.0, 0.0, 0.0), cube_at(1.0, 0.25, 0.25)]);
    let found = crossings(&both, 1000);
    assert!(found.iter().any(|crossing| crossing.contact == Contact::Overlap));
    assert!(found.iter().all(|crossing| crossing.at.x == 1.0), "{found:?}");
}

#[test]
fn a_corner_on_a_face_touches_it() {
    let spike = Polyhedron::tetrahedron(
        p(0.4, 0.4, 2.0),
        p(0.6, 0.4, 2.0),
        p(0.4, 0.6, 2.0),
        p(0.45, 0.45, 1.0),
        Label::Obstacle,
    )
    .turned_inside_out();
    let found = crossings(&together(&[cube_at(0.0, 0.0, 0.0), spike]), 1000);
    assert!(!found.is_empty());
    assert!(found.iter().all(|crossing| crossing.contact == Contact::Touch), "{found:?}");
    assert!(found.iter().all(|crossing| crossing.at == p(0.45, 0.45, 1.0)), "{found:?}");
}

#[test]
fn a_gap_of_one_unit_in_the_last_place_is_a_gap() {
    let next = f64::from_bits(1.0_f64.to_bits() + 1);
    let beside = Polyhedron::cuboid(&p(next, 0.1, 0.1), &p(2.0, 0.9, 0.9), Label::Obstacle);
    assert!(check(&together(&[cube_at(0.0, 0.0, 0.0), beside])).is_valid());
}

#[test]
fn flat_faces_and_folds_are_found() {
    let mesh = changed(&cube_at(0.0, 0.0, 0.0), |vertices, faces| {
        // Corner 0 splits edge 1-3 of face 0 in the middle: one of the halves is flat.
        vertices.push(p(0.0, 0.5, 1.0));
        let new = vertices.len() as u32 - 1;
        faces.push([1, new, 3]);
    });
    let flat = mesh.faces().len() as u32 - 1;
    let validity = check(&mesh);
    assert!(validity.self_intersecting);
    assert!(validity.defects.contains(&Defect::FlatFace { face: flat }));

    let fold = Polyhedron::try_new(
        vec![p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0), p(0.5, 0.7, 0.0)],
        vec![[0, 1, 2], [1, 0, 3]],
        vec![Label::Frontier; 2],
    )
    .unwrap();
    let found = crossings(&fold, 10);
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].faces, found[0].contact), ([0, 1], Contact::Overlap));
    let flat_pair = changed(&fold, |vertices, _| vertices[3].y = -0.7);
    assert!(crossings(&flat_pair, 10).is_empty());
}

#[test]
fn the_limit_holds_and_the_first_levels_stand_alone() {
    let both = together(&[cube_at(0.0, 0.0, 0.0), cube_at(0.5, 0.25, 0.125)]);
    assert_eq!(crossings(&both, 3).len(), 3);
    assert!(crossings(&both, 0).is_empty());
    let topology = solid::validity::check_topology(&both);
    assert!(topology.is_valid() && topology.defects.is_empty());
}
