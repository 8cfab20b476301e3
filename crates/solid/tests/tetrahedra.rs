//! Tetrahedra: exact laws, hard polyhedra, refusals that name what is wrong.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::Zero;
use probe::Probe;
use proptest::prelude::*;
use solid::boolean::Options;
use solid::predicates::orient3;
use solid::synthetic::{Kind, views};
use solid::tetrahedra::{Inside, delaunay, fan, tetrahedralize_in};
use solid::{
    Label, Operation, Point3, Polyhedron, SolidError, Tetrahedra, TetrahedraEvent, boolean,
    tetrahedralize, tetrahedralize_with, unite,
};

fn p(x: f64, y: f64, z: f64) -> Point3 {
    Point3::new(x, y, z)
}

/// A number in units of 2^-1074: an integer, exactly.
fn exact(v: f64) -> BigInt {
    let bits = v.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as u32;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, shift) =
        if exponent == 0 { (fraction, 0) } else { (fraction | 1 << 52, exponent - 1) };
    let size = BigInt::from(mantissa) << shift;
    if v < 0.0 { -size } else { size }
}

/// The largest power of two that divides all coordinates, as exact integers.
fn grid(points: &[Point3]) -> u64 {
    let all = points.iter().flat_map(|p| [p.x, p.y, p.z]);
    all.filter_map(|v| exact(v).trailing_zeros()).min().unwrap_or(0)
}

/// Points as integers on a grid.
fn on_grid(points: &[Point3], grid: u64) -> Vec<[BigInt; 3]> {
    points.iter().map(|p| [0, 1, 2].map(|k| exact(p[k]) >> grid)).collect()
}

/// Six times the signed volume of four points, exactly.
fn six_volumes([a, b, c, d]: [&[BigInt; 3]; 4]) -> BigInt {
    let sub = |x: &[BigInt; 3]| [0, 1, 2].map(|k| &x[k] - &a[k]);
    let (u, v, w) = (sub(b), sub(c), sub(d));
    &u[0] * (&v[1] * &w[2] - &v[2] * &w[1])
        + &u[1] * (&v[2] * &w[0] - &v[0] * &w[2])
        + &u[2] * (&v[0] * &w[1] - &v[1] * &w[0])
}

/// All that must hold of the tetrahedra of a closed polyhedron.
fn assert_laws(mesh: &Polyhedron, found: &Tetrahedra) {
    assert_eq!(&found.vertices[..mesh.vertices().len()], mesh.vertices(), "vertices moved");
    let at = |v: u32| &found.vertices[v as usize];
    let grid = grid(&found.vertices);
    let exact_at = on_grid(&found.vertices, grid);
    let place = |v: u32| &exact_at[v as usize];
    let mut volume = BigInt::zero();
    let mut faces: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    for (t, tet) in found.tetrahedra.iter().enumerate() {
        let [a, b, c, d] = *tet;
        assert!(orient3(at(a), at(b), at(c), at(d)) > 0.0, "tetrahedron {t} is not positive");
        volume += six_volumes([place(a), place(b), place(c), place(d)]);
        for (corner, side) in [[b, c, d], [a, c, d], [a, b, d], [a, b, c]].into_iter().enumerate() {
            let mut key = side;
            key.sort_unstable();
            *faces.entry(key).or_default() += 1;
            if let Some(other) = found.neighbours[t][corner] {
                assert!(found.neighbours[other as usize].contains(&Some(t as u32)));
                assert!(side.iter().all(|v| found.tetrahedra[other as usize].contains(v)));
            }
        }
    }
    // The volume of the input, by its faces and the origin.
    let zero = [BigInt::zero(), BigInt::zero(), BigInt::zero()];
    let mut of_input = BigInt::zero();
    for face in mesh.faces() {
        let [a, b, c] = face.map(place);
        of_input += six_volumes([&zero, a, b, c]);
    }
    assert_eq!(volume, of_input, "volumes differ");
    // Faces with one tetrahedron are those of the input, one to one.
    let mut outer: Vec<[u32; 3]> =
        faces.iter().filter(|&(_, &count)| count == 1).map(|(&face, _)| face).collect();
    let mut given: Vec<[u32; 3]> = found
        .boundary
        .iter()
        .map(|face| {
            let mut key = face.corners;
            key.sort_unstable();
            key
        })
        .collect();
    given.sort_unstable();
    outer.sort_unstable();
    assert_eq!(outer, given, "the boundary differs");
    assert_eq!(found.boundary.len(), mesh.faces().len());
    for face in &found.boundary {
        assert_eq!(face.label, mesh.labels()[face.face as usize]);
        let corners = mesh.faces()[face.face as usize].map(|v| mesh.vertices()[v as usize]);
        assert_eq!(face.corners.map(|v| found.vertices[v as usize]), corners);
        assert!(face.tetrahedra[0].is_some() && face.tetrahedra[1].is_none());
    }
}

