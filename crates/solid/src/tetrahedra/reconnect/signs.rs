//! The orientations of all quadruples of a few points.

use crate::tetrahedra::flips::{FLAT, evenness};
use crate::tetrahedra::mesh::Mesh;

/// The sign of the orientation of every quadruple of some vertices, numbered from 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Signs {
    /// How many vertices.
    pub(super) count: usize,
    sign: Vec<i8>,
}

impl Signs {
    /// Computes all of them: one exact test for each four vertices.
    pub(super) fn fill(&mut self, mesh: &Mesh, vertices: &[u32]) {
        let m = vertices.len();
        self.count = m;
        self.sign.clear();
        self.sign.resize(m * m * m * m, 0);
        for a in 0..m {
            for b in a + 1..m {
                for c in b + 1..m {
                    for d in c + 1..m {
                        let value = mesh.orient(vertices[a], vertices[b], vertices[c], vertices[d]);
                        let sign = i8::from(value > 0.0) - i8::from(value < 0.0);
                        if sign != 0 {
                            let four = [a, b, c, d].map(|i| vertices[i]);
                            let flat = evenness(mesh, value.abs(), four) < FLAT;
                            self.spread([a, b, c, d], if flat { sign } else { 2 * sign });
                        }
                    }
                }
            }
        }
    }

    /// Writes one sign to all orders of its four vertices.
    fn spread(&mut self, [a, b, c, d]: [usize; 4], sign: i8) {
        const EVEN: [[usize; 4]; 12] = [
            [0, 1, 2, 3],
            [0, 2, 3, 1],
            [0, 3, 1, 2],
            [1, 0, 3, 2],
            [1, 2, 0, 3],
            [1, 3, 2, 0],
            [2, 0, 1, 3],
            [2, 1, 3, 0],
            [2, 3, 0, 1],
            [3, 0, 2, 1],
            [3, 1, 0, 2],
            [3, 2, 1, 0],
        ];
        let v = [a, b, c, d];
        for [i, j, k, l] in EVEN {
            let even = self.place([v[i], v[j], v[k], v[l]]);
            let odd = self.place([v[i], v[j], v[l], v[k]]);
            self.sign[even] = sign;
            self.sign[odd] = -sign;
        }
    }

    #[inline]
    fn place(&self, [a, b, c, d]: [usize; 4]) -> usize {
        ((a * self.count + b) * self.count + c) * self.count + d
    }

    /// The sign of four vertices; 0 where two are the same, or all are coplanar.
    #[inline]
    pub(super) fn of(&self, a: u8, b: u8, c: u8, d: u8) -> i8 {
        self.sign[self.place([a as usize, b as usize, c as usize, d as usize])].signum()
    }

    /// Whether four vertices make a positive tetrahedron that is not nearly flat.
    #[inline]
    pub(super) fn is_even(&self, a: u8, b: u8, c: u8, d: u8) -> bool {
        self.sign[self.place([a as usize, b as usize, c as usize, d as usize])] == 2
    }

    /// Whether the open segment `p`, `q` passes the closed triangle, not in its plane.
    #[inline]
    pub(super) fn passes(&self, p: u8, q: u8, [x, y, z]: [u8; 3]) -> bool {
        let side = self.of(x, y, z, p);
        if side == 0 || self.of(x, y, z, q) != -side {
            return false;
        }
        self.of(p, q, x, y) * side <= 0
            && self.of(p, q, y, z) * side <= 0
            && self.of(p, q, z, x) * side <= 0
    }
}
