//! The search for tetrahedra that fill a region.

use super::signs::Signs;
use crate::tetrahedra::mesh::FACE;

/// What a triangle of the region is to the search.
const OPEN: i8 = 0;
const CLOSED: i8 = 2;

/// A bounded depth-first search over all ways to fill a region with tetrahedra on its vertices.
///
/// The front is the set of triangles behind which space is still to be filled. In each step the front
/// triangle with the fewest candidate apexes is taken, and each candidate tried. Where the front is
/// empty, all tetrahedra are positive and their faces cancel but for the region's own: then they fill
/// it, each point once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    pub(super) signs: Signs,
    m: usize,
    /// Whether an edge may appear.
    edge_ok: Vec<bool>,
    /// Whether a triangle may appear, by its sorted corners.
    face_ok: Vec<bool>,
    /// 1 or -1 where the triangle is on the front, the sign of its order of corners.
    state: Vec<i8>,
    /// How many tetrahedra or faces of the surface have the edge.
    edge_use: Vec<u16>,
    front: Vec<[u8; 3]>,
    made: Vec<[u8; 4]>,
    /// Vertices that may be an apex.
    usable: Vec<bool>,
    /// Whether nearly flat tetrahedra are no candidates.
    pub(super) even: bool,
    /// How many steps may yet be taken.
    pub(crate) steps: u32,
    /// How often no apex was found for each face of the surface, by its place in the tables.
    blame: Vec<u32>,
}

impl Search {
    /// Prepares a search over `m` vertices whose signs are known.
    ///
    /// `surface` are the faces of the region, positive towards its inside; `segments` and `facets` must
    /// not be passed; `usable` says which vertices may be used.
    pub(super) fn prepare(
        &mut self,
        surface: &[[u8; 3]],
        segments: &[[u8; 2]],
        facets: &[[u8; 3]],
        usable: Vec<bool>,
    ) {
        let m = self.signs.count;
        self.m = m;
        self.usable = usable;
        self.edge_ok = vec![true; m * m];
        self.face_ok = vec![true; m * m * m];
        self.state = vec![OPEN; m * m * m];
        self.edge_use = vec![0; m * m];
        self.blame.clear();
        self.blame.resize(m * m * m, 0);
        self.front.clear();
        self.made.clear();
        for p in 0..m as u8 {
            for q in p + 1..m as u8 {
                let ok = !surface.iter().chain(facets).any(|&face| self.signs.passes(p, q, face));
                let place = self.edge(p, q);
                self.edge_ok[place] = ok;
            }
        }
        let mut bars: Vec<[u8; 2]> = segments.to_vec();
        for &[x, y, z] in surface {
            for [a, b] in [[x, y], [y, z], [z, x]] {
                if a < b {
                    bars.push([a, b]);
                }
            }
        }
        for x in 0..m as u8 {
            for y in x + 1..m as u8 {
                for z in y + 1..m as u8 {
                    let edges = self.edge_ok[self.edge(x, y)]
                        && self.edge_ok[self.edge(y, z)]
                        && self.edge_ok[self.edge(x, z)];
                    let ok =
                        edges && !bars.iter().any(|&[p, q]| self.signs.passes(p, q, [x, y, z]));
                    let place = self.face([x, y, z]).0;
                    self.face_ok[place] = ok;
                }
            }
        }
        for &face in surface {
            let (place, sign) = self.face(face);
            // Faces with nothing between them, back to back, are no front.
            self.state[place] = if self.state[place] == -sign { CLOSED } else { sign };
        }
        for &face in surface {
            let (place, sign) = self.face(face);
            if self.state[place] == sign {
                self.front.push(face);
                self.use_edges(face, 1);
            }
        }
    }

    #[inline]
    fn edge(&self, p: u8, q: u8) -> usize {
        let (p, q) = if p < q { (p, q) } else { (q, p) };
        p as usize * self.m + q as usize
    }