fn of(vertices: Vec<Point3>, faces: Vec<[u32; 3]>) -> Polyhedron {
    let labels = (0..faces.len())
        .map(|i| if i % 3 == 0 { Label::Frontier } else { Label::Obstacle })
        .collect();
    Polyhedron::try_new(vertices, faces, labels).expect("a mesh")
}

fn cube(low: f64, high: f64) -> Polyhedron {
    Polyhedron::cuboid(&p(low, low, low), &p(high, high, high), Label::Obstacle)
}

/// A prism, twisted so that it has no tetrahedra without a further point.
fn schoenhardt() -> Polyhedron {
    let ring = |z: f64, turn: f64| {
        (0..3).map(move |i| {
            let angle = f64::from(i) * 2.0 * std::f64::consts::FRAC_PI_3 + turn;
            p(angle.cos(), angle.sin(), z)
        })
    };
    let vertices: Vec<Point3> = ring(0.0, 0.0).chain(ring(1.0, 0.5)).collect();
    let mut faces = vec![[0, 2, 1], [3, 4, 5]];
    for i in 0..3u32 {
        let j = (i + 1) % 3;
        // The diagonal that passes nearer to the axis is the reflex one.
        faces.push([i, j, j + 3]);
        faces.push([i, j + 3, i + 3]);
    }
    of(vertices, faces)
}

#[test]
fn easy_shapes_keep_their_faces() {
    let shapes = [cube(0.0, 1.0), cube(-3.0, 1e6), views(Kind::Path, 1).remove(0)];
    for mesh in shapes {
        assert_laws(&mesh, &tetrahedralize(&mesh).expect("it is valid"));
    }
}

#[test]
fn schoenhardts_prism_takes_a_point_inside() {
    let mesh = schoenhardt();
    let found = tetrahedralize(&mesh).expect("it is valid");
    assert_laws(&mesh, &found);
    assert!(found.steiner_points >= 1, "none can do without");
}

/// A thin wedge along x whose edge runs from `a` to `b`, and whose back is far away at height `z`.
fn wedge(a: Point3, b: Point3, aside: solid::Vector3, z: f64) -> Polyhedron {
    let back = |at: Point3, by: f64| {
        let moved = at + aside * by;
        p(moved.x, moved.y, z)
    };
    let vertices = vec![a, b, back(a, -1.0), back(b, -1.0), back(b, 1.0), back(a, 1.0)];
    let faces: [[u32; 3]; 8] =
        [[0, 2, 5], [1, 4, 3], [0, 3, 2], [0, 1, 3], [0, 5, 4], [0, 4, 1], [2, 3, 4], [2, 4, 5]];
    let mesh = of(vertices.clone(), faces.to_vec());
    if mesh.volume_m3() > 0.0 {
        return mesh;
    }
    of(vertices, faces.iter().map(|&[a, b, c]| [a, c, b]).collect())
}

