//! What a missing segment runs through.

use super::meets::{Meets, meets};
use crate::tetrahedra::mesh::{FACE, GHOST, Mesh, Ring};

/// What a segment meets first on its way from one end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum First {
    /// Its other end: it is an edge of this tetrahedron.
    Present(u32),
    /// The face opposite a corner of a tetrahedron.
    Face(u32, usize),
    /// An edge of a tetrahedron.
    Edge(u32, u32, u32),
    /// A vertex.
    Vertex(u32),
    /// Nothing that could be told: the tetrahedra round the end are broken, a bug of ours.
    Lost,
}

/// All that a segment meets between its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct Way {
    /// The tetrahedra that it passes or touches.
    pub(crate) tets: Vec<u32>,
    /// The faces passed in their interior, by a tetrahedron and the face's index.
    pub(crate) faces: Vec<(u32, usize)>,
    /// The edges met, with a tetrahedron.
    pub(crate) edges: Vec<(u32, u32, u32)>,
    /// The vertices met.
    pub(crate) vertices: Vec<u32>,
}

/// How many steps a walk round a vertex takes before all of its tetrahedra are looked through.
const PATIENCE: usize = 300;

impl Mesh {
    /// What the segment from `a` to `b` meets first.
    pub(crate) fn first_met(&mut self, a: u32, b: u32) -> First {
        let mut t = self.at[a as usize];
        let mut behind = u32::MAX;
        let mut turn = 0x9e37_79b9u32;
        for _ in 0..PATIENCE {
            let tet = *self.tet(t);
            if tet.v.contains(&b) {
                return First::Present(t);
            }
            turn ^= turn << 13;
            turn ^= turn >> 17;
            turn ^= turn << 5;
            let mut onward = None;
            for step in 0..4 {
                let f = ((turn >> 8) as usize + step) & 3;
                if tet.v[f] == a || (tet.n[f] >> 2) == behind {
                    continue;
                }
                let [x, y, z] = FACE[f].map(|i| tet.v[i]);
                if x == GHOST || y == GHOST || z == GHOST {
                    continue;
                }
                let side = self.orient(x, y, z, b);
                if side < 0.0 {
                    onward = Some(tet.n[f] >> 2);
                    break;
                }
            }
            match onward {
                Some(next) if !self.tet(next).is_ghost() => {
                    behind = t;
                    t = next;
                }
                Some(_) => break,
                None => return self.leaves_by(t, a, b),
            }
        }
        let found = self.search_star(a, |mesh, t| {
            let tet = mesh.tet(t);
            !tet.is_ghost()
                && (tet.v.contains(&b)
                    || (0..4).filter(|&f| tet.v[f] != a).all(|f| {
                        let [x, y, z] = tet.face(f);
                        mesh.orient(x, y, z, b) >= 0.0
                    }))
        });
        let Some(t) = found else { return First::Lost };
        if self.tet(t).v.contains(&b) {
            return First::Present(t);
        }
        self.leaves_by(t, a, b)
    }

    /// How the segment leaves a tetrahedron at `a` whose cone it runs in.
    fn leaves_by(&self, t: u32, a: u32, b: u32) -> First {
        let tet = self.tet(t);
        let mut flat = [false; 4];
        let mut count = 0;
        let mut home = 0;
        for (f, is_flat) in flat.iter_mut().enumerate() {
            if tet.v[f] == a {
                home = f;
                continue;
            }
            let [x, y, z] = tet.face(f);
            if self.orient(x, y, z, b) == 0.0 {
                *is_flat = true;
                count += 1;
            }
        }
        let rest = |skip: &dyn Fn(usize) -> bool| {
            let mut it = (0..4).filter(|&f| f != home && !skip(f)).map(|f| tet.v[f]);
            (it.next(), it.next())
        };
        match count {
            0 => First::Face(t, home),
            1 => match rest(&|f| flat[f]) {
                (Some(u), Some(v)) => First::Edge(t, u, v),
                _ => First::Lost,
            },
            2 => match rest(&|f| flat[f]) {
                (Some(v), _) => First::Vertex(v),
                _ => First::Lost,
            },
            _ => First::Lost,
        }
    }

    /// All that the segment from `a` to `b` meets, spreading from what it meets first. Nothing where it
    /// is an edge.
    pub(crate) fn way(&mut self, a: u32, b: u32) -> Way {
        let mut way = Way::default();
        let start = match self.first_met(a, b) {
            First::Face(t, _) | First::Edge(t, _, _) => t,
            First::Vertex(v) => {
                way.vertices.push(v);
                return way;
            }
            First::Present(_) | First::Lost => return way,
        };
        let epoch = self.next_epoch();
        let mut ring = Ring::default();
        self.stamp[start as usize] = epoch;
        way.tets.push(start);
        let mut next = 0;
        while next < way.tets.len() {
            let t = way.tets[next];
            next += 1;
            let tet = *self.tet(t);
            for f in 0..4 {
                let corners = tet.face(f);
                let other = tet.n[f] >> 2;
                match meets(self, [a, b], corners) {
                    Meets::Not => continue,
                    Meets::Inside => {
                        if self.stamp[other as usize] != epoch {
                            self.stamp[other as usize] = epoch;
                            way.tets.push(other);
                            way.faces.push((t, f));
                        }
                    }
                    Meets::Edge(u, v) => {
                        if way.edges.iter().any(|&(_, x, y)| (x, y) == (u, v) || (y, x) == (u, v)) {
                            continue;
                        }
                        way.edges.push((t, u, v));
                        if self.ring(t, u, v, usize::MAX, &mut ring) {
                            for &t in &ring.tets {
                                if self.stamp[t as usize] != epoch {
                                    self.stamp[t as usize] = epoch;
                                    way.tets.push(t);
                                }
                            }
                        }
                    }
                    Meets::Vertex(v) => {
                        if !way.vertices.contains(&v) {
                            way.vertices.push(v);
                        }
                    }
                }
            }
        }
        way
    }
}
