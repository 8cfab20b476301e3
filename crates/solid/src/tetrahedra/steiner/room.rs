//! Room for a point: a hole all of whose walls it sees, made larger where it is too tight.

use super::kernel::{HalfSpace, deepest};
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::sorted3;
use crate::tetrahedra::predicates::{P3, orient};

/// How many tetrahedra a hole may take in beyond those it starts from.
const MOST_BEYOND: usize = 120;
/// Of the depth that is there, how many tries are made nearer to the origin.
const HALVINGS: usize = 12;

/// A hole in the mesh that shall be filled from one point.
#[derive(Clone, Debug, Default)]
pub(super) struct Hole {
    /// Its tetrahedra.
    pub(super) own: Vec<u32>,
    /// Walls with tetrahedra beyond, seen from inside, with the neighbour's slot times four plus its
    /// face.
    pub(super) far: Vec<([u32; 3], u32)>,
    /// Walls that stay whatever comes, seen from inside.
    pub(super) near: Vec<[u32; 3]>,
}

impl Hole {
    /// All walls.
    pub(super) fn walls(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.near.iter().copied().chain(self.far.iter().map(|far| far.0))
    }

    /// The tetrahedra that fill it from `vertex`.
    pub(super) fn filled(&self, vertex: u32) -> Vec<[u32; 4]> {
        self.walls().map(|[x, y, z]| [x, y, z, vertex]).collect()
    }
}

impl Work {
    /// A place near vertex `s` that sees all walls of the hole strictly from inside. Where there is
    /// none, the hole takes in what is behind the walls that are to blame, but nothing of `taken`, and
    /// nothing by which an edge that must stay would be lost. `None` where that does not help.
    pub(super) fn make_room(&self, s: u32, hole: &mut Hole, taken: &[u32]) -> Option<P3> {
        let origin = *self.mesh.point(s);
        let reach = self.reach(&origin, hole);
        let mut barred: Vec<u32> = Vec::new();
        for _ in 0..MOST_BEYOND {
            let mut spaces = Vec::new();
            let mut source = Vec::new();
            for (i, wall) in hole.walls().enumerate() {
                let [a, b, c] = wall.map(|v| self.mesh.point(v));
                if let Some(space) = HalfSpace::of(a, b, c, &origin) {
                    spaces.push(space);
                    source.push(i);
                }
            }
            let (x, depth, active) = deepest(&spaces, reach);
            if depth > 0.0
                && let Some(place) = self.seeing_all(&origin, x, hole)
                && !self.tears(&hole.own, &hole.filled(s), None)
            {
                return Some(place);
            }
            let near = hole.near.len();
            let mut blamed: Vec<usize> = active
                .into_iter()
                .filter(|&i| i < spaces.len() && source[i] >= near)
                .map(|i| source[i] - near)
                .collect();
            if blamed.is_empty() {
                // Not these, then: any wall that the place does not see.
                let place = [0, 1, 2].map(|k| origin[k] + x[k]);
                blamed =
                    (0..hole.far.len()).filter(|&i| !self.sees(&place, hole.far[i].0)).collect();
            }
            let grown = blamed.into_iter().any(|i| self.take_in(s, hole, i, taken, &mut barred));
            if !grown {
                return None;
            }
        }
        None
    }

    /// The distance to the farthest corner of a wall.
    fn reach(&self, origin: &P3, hole: &Hole) -> f64 {
        let distance = |v: u32| {
            let p = self.mesh.point(v);
            (0..3).map(|k| (p[k] - origin[k]).powi(2)).sum::<f64>().sqrt()
        };
        hole.walls().flatten().map(distance).fold(0.0, f64::max)
    }

    fn sees(&self, place: &P3, wall: [u32; 3]) -> bool {
        let [a, b, c] = wall.map(|v| self.mesh.point(v));
        orient(a, b, c, place) > 0.0
    }

    /// The place at `x` from the origin, or one nearer to it, from where all walls are seen, exactly.
    fn seeing_all(&self, origin: &P3, x: P3, hole: &Hole) -> Option<P3> {
        let mut step = 1.0;
        for _ in 0..HALVINGS {
            let place = [0, 1, 2].map(|k| origin[k] + x[k] * step);
            if hole.walls().all(|wall| self.sees(&place, wall)) {
                return Some(place);
            }
            step *= 0.5;
        }
        None
    }

    /// Takes in the tetrahedron behind far wall `i`; false, with nothing changed, where it must not.
    fn take_in(
        &self,
        s: u32,
        hole: &mut Hole,
        i: usize,
        taken: &[u32],
        barred: &mut Vec<u32>,
    ) -> bool {
        let (face, code) = hole.far[i];
        let other = code >> 2;
        let [a, b, c] = face;
        if barred.contains(&other)
            || taken.contains(&other)
            || hole.own.contains(&other)
            || self.mesh.tet(other).is_ghost()
            || self.must.holds_face(a, b, c)
        {
            return false;
        }
        let mut grown = hole.clone();
        grown.own.push(other);
        grown.far.swap_remove(i);
        let tet = self.mesh.tet(other);
        for f in (0..4).filter(|&f| f != (code & 3) as usize) {
            let side = tet.face(f);
            let turned = |wall: &[u32; 3]| sorted3(*wall) == sorted3(side);
            if let Some(j) = grown.far.iter().position(|(wall, _)| turned(wall)) {
                grown.far.swap_remove(j);
            } else if grown.near.iter().any(turned) || grown.own.contains(&(tet.n[f] >> 2)) {
                barred.push(other);
                return false;
            } else {
                grown.far.push((side, tet.n[f]));
            }
        }
        // Only what it has itself can be lost by taking it in.
        if self.tears(&[other], &grown.filled(s), None) {
            barred.push(other);
            return false;
        }
        *hole = grown;
        true
    }
}