/// A block with wedges cut out from below and, across them, from above, whose edges lie on two saddles
/// that are near each other: between them any convex part is small.
fn chazelle(notches: u32) -> Polyhedron {
    let size = f64::from(notches) + 1.0;
    let (far, thin, gap) = (size * size + 2.0, 0.05, 0.1);
    let block = Polyhedron::cuboid(&p(0.0, 0.0, -far), &p(size, size, far), Label::Obstacle);
    let mut mesh = block;
    for i in 1..=notches {
        let at = f64::from(i);
        let (low, high) = (-0.5, size + 0.5);
        let from_below = wedge(
            p(low, at, low * at),
            p(high, at, high * at),
            solid::Vector3::new(0.0, thin, 0.0),
            -far - 1.0,
        );
        let from_above = wedge(
            p(at, low, low * at + gap),
            p(at, high, high * at + gap),
            solid::Vector3::new(thin, 0.0, 0.0),
            far + 1.0,
        );
        for cut in [from_below, from_above] {
            mesh = boolean(&mesh, &cut, Operation::Difference, &Options::default())
                .expect("both are valid");
        }
    }
    solid::mesh::weld(&mesh).mesh
}

#[test]
fn chazelles_polyhedron() {
    for notches in [2, 3, 4] {
        let mesh = chazelle(notches);
        assert!(solid::check(&mesh).is_valid());
        assert_laws(&mesh, &tetrahedralize(&mesh).expect("it is valid"));
    }
}

#[test]
fn shells_cavities_and_touching_parts() {
    let outer = cube(0.0, 4.0);
    let with_cavity = boolean(&outer, &cube(1.0, 2.0), Operation::Difference, &Options::default())
        .expect("both are valid");
    assert_laws(&with_cavity, &tetrahedralize(&with_cavity).expect("it is valid"));
    // Two cubes with an edge in common, by index.
    let mut vertices = cube(0.0, 1.0).vertices().to_vec();
    let other = Polyhedron::cuboid(&p(1.0, 1.0, 0.0), &p(2.0, 2.0, 1.0), Label::Frontier);
    let shift = vertices.len() as u32;
    vertices.extend(other.vertices());
    let mut faces = cube(0.0, 1.0).faces().to_vec();
    faces.extend(other.faces().iter().map(|face| face.map(|v| v + shift)));
    let both = of(vertices, faces);
    let found = tetrahedralize(&both).expect("edges may touch");
    assert_eq!(found.boundary.len(), 24);
    assert!((found.volume_m3() - 2.0).abs() < 1e-12);
}

#[test]
fn thin_plates_and_needles() {
    let gap = 1e-9;
    let low = Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &p(1.0, 1.0, 0.1), Label::Obstacle);
    let high = Polyhedron::cuboid(&p(0.2, 0.1, 0.1 + gap), &p(1.3, 1.2, 0.2), Label::Obstacle);
    let shift = low.vertices().len() as u32;
    let mut vertices = low.vertices().to_vec();
    vertices.extend(high.vertices());
    let mut faces = low.faces().to_vec();
    faces.extend(high.faces().iter().map(|face| face.map(|v| v + shift)));
    let plates = of(vertices, faces);
    assert_laws(&plates, &tetrahedralize(&plates).expect("they do not touch"));
    let needle = Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &p(1e-6, 1e-6, 1.0), Label::Obstacle);
    assert_laws(&needle, &tetrahedralize(&needle).expect("it is valid"));
}

#[test]
fn the_union_of_two_views_with_noise() {
    assert_laws_welded(Kind::Noisy, 2);
}

#[test]
fn the_union_of_two_views_along_a_path() {
    assert_laws_welded(Kind::Path, 2);
}

#[test]
fn the_union_of_two_views_without_noise() {
    assert_laws_welded(Kind::Coplanar, 2);
}

#[test]
fn the_union_of_five_views_with_noise() {
    assert_laws_welded(Kind::Noisy, 5);
}

/// The laws for the map of some views, with few points added.
fn assert_laws_welded(kind: Kind, count: usize) {
    let map = unite(&views(kind, count), &Options::default()).expect("views unite");
    let welded = solid::mesh::weld(&map).mesh;
    let found = tetrahedralize(&welded).expect("the map is valid");
    assert_laws(&welded, &found);
    assert!(found.steiner_points * 100 <= welded.vertices().len(), "{}", found.steiner_points);
}

