//! Taking a point off the boundary again: one free point in each space round it instead.

use super::split::Split;
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::{NONE, sorted3};
use crate::tetrahedra::predicates::{P3, orient};
use crate::tetrahedra::reconnect::Region;

/// How often the way from the point into the open is halved.
const HALVINGS: u32 = 60;
/// How many directions are tried.
const MOST_WAYS: usize = 24;
/// How many steps the search takes that does without new points.
const STEPS: u32 = 200;
/// How many tetrahedra round the star may go too.
const MOST_BEYOND: usize = 60;

/// One space between facets round a point.
#[derive(Clone, Debug, Default)]
struct Sector {
    /// The faces opposite the point, seen from inside.
    /// With the neighbour beyond, as four times its slot plus its face.
    far: Vec<([u32; 3], u32)>,
    /// The undivided facets that bound it, seen from inside.
    near: Vec<[u32; 3]>,
    /// Its tetrahedra.
    own: Vec<u32>,
}

impl Work {
    /// Undoes the newest split: its facets become whole again, and the point gives way to one free
    /// point in each space between them (\[GBS03\], \[Si15\] sec. 4). False, with nothing changed, where
    /// doubles leave no room for such a point.
    pub(crate) fn suppress(&mut self, split: &Split) -> bool {
        let s = split.vertex;
        let star = self.mesh.star(s);
        let sectors = self.sectors(s, &star, split);
        self.make_whole(split);
        let mut wholes = Vec::new();
        let mut edges = Vec::new();
        for &([a, b, c], ..) in &split.facets {
            wholes.push([a, b, c]);
            edges.extend([[a, b], [b, c], [c, a]]);
        }
        let region = Region::of(&self.mesh, &star);
        let done = self.reconnect(&region, &edges, &wholes, Some(s), STEPS)
            || self.put_points_beside(s, &star, &sectors);
        if done {
            self.mesh.at[s as usize] = NONE;
            for [a, b, c] in wholes {
                self.hold_whole([a, b, c]);
            }
        }
        done
    }

    /// Puts the undivided facets back in the place of their parts.
    fn make_whole(&mut self, split: &Split) {
        let s = split.vertex;
        let of_s: Vec<u32> = split
            .facets
            .iter()
            .flat_map(|&(corners, input, _)| {
                let must = &self.must;
                corners.into_iter().filter_map(move |corner| {
                    let mut part = corners;
                    for v in &mut part {
                        if *v == corner {
                            *v = s;
                        }
                    }
                    let [a, b, c] = part;
                    must.facet(a, b, c).filter(|&f| must.facets[f as usize].input == input)
                })
            })
            .collect();
        for facet in of_s {
            self.must.remove(facet);
        }
        for &(corners, input, copies) in &split.facets {
            let id = self.must.add(corners, input);
            self.must.facets[id as usize].copies = copies;
        }
    }

    fn hold_whole(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners;
        if let Some(facet) = self.must.facet(a, b, c) {
            self.must.facets[facet as usize].held = true;
        }
        for (u, v) in [(a, b), (b, c), (c, a)] {
            if let Some(segment) = self.must.segment(u, v) {
                self.must.segments[segment as usize].held = true;
            }
        }
    }

    /// Fills each space round `s` from a point of its own.
    fn put_points_beside(&mut self, s: u32, star: &[u32], sectors: &[Sector]) -> bool {
        let points = self.mesh.points.len();
        let mut old = star.to_vec();
        let mut new = Vec::new();
        for sector in sectors {
            let Some((place, beyond, walls)) = self.place_in(s, sector, &old) else {
                self.undo_with_points(self.log.len(), points);
                return false;
            };
            old.extend(beyond);
            let vertex = self.mesh.add_point(place);
            new.extend(walls.iter().map(|&[x, y, z]| [x, y, z, vertex]));
        }
        if self.tears(&old, &new, Some(s)) || !self.exchange(&old, &new) {
            self.undo_with_points(self.log.len(), points);
            return false;
        }
        true
    }

    /// The spaces round `s` between its facets.
    fn sectors(&self, s: u32, star: &[u32], split: &Split) -> Vec<Sector> {
        let mut of = vec![usize::MAX; star.len()];
        let mut sectors = Vec::new();
        for first in 0..star.len() {
            if of[first] != usize::MAX {
                continue;
            }
            let id = sectors.len();
            let mut sector = Sector::default();
            let mut stack = vec![first];
            of[first] = id;
            while let Some(i) = stack.pop() {
                let tet = self.mesh.tet(star[i]);
                sector.own.push(star[i]);
                for f in 0..4 {
                    let corners = tet.face(f);
                    if tet.v[f] == s {
                        sector.far.push((corners, tet.n[f]));
                        continue;
                    }
                    let [a, b, c] = corners;
                    if let Some(facet) = self.must.facet(a, b, c) {
                        self.note_whole(facet, corners, split, &mut sector);
                        continue;
                    }
                    if let Some(j) = star.iter().position(|&t| t == tet.n[f] >> 2)
                        && of[j] == usize::MAX
                    {
                        of[j] = id;
                        stack.push(j);
                    }
                }
            }
            sectors.push(sector);
        }
        sectors
    }

