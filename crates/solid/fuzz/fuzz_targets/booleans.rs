//! Chains of booleans of boxes that share planes, held against the cells of their lattice: volume, and
//! area per label where the obstacle wins. Bytes say where the boxes are, how their sides are labelled and
//! what is made of them.

#![no_main]

use libfuzzer_sys::fuzz_target;
use solid::boolean::Options;
use solid::validity::check_topology;
use solid::{Label, Operation, Point3, Polyhedron, boolean, crossings};

/// Cells along each axis, with a row of empty ones all round; a cell is a quarter of a metre.
const CELLS: usize = 8;
const CELL_M: f64 = 0.25;
const MOST_BOXES: usize = 5;

/// What of the lattice is solid, and how the sides of cells are labelled: across each axis, below the
/// cell.
#[derive(Clone)]
struct Cells {
    solid: Vec<bool>,
    sides: Vec<[Option<Label>; 3]>,
}

fn index([x, y, z]: [usize; 3]) -> usize {
    (x * CELLS + y) * CELLS + z
}

fn places() -> impl Iterator<Item = [usize; 3]> {
    (0..CELLS.pow(3)).map(|i| [i / CELLS / CELLS, i / CELLS % CELLS, i % CELLS])
}

/// The cell below across an axis.
fn below(mut place: [usize; 3], axis: usize) -> Option<usize> {
    place[axis] = place[axis].checked_sub(1)?;
    Some(index(place))
}

impl Cells {
    fn of(low: [usize; 3], high: [usize; 3], labels: [[Label; 2]; 3]) -> Self {
        let holds = |p: [usize; 3]| (0..3).all(|k| low[k] <= p[k] && p[k] < high[k]);
        let solid: Vec<bool> = places().map(holds).collect();
        let side = |p: [usize; 3], k: usize| {
            let before = below(p, k).is_some_and(|i| solid[i]);
            (before != solid[index(p)]).then(|| labels[k][usize::from(before)])
        };
        let sides = places().map(|p| [0, 1, 2].map(|k| side(p, k))).collect();
        Self { solid, sides }
    }

    fn combined(&self, other: &Self, operation: Operation) -> Self {
        let pairs = self.solid.iter().zip(&other.solid);
        let solid: Vec<bool> = pairs
            .map(|(&a, &b)| match operation {
                Operation::Union => a || b,
                Operation::Intersection => a && b,
                Operation::Difference => a && !b,
                Operation::SymmetricDifference => a != b,
            })
            .collect();
        let side = |p: [usize; 3], k: usize| {
            let both = [self.sides[index(p)][k], other.sides[index(p)][k]];
            let wins = both.contains(&Some(Label::Obstacle));
            let meets = below(p, k).is_some_and(|i| solid[i]) != solid[index(p)];
            meets.then_some(if wins { Label::Obstacle } else { Label::Frontier })
        };
        let sides = places().map(|p| [0, 1, 2].map(|k| side(p, k))).collect();
        Self { solid, sides }
    }

    fn volume_m3(&self) -> f64 {
        self.solid.iter().filter(|&&is| is).count() as f64 * CELL_M.powi(3)
    }

    fn area_m2(&self, label: Label) -> f64 {
        let of = self.sides.as_flattened().iter().filter(|&&side| side == Some(label));
        of.count() as f64 * CELL_M.powi(2)
    }
}

/// A box from four bytes: where it starts, how long it is, how its sides are labelled.
fn cuboid(bytes: &[u8]) -> (Polyhedron, Cells) {
    let low = [0, 1, 2].map(|k| 1 + usize::from(bytes[k] & 7) % (CELLS - 2));
    let high = [0, 1, 2].map(|k| (low[k] + 1 + usize::from(bytes[k] >> 3 & 3)).min(CELLS - 1));
    let bit = |k: usize| {
        if bytes[3] >> k & 1 == 1 { Label::Obstacle } else { Label::Frontier }
    };
    let labels = [0, 1, 2].map(|k| [bit(2 * k), bit(2 * k + 1)]);
    let corner = |at: [usize; 3]| Point3::from(at.map(|c| c as f64 * CELL_M));
    let mesh = Polyhedron::cuboid(&corner(low), &corner(high), Label::Obstacle);
    let label = |face: usize| {
        let normal = mesh.scaled_normal(face);
        let axis = normal.iamax();
        labels[axis][usize::from(normal[axis] > 0.0)]
    };
    let of_faces = (0..mesh.faces().len()).map(label).collect();
    (mesh.with_labels(of_faces).expect("one each"), Cells::of(low, high, labels))
}

fuzz_target!(|bytes: &[u8]| {
    let boxes: Vec<&[u8]> = bytes.chunks_exact(5).take(MOST_BOXES).collect();
    let Some((first, rest)) = boxes.split_first() else { return };
    let (mut mesh, mut cells) = cuboid(first);
    for bytes in rest {
        let (other, theirs) = cuboid(bytes);
        let operation = [
            Operation::Union,
            Operation::Intersection,
            Operation::Difference,
            Operation::SymmetricDifference,
        ][usize::from(bytes[4] & 3)];
        let (a, b) = if bytes[4] & 4 == 0 { (&mesh, &other) } else { (&other, &mesh) };
        let found = boolean(a, b, operation, &Options::default()).expect("sound operands");
        let of = if bytes[4] & 4 == 0 {
            cells.combined(&theirs, operation)
        } else {
            theirs.combined(&cells, operation)
        };
        assert!(check_topology(&found).is_valid());
        let (volume, expected) = (found.volume_m3(), of.volume_m3());
        assert!((volume - expected).abs() < 1e-9, "{operation}: {volume}, {expected} expected");
        // Sheets that are left over have no volume, but an area.
        if !crossings(&found, 1).is_empty() {
            return;
        }
        for label in Label::ALL {
            let (area, expected) = (found.area_by_label().of(label), of.area_m2(label));
            assert!((area - expected).abs() < 1e-9, "{operation}, {label}: {area}, {expected}");
        }
        (mesh, cells) = (found, of);
    }
});