#[test]
fn what_is_invalid_is_named() {
    let mut faces = cube(0.0, 1.0).faces().to_vec();
    faces.pop();
    let open = of(cube(0.0, 1.0).vertices().to_vec(), faces);
    let error = tetrahedralize(&open).expect_err("it is open");
    assert!(error.to_string().contains("is open: face"), "{error}");

    let (a, b) = (cube(0.0, 1.0), cube(0.5, 1.5));
    let mut vertices = a.vertices().to_vec();
    vertices.extend(b.vertices());
    let mut faces = a.faces().to_vec();
    faces.extend(b.faces().iter().map(|face| face.map(|v| v + 8)));
    let error = tetrahedralize(&of(vertices, faces)).expect_err("they cross");
    let SolidError::NoVolume { defects } = &error else { panic!("{error}") };
    assert!(!defects.is_empty() && error.to_string().contains("cross near"), "{error}");
}

#[test]
fn inner_faces_divide_the_inside() {
    // A cube with a wall across it; the half with the hole point is left out.
    let whole = Polyhedron::cuboid(&p(0.0, 0.0, 0.0), &p(1.0, 1.0, 1.0), Label::Obstacle);
    let other = Polyhedron::cuboid(&p(1.0, 0.0, 0.0), &p(2.0, 1.0, 1.0), Label::Obstacle);
    let mut vertices = whole.vertices().to_vec();
    vertices.extend(other.vertices());
    let mut faces = whole.faces().to_vec();
    // The common wall comes once only.
    let wall = |face: &&[u32; 3]| face.iter().any(|&v| other.vertices()[v as usize].x != 1.0);
    faces.extend(other.faces().iter().filter(wall).map(|face| face.map(|v| v + 8)));
    let complex = of(vertices, faces);
    let all = tetrahedralize_in(&complex, &Inside::Enclosed(vec![]), &mut probe::Off);
    assert!((all.expect("it is valid").volume_m3() - 2.0).abs() < 1e-12);
    let hole = Inside::Enclosed(vec![p(1.5, 0.5, 0.5)]);
    let half = tetrahedralize_in(&complex, &hole, &mut probe::Off).expect("it is valid");
    assert!((half.volume_m3() - 1.0).abs() < 1e-12);
    // Of the half that is left out ten faces hang out of the other.
    assert_eq!((half.boundary.len(), half.preserved_faces()), (22, 12));
}

#[test]
fn a_fan_has_the_volume_of_its_view() {
    let view = views(Kind::Noisy, 1).remove(0);
    let constrained = tetrahedralize(&view).expect("it is valid");
    // The sensor is the vertex with most faces.
    let mut uses = vec![0; view.vertices().len()];
    for &v in view.faces().iter().flatten() {
        uses[v as usize] += 1;
    }
    let sensor = (0..uses.len()).max_by_key(|&v| uses[v]).expect("it has vertices");
    let found = fan(&view, &view.vertices()[sensor]).expect("it is a star");
    assert_eq!(found.steiner_points, 0);
    assert!((found.volume_m3() - constrained.volume_m3()).abs() < 1e-9);
    let refused = fan(&view, &p(100.0, 0.0, 0.0)).expect_err("from afar it is none");
    assert!(matches!(refused, SolidError::NotStar { .. }));
}

/// Counts events and remembers their names.
#[derive(Default)]
struct Names(BTreeMap<&'static str, usize>);

impl Probe<TetrahedraEvent<'_>> for Names {
    fn emit(&mut self, event: TetrahedraEvent<'_>) {
        *self.0.entry(event.variant()).or_default() += 1;
    }
}

#[test]
fn a_probe_sees_all_and_changes_nothing() {
    let mesh = schoenhardt();
    let mut names = Names::default();
    let seen = tetrahedralize_with(&mesh, &mut names).expect("it is valid");
    assert_eq!(seen, tetrahedralize(&mesh).expect("it is valid"));
    for name in ["Inserted", "Triangulated", "Exchanged", "SteinerPlaced", "Classified", "Finished"]
    {
        assert!(names.0.contains_key(name), "no {name} in {:?}", names.0);
    }
}

