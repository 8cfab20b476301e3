//! Inserting a point: what conflicts with it goes, and a star takes its place.

use crate::tetrahedra::mesh::{FACE, GHOST, Mesh, Tet};
use crate::tetrahedra::predicates::{P3, in_sphere, orient};

/// Buffers that insertions use again and again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cavity {
    /// The tetrahedra whose spheres hold the point.
    pub(crate) inside: Vec<u32>,
    /// The faces of the cavity: four times the conflicting tetrahedron plus the face.
    pub(crate) walls: Vec<u32>,
    /// The new tetrahedra, one per wall.
    pub(crate) made: Vec<u32>,
}

impl Mesh {
    /// Whether the sphere of tetrahedron `t` holds the point `p` of vertex `vertex`; the sphere of a
    /// ghost is the half space beyond its face, with the disc of the face.
    #[inline]
    fn conflicts(&self, t: u32, p: &P3, vertex: u32) -> bool {
        let mut tet = self.tet(t);
        if let Some(g) = tet.index_of(GHOST) {
            let [a, b, c] = FACE[g].map(|i| self.point(tet.v[i]));
            let side = orient(a, b, c, p);
            if side != 0.0 {
                return side > 0.0;
            }
            // In the plane of the face, its disc is where that plane cuts its neighbour's sphere.
            tet = self.tet(tet.n[g] >> 2);
        }
        let [a, b, c, d] = tet.v.map(|v| (self.point(v), v));
        in_sphere(a, b, c, d, (p, vertex))
    }

    /// Inserts `vertex`, which lies in the closed tetrahedron `start` but on no vertex (\[Bow81\],
    /// \[Wat81\]). Returns one of the new tetrahedra. Expected O(1) in an order as of `brio`.
    pub(crate) fn insert_in(&mut self, vertex: u32, start: u32, cavity: &mut Cavity) -> u32 {
        let p = *self.point(vertex);
        let inside_mark = self.next_epoch();
        let outside_mark = inside_mark + 1;
        let Cavity { inside, walls, made } = cavity;
        inside.clear();
        walls.clear();
        made.clear();
        inside.push(start);
        self.stamp[start as usize] = inside_mark;
        let mut next = 0;
        while next < inside.len() {
            let t = inside[next];
            next += 1;
            let neighbours = self.tet(t).n;
            for (f, code) in neighbours.into_iter().enumerate() {
                let other = code >> 2;
                let mark = self.stamp[other as usize];
                if mark == inside_mark {
                    continue;
                }
                if mark != outside_mark {
                    if self.conflicts(other, &p, vertex) {
                        self.stamp[other as usize] = inside_mark;
                        inside.push(other);
                        continue;
                    }
                    self.stamp[other as usize] = outside_mark;
                }
                walls.push(4 * t + f as u32);
            }
        }
        self.star_from(vertex, inside_mark, walls, made);
        for &t in inside.iter() {
            self.tets[t as usize] = Tet::FREE;
            self.free.push(t);
        }
        made[0]
    }

    /// Joins every wall to the vertex, and the new tetrahedra to one another.
    fn star_from(&mut self, vertex: u32, inside_mark: u32, walls: &[u32], made: &mut Vec<u32>) {
        for &wall in walls {
            let (t, f) = (wall >> 2, (wall & 3) as usize);
            let slot = self.take_slot();
            let [x, y, z] = self.tet(t).face(f);
            let outer = self.tet(t).n[f];
            self.tets[slot as usize] = Tet { v: [x, y, z, vertex], n: [u32::MAX; 4] };
            self.join(4 * slot + 3, outer);
            // The wall remembers what stands on it: nothing walks through it any more.
            self.tets[t as usize].n[f] = 4 * slot + 3;
            self.stamp[slot as usize] = 0;
            for v in [x, y, z] {
                if v != GHOST {
                    self.at[v as usize] = slot;
                }
            }
            self.at[vertex as usize] = slot;
            made.push(slot);
        }
        for (&wall, &slot) in walls.iter().zip(made.iter()) {
            let corners = FACE[(wall & 3) as usize];
            for (j, &first) in corners.iter().enumerate() {
                if self.tet(slot).n[j] != u32::MAX {
                    continue;
                }
                // Turn round the edge opposite corner j of the wall, through the cavity, to the next wall.
                let (mut t, f) = (wall >> 2, (wall & 3) as usize);
                let mut through = first;
                let mut apex = self.tet(t).v[f];
                let mut code = self.tet(t).n[through];
                while self.stamp[(code >> 2) as usize] == inside_mark {
                    t = code >> 2;
                    let came = (code & 3) as usize;
                    through = self.tet(t).index_of(apex).unwrap_or(0);
                    apex = self.tet(t).v[came];
                    code = self.tet(t).n[through];
                }
                let found = code >> 2;
                // The two share the edge and the new vertex: the corner of the other wall that is not on
                // the edge is the apex of the last tetrahedron passed.
                let k = self.tet(found).index_of(apex).unwrap_or(0);
                self.join(4 * slot + j as u32, 4 * found + k as u32);
            }
        }
    }
}
