//! What lies round an edge or a vertex.

use super::complex::Mesh;
use super::tet::{GHOST, NONE, Tet};

/// The tetrahedra round an edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ring {
    /// The vertices round the edge: with the edge, each and its successor make a positive
    /// tetrahedron.
    pub(crate) vertices: Vec<u32>,
    /// The tetrahedron of each vertex and its successor.
    pub(crate) tets: Vec<u32>,
}

impl Mesh {
    /// A tetrahedron that has the edge from `u` to `v`, if there is one. O(degree of `u`).
    pub(crate) fn find_edge(&mut self, u: u32, v: u32) -> Option<u32> {
        self.search_star(u, |mesh, t| mesh.tet(t).index_of(v).is_some())
    }

    /// [`find_edge`](Self::find_edge), where it is likely an edge of tetrahedron `guess`.
    pub(crate) fn edge_near(&mut self, guess: u32, u: u32, v: u32) -> Option<u32> {
        let has_both = |tet: &Tet| tet.v.contains(&u) && tet.v.contains(&v);
        match self.tets.get(guess as usize) {
            Some(tet) if has_both(tet) => Some(guess),
            _ => self.find_edge(u, v),
        }
    }

    /// A tetrahedron and the index in it of the face `a`, `b`, `c`, if there is one.
    pub(crate) fn find_face(&mut self, a: u32, b: u32, c: u32) -> Option<(u32, usize)> {
        let t = self.search_star(a, |mesh, t| {
            let tet = mesh.tet(t);
            tet.index_of(b).is_some() && tet.index_of(c).is_some()
        })?;
        let tet = self.tet(t);
        (0..4).find(|&i| tet.v[i] != a && tet.v[i] != b && tet.v[i] != c).map(|i| (t, i))
    }

    /// The first tetrahedron at `vertex`, spreading from one, of which `wanted` holds.
    pub(crate) fn search_star(
        &mut self,
        vertex: u32,
        mut wanted: impl FnMut(&Self, u32) -> bool,
    ) -> Option<u32> {
        let start = self.at[vertex as usize];
        if start == NONE {
            return None;
        }
        let epoch = self.next_epoch();
        self.stamp[start as usize] = epoch;
        let mut queue = std::mem::take(&mut self.queue);
        queue.clear();
        queue.push(start);
        let mut next = 0;
        let mut found = None;
        while next < queue.len() {
            let t = queue[next];
            next += 1;
            if wanted(self, t) {
                found = Some(t);
                break;
            }
            let tet = *self.tet(t);
            for f in 0..4 {
                if tet.v[f] == vertex {
                    continue;
                }
                let other = tet.n[f] >> 2;
                if self.stamp[other as usize] != epoch {
                    self.stamp[other as usize] = epoch;
                    queue.push(other);
                }
            }
        }
        self.queue = queue;
        found
    }

    /// All tetrahedra at `vertex`, ghosts too.
    pub(crate) fn star(&mut self, vertex: u32) -> Vec<u32> {
        let mut all = Vec::new();
        self.search_star(vertex, |_, t| {
            all.push(t);
            false
        });
        all
    }

    /// The ring round the edge `u`, `v` of tetrahedron `start` into `ring`; false where it touches
    /// the ghost or has more than `most` tetrahedra.
    pub(crate) fn ring(&self, start: u32, u: u32, v: u32, most: usize, ring: &mut Ring) -> bool {
        ring.vertices.clear();
        ring.tets.clear();
        let tet = self.tet(start);
        // In an even order (u, v, p, q) of the corners the orientation stays positive.
        let (Some(iu), Some(iv)) = (tet.index_of(u), tet.index_of(v)) else { return false };
        let [p, q] = rest(iu, iv);
        let (first, mut on) = (tet.v[p], tet.v[q]);
        let mut t = start;
        let mut behind = first;
        loop {
            if on == GHOST || behind == GHOST || ring.tets.len() >= most {
                return false;
            }
            ring.vertices.push(behind);
            ring.tets.push(t);
            let Some(away) = self.tet(t).index_of(behind) else { return false };
            let code = self.tet(t).n[away];
            t = code >> 2;
            behind = on;
            on = self.tet(t).v[(code & 3) as usize];
            if t == start {
                return true;
            }
        }
    }
}

/// The two other corners, so that `(u, v, p, q)` is an even permutation of the four.
#[inline]
fn rest(u: usize, v: usize) -> [usize; 2] {
    const REST: [[[usize; 2]; 4]; 4] = [
        [[0, 0], [2, 3], [3, 1], [1, 2]],
        [[3, 2], [0, 0], [0, 3], [2, 0]],
        [[1, 3], [3, 0], [0, 0], [0, 1]],
        [[2, 1], [0, 2], [1, 0], [0, 0]],
    ];
    REST[u][v]
}

#[cfg(test)]
mod tests {
    use super::rest;

    #[test]
    fn the_rest_keeps_the_permutation_even() {
        for u in 0..4 {
            for v in (0..4).filter(|&v| v != u) {
                let [p, q] = rest(u, v);
                let order = [u, v, p, q];
                let mut seen = order;
                seen.sort_unstable();
                assert_eq!(seen, [0, 1, 2, 3]);
                let inversions = (0..4)
                    .flat_map(|i| (i + 1..4).map(move |j| (i, j)))
                    .filter(|&(i, j)| order[i] > order[j])
                    .count();
                assert_eq!(inversions % 2, 0, "{order:?}");
            }
        }
    }
}