/// No point lies inside the sphere of a tetrahedron; exact.
fn assert_delaunay(points: &[Point3]) {
    let Ok(found) = delaunay(points) else {
        return;
    };
    let coord = |v: u32| {
        let p = &points[v as usize];
        robust::Coord3D { x: p.x, y: p.y, z: p.z }
    };
    for (t, tet) in found.tetrahedra.iter().enumerate() {
        let [a, b, c, d] = *tet;
        let at = |v: u32| &points[v as usize];
        assert!(orient3(at(a), at(b), at(c), at(d)) > 0.0);
        for e in (0..points.len() as u32).filter(|&e| found.representative[e as usize] == e) {
            // With our orientation the sign of the predicate is turned.
            let inside = -robust::insphere(coord(a), coord(b), coord(c), coord(d), coord(e));
            assert!(inside <= 0.0, "point {e} inside of {tet:?}");
        }
        for (corner, other) in found.neighbours[t].iter().enumerate() {
            if let Some(other) = *other {
                assert!(found.neighbours[other as usize].contains(&Some(t as u32)), "{corner}");
            }
        }
    }
    // A ball: V - E + F - T = 1.
    let mut edges = std::collections::BTreeSet::new();
    let mut faces = std::collections::BTreeSet::new();
    let mut vertices = std::collections::BTreeSet::new();
    for tet in &found.tetrahedra {
        let mut v = *tet;
        v.sort_unstable();
        vertices.extend(v);
        for i in 0..4 {
            for j in i + 1..4 {
                edges.insert([v[i], v[j]]);
            }
            let face: Vec<u32> = (0..4).filter(|&k| k != i).map(|k| v[k]).collect();
            faces.insert(face);
        }
    }
    let euler = vertices.len() as i64 - edges.len() as i64 + faces.len() as i64
        - found.tetrahedra.len() as i64;
    assert_eq!(euler, 1);
}

#[test]
fn grids_and_spheres_have_delaunay_tetrahedra() {
    let mut grid = Vec::new();
    for i in 0..125 {
        grid.push(p(f64::from(i % 5), f64::from(i / 5 % 5), f64::from(i / 25)));
    }
    assert_delaunay(&grid);
    let sphere: Vec<Point3> = (0..60)
        .map(|i| {
            let (t, z) = (f64::from(i) * 2.4, f64::from(i) / 30.0 - 0.98);
            let r = (1.0f64 - z * z).sqrt();
            p(r * t.cos(), r * t.sin(), z)
        })
        .collect();
    assert_delaunay(&sphere);
    let flat: Vec<Point3> = (0..20).map(|i| p(f64::from(i % 5), f64::from(i / 5), 0.0)).collect();
    assert_eq!(delaunay(&flat), Err(SolidError::Coplanar { points: 20 }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn points_on_a_small_lattice(cells in prop::collection::vec((0u8..4, 0u8..4, 0u8..4), 4..40)) {
        let points: Vec<Point3> =
            cells.iter().map(|&(x, y, z)| p(f64::from(x), f64::from(y), f64::from(z))).collect();
        assert_delaunay(&points);
        prop_assert_eq!(delaunay(&points), delaunay(&points));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn boxes_on_a_lattice_unite(cells in prop::collection::vec((0u8..3, 0u8..3, 0u8..3), 1..5)) {
        let boxes: Vec<Polyhedron> = cells
            .iter()
            .map(|&(x, y, z)| {
                let low = p(f64::from(x), f64::from(y), f64::from(z));
                Polyhedron::cuboid(&low, &(low + solid::Vector3::new(1.5, 1.25, 1.0)), Label::Obstacle)
            })
            .collect();
        let map = solid::mesh::weld(&unite(&boxes, &Options::default()).expect("boxes unite")).mesh;
        if solid::check(&map).is_valid() {
            let found = tetrahedralize(&map).expect("it is valid");
            assert_laws(&map, &found);
            prop_assert_eq!(&found, &tetrahedralize(&map).expect("it is valid"));
        }
    }
}