    /// Notes the undivided facet of which `facet` is a part, turned as the part is seen.
    fn note_whole(&self, facet: u32, seen: [u32; 3], split: &Split, sector: &mut Sector) {
        let part = &self.must.facets[facet as usize];
        let s = split.vertex;
        for &(corners, input, _) in &split.facets {
            let shared = part.corners.iter().filter(|&&v| v != s && corners.contains(&v)).count();
            if input != part.input || shared != 2 {
                continue;
            }
            let [a, b, c] = corners;
            let whole = if same_turn(seen, part.corners) { [a, b, c] } else { [a, c, b] };
            if !sector.near.contains(&whole) {
                sector.near.push(whole);
            }
        }
    }

    /// A place beside `s` that sees all faces of a sector strictly from inside; the tetrahedra beyond
    /// the sector that have to go for that, none of them in `taken`; and the faces seen.
    fn place_in(
        &self,
        s: u32,
        sector: &Sector,
        taken: &[u32],
    ) -> Option<(P3, Vec<u32>, Vec<[u32; 3]>)> {
        let origin = *self.mesh.point(s);
        let mut way = [0.0; 3];
        for &[a, b, c] in &sector.near {
            let [a, b, c] = [a, b, c].map(|v| self.mesh.point(v));
            let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
            let n =
                [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            if length > 0.0 {
                for k in 0..3 {
                    way[k] += n[k] / length;
                }
            }
        }
        let mut ways = vec![way];
        let mut reach = 0.0f64;
        for &(face, _) in &sector.far {
            for v in face {
                let p = self.mesh.point(v);
                let d = (0..3).map(|k| (p[k] - origin[k]).powi(2)).sum::<f64>().sqrt();
                reach = if reach == 0.0 { d } else { reach.min(d) };
                if d > 0.0 && ways.len() < MOST_WAYS {
                    ways.push([0, 1, 2].map(|k| way[k] + (p[k] - origin[k]) / d));
                }
            }
        }
        for (most, way) in [0, 3, MOST_BEYOND]
            .into_iter()
            .flat_map(|most| ways.iter().map(move |&way| (most, way)))
        {
            let mut step = reach;
            for _ in 0..HALVINGS {
                let place = [0, 1, 2].map(|k| origin[k] + way[k] * step);
                if let Some((beyond, walls)) = self.open_to(&place, sector, taken, most) {
                    let mut old = sector.own.clone();
                    old.extend(&beyond);
                    let new: Vec<[u32; 4]> = walls.iter().map(|&[x, y, z]| [x, y, z, s]).collect();
                    if !self.tears(&old, &new, None) {
                        return Some((place, beyond, walls));
                    }
                }
                step *= 0.5;
            }
        }
        None
    }

    /// Grows a sector through faces that `place` does not see until it sees all.
    fn open_to(
        &self,
        place: &P3,
        sector: &Sector,
        taken: &[u32],
        most: usize,
    ) -> Option<(Vec<u32>, Vec<[u32; 3]>)> {
        let sees = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| self.mesh.point(v));
            orient(a, b, c, place) > 0.0
        };
        if !sector.near.iter().all(sees) {
            return None;
        }
        let mut beyond: Vec<u32> = Vec::new();
        let mut walls = sector.near.clone();
        let mut open: Vec<([u32; 3], u32)> = sector.far.clone();
        while let Some((face, code)) = open.pop() {
            let other = code >> 2;
            if beyond.contains(&other) || sector.own.contains(&other) {
                continue;
            }
            if sees(&face) {
                walls.push(face);
                continue;
            }
            let [a, b, c] = face;
            if self.must.holds_face(a, b, c)
                || taken.contains(&other)
                || self.mesh.tet(other).is_ghost()
                || beyond.len() >= most
            {
                return None;
            }
            beyond.push(other);
            let tet = self.mesh.tet(other);
            for f in 0..4 {
                if f != (code & 3) as usize {
                    open.push((tet.face(f), tet.n[f]));
                }
            }
        }
        // A wall was put up before what lay behind it went too.
        let epoch_walls = |face: &[u32; 3]| {
            !beyond.iter().any(|&t| {
                let tet = self.mesh.tet(t);
                let inner = (0..4).find(|&f| sorted3(tet.face(f)) == sorted3(*face));
                inner.is_some_and(|f| !same_turn(tet.face(f), *face))
            })
        };
        walls.retain(epoch_walls);
        Some((beyond, walls))
    }
}

/// Whether two triangles have the same corners in the same cyclic order.
fn same_turn(a: [u32; 3], [x, y, z]: [u32; 3]) -> bool {
    a == [x, y, z] || a == [y, z, x] || a == [z, x, y]
}