    /// The place of a triangle in the tables, and the sign of its order of corners.
    #[inline]
    fn face(&self, [x, y, z]: [u8; 3]) -> (usize, i8) {
        let mut v = [x, y, z];
        let mut sign = 1;
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if v[i] > v[j] {
                v.swap(i, j);
                sign = -sign;
            }
        }
        ((v[0] as usize * self.m + v[1] as usize) * self.m + v[2] as usize, sign)
    }

    fn use_edges(&mut self, [x, y, z]: [u8; 3], by: i32) {
        for [a, b] in [[x, y], [y, z], [z, x]] {
            let place = self.edge(a, b);
            self.edge_use[place] = self.edge_use[place].wrapping_add_signed(by as i16);
        }
    }

    /// Searches, for at most `steps` steps; the tetrahedra, or nothing.
    pub(super) fn run(&mut self, steps: u32) -> Option<&[[u8; 4]]> {
        self.steps = steps;
        if self.descend() { Some(&self.made) } else { None }
    }

    /// How often no apex was found for a face of the surface.
    pub(super) fn blame(&self, face: [u8; 3]) -> u32 {
        self.blame[self.face(face).0]
    }

    /// One level: each adds a tetrahedron, so that their number bounds the depth.
    fn descend(&mut self) -> bool {
        if self.front.is_empty() {
            return true;
        }
        if self.steps == 0 {
            return false;
        }
        self.steps -= 1;
        let mut chosen: Option<(usize, Vec<(u8, u8)>)> = None;
        for i in 0..self.front.len() {
            let most = chosen.as_ref().map_or(usize::MAX, |(_, list)| list.len());
            let candidates = self.candidates(self.front[i], most);
            if let Some(candidates) = candidates {
                let none = candidates.is_empty();
                if candidates.len() < most {
                    chosen = Some((i, candidates));
                }
                if none {
                    let (place, _) = self.face(self.front[i]);
                    self.blame[place] += 1;
                    return false;
                }
            }
        }
        let Some((i, mut candidates)) = chosen else { return false };
        // What closes most of the front comes first.
        candidates.sort_by_key(|&(apex, closes)| (3 - closes, apex));
        let [x, y, z] = self.front[i];
        for (apex, _) in candidates {
            let tet = [x, y, z, apex];
            let undo = self.place(tet);
            if self.descend() {
                return true;
            }
            self.unplace(undo);
            if self.steps == 0 {
                return false;
            }
        }
        false
    }

    /// The apexes that fit behind a front face, with how many other front faces each closes; `None`
    /// where there are `most` or more.
    fn candidates(&self, face: [u8; 3], most: usize) -> Option<Vec<(u8, u8)>> {
        let mut list = Vec::new();
        for apex in 0..self.m as u8 {
            if let Some(closes) = self.fits(face, apex) {
                list.push((apex, closes));
                if list.len() >= most {
                    return None;
                }
            }
        }
        Some(list)
    }

    fn fits(&self, [x, y, z]: [u8; 3], apex: u8) -> Option<u8> {
        if !self.usable[apex as usize] || self.signs.of(x, y, z, apex) <= 0 {
            return None;
        }
        if self.even && !self.signs.is_even(x, y, z, apex) {
            return None;
        }
        let tet = [x, y, z, apex];
        let mut closes = 0;
        let mut fresh = [[0u8; 3]; 3];
        let mut count = 0;
        for face in &FACE[..3] {
            let side = face.map(|i| tet[i]);
            let (place, sign) = self.face(side);
            match self.state[place] {
                OPEN => {
                    if !self.face_ok[place] {
                        return None;
                    }
                    fresh[count] = side;
                    count += 1;
                }
                state if state == sign => closes += 1,
                _ => return None,
            }
        }
        for w in 0..self.m as u8 {
            if tet.contains(&w) {
                continue;
            }
            if (0..4).all(|f| {
                let [a, b, c] = FACE[f].map(|i| tet[i]);
                self.signs.of(a, b, c, w) >= 0
            }) {
                return None;
            }
        }
        for corner in [x, y, z] {
            let place = self.edge(corner, apex);
            if self.edge_use[place] == 0
                && self.front.iter().any(|&face| self.signs.passes(corner, apex, face))
            {
                return None;
            }
        }
        for &side in &fresh[..count] {
            for &[a, b, c] in &self.front {
                for [p, q] in [[a, b], [b, c], [c, a]] {
                    if self.signs.passes(p, q, side) {
                        return None;
                    }
                }
            }
        }
        Some(closes)
    }

    /// Adds a tetrahedron; what to take back is its own faces.
    fn place(&mut self, tet: [u8; 4]) -> ([u8; 4], [i8; 4]) {
        let mut before = [OPEN; 4];
        for f in 0..4 {
            let side = FACE[f].map(|i| tet[i]);
            let (place, sign) = self.face(side);
            before[f] = self.state[place];
            if before[f] == sign {
                self.state[place] = CLOSED;
                self.front.retain(|&other| other != side && !is_turned(other, side));
            } else {
                self.state[place] = -sign;
                let [a, b, c] = side;
                self.front.push([a, c, b]);
            }
            self.use_edges(side, 1);
        }
        self.made.push(tet);
        (tet, before)
    }

    fn unplace(&mut self, (tet, before): ([u8; 4], [i8; 4])) {
        self.made.pop();
        for f in (0..4).rev() {
            let side = FACE[f].map(|i| tet[i]);
            let (place, _) = self.face(side);
            self.state[place] = before[f];
            if before[f] == OPEN {
                let [a, b, c] = side;
                self.front.retain(|&other| !is_turned(other, [a, c, b]));
            } else {
                self.front.push(side);
            }
            self.use_edges(side, -1);
        }
    }
}

/// Whether two triangles have the same corners in the same cyclic order.
#[inline]
fn is_turned(a: [u8; 3], [x, y, z]: [u8; 3]) -> bool {
    a == [x, y, z] || a == [y, z, x] || a == [z, x, y]
}
