//! Boxes and tetrahedra.

use super::{Face, Label, Polyhedron};
use crate::Point3;

/// The faces of a box whose corner `4 i + 2 j + k` is high in x, y and z where i, j and k are 1.
const CUBOID: [Face; 12] = [
    [0, 1, 3],
    [0, 3, 2],
    [4, 6, 7],
    [4, 7, 5],
    [0, 4, 5],
    [0, 5, 1],
    [2, 3, 7],
    [2, 7, 6],
    [0, 2, 6],
    [0, 6, 4],
    [1, 5, 7],
    [1, 7, 3],
];

impl Polyhedron {
    /// An axis-parallel box with one label; `high` must exceed `low` in every coordinate.
    pub fn cuboid(low: &Point3, high: &Point3, label: Label) -> Self {
        let pick = |corner: usize, axis: usize| {
            if corner >> (2 - axis) & 1 == 1 { high[axis] } else { low[axis] }
        };
        let vertices = (0..8).map(|i| Point3::new(pick(i, 0), pick(i, 1), pick(i, 2))).collect();
        Self::from_sound_parts(vertices, CUBOID.to_vec(), vec![label; 12], None)
    }

    /// A tetrahedron with one label; `d` must lie on the side of `a`, `b`, `c` from which they run
    /// counter-clockwise.
    pub fn tetrahedron(a: Point3, b: Point3, c: Point3, d: Point3, label: Label) -> Self {
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Self::from_sound_parts(vec![a, b, c, d], faces, vec![label; 4], None)
    }
}
