//! Tetrahedra of 8,000 polyhedra that nobody would draw: what bounds a random choice among the Delaunay
//! tetrahedra of random points. They touch themselves at edges and vertices, have cavities and several
//! parts, and all of them can be filled, for the chosen tetrahedra do. `PROPTEST_CASES` says how many of
//! each of the eight kinds there are.

use std::collections::BTreeMap;

use solid::predicates::orient3;
use solid::tetrahedra::delaunay;
use solid::{Label, Point3, Polyhedron, SolidError, Tetrahedra, tetrahedralize};

/// A small generator of random numbers: xorshift.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, count: u64) -> u64 {
        (self.next() >> 33) % count
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// How points are spread.
#[derive(Clone, Copy)]
enum Spread {
    /// In a cube.
    Cube,
    /// On a small lattice: many are coplanar and cospherical.
    Lattice,
    /// In a plate a millionth as thick as it is wide.
    Plate,
    /// Along a line, a thousandth as wide as it is long.
    Needle,
}

fn points(spread: Spread, count: usize, random: &mut Random) -> Vec<Point3> {
    let mut point = || {
        let [x, y, z] = [random.unit(), random.unit(), random.unit()];
        let cell = [random.below(4), random.below(4), random.below(4)].map(|c| c as f64);
        match spread {
            Spread::Cube => Point3::new(x, y, z),
            Spread::Lattice => Point3::from(cell),
            Spread::Plate => Point3::new(x, y, z * 1e-6),
            Spread::Needle => Point3::new(x, y * 1e-3, z * 1e-3),
        }
    };
    (0..count).map(|_| point()).collect()
}

/// What bounds about half of the Delaunay tetrahedra of some points; `None` where all are coplanar.
fn polyhedron(spread: Spread, random: &mut Random) -> Option<Polyhedron> {
    let count = 5 + random.below(16) as usize;
    let points = points(spread, count, random);
    let cells = delaunay(&points).ok()?;
    let chosen: Vec<bool> = cells.tetrahedra.iter().map(|_| random.below(3) > 0).collect();
    let mut faces = Vec::new();
    for (t, &[a, b, c, d]) in cells.tetrahedra.iter().enumerate().filter(|&(t, _)| chosen[t]) {
        // Seen from outside.
        for (corner, face) in [[b, d, c], [a, c, d], [a, d, b], [a, b, c]].into_iter().enumerate() {
            let other = cells.neighbours[t][corner];
            if !other.is_some_and(|other| chosen[other as usize]) {
                let [x, y, z] = face;
                faces.push([x, z, y]);
            }
        }
    }
    let labels = vec![Label::Obstacle; faces.len()];
    Polyhedron::try_new(points, faces, labels).ok().filter(|mesh| !mesh.faces().is_empty())
}

/// Positive, mutual neighbours, the boundary is the input, one to one, and the volume is right.
fn assert_sound(mesh: &Polyhedron, found: &Tetrahedra) {
    let at = |v: u32| &found.vertices[v as usize];
    let mut faces: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    for (t, &[a, b, c, d]) in found.tetrahedra.iter().enumerate() {
        assert!(orient3(at(a), at(b), at(c), at(d)) > 0.0, "tetrahedron {t} is not positive");
        for (corner, mut face) in
            [[b, c, d], [a, c, d], [a, b, d], [a, b, c]].into_iter().enumerate()
        {
            if let Some(other) = found.neighbours[t][corner] {
                assert!(found.neighbours[other as usize].contains(&Some(t as u32)));
                assert!(face.iter().all(|v| found.tetrahedra[other as usize].contains(v)));
            }
            face.sort_unstable();
            *faces.entry(face).or_default() += 1;
        }
    }
    let outer: Vec<[u32; 3]> =
        faces.into_iter().filter(|&(_, count)| count == 1).map(|(face, _)| face).collect();
    let sorted = |mut face: [u32; 3]| {
        face.sort_unstable();
        face
    };
    let mut given: Vec<[u32; 3]> = mesh.faces().iter().map(|&face| sorted(face)).collect();
    given.sort_unstable();
    assert_eq!(outer, given, "the boundary differs");
    let (ours, theirs) = (found.volume_m3(), mesh.volume_m3());
    assert!((ours - theirs.abs()).abs() <= 1e-9 * theirs.abs() + 1e-18, "{ours} {theirs}");
}

/// Many polyhedra of one kind: all are filled, but for at most `refusals` that are refused by name.
fn many(spread: Spread, seed: u64, refusals: usize) {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let (mut tried, mut refused) = (0, 0);
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|told| told.parse().ok());
    while tried < cases.unwrap_or(1000) {
        let Some(mesh) = polyhedron(spread, &mut random) else { continue };
        tried += 1;
        match tetrahedralize(&mesh) {
            Ok(found) => assert_sound(&mesh, &found),
            Err(SolidError::NoRoom { faces }) => {
                assert!(!faces.is_empty());
                refused += 1;
            }
            Err(error) => panic!("input {tried}: {error}"),
        }
    }
    assert!(refused <= refusals, "{refused} refused");
}

#[test]
fn a_thousand_in_a_cube() {
    many(Spread::Cube, 1, 0);
}

#[test]
fn a_thousand_more_in_a_cube() {
    many(Spread::Cube, 2, 0);
}

#[test]
fn a_thousand_on_a_lattice() {
    many(Spread::Lattice, 3, 0);
}

#[test]
fn a_thousand_more_on_a_lattice() {
    many(Spread::Lattice, 4, 0);
}

#[test]
fn a_thousand_plates() {
    many(Spread::Plate, 7, 0);
}

#[test]
fn a_thousand_more_plates() {
    many(Spread::Plate, 8, 0);
}

#[test]
fn a_thousand_needles() {
    many(Spread::Needle, 9, 0);
}

#[test]
fn a_thousand_more_needles() {
    many(Spread::Needle, 10, 0);
}
