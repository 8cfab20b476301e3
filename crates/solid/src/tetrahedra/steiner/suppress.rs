//! Taking a point off the boundary again: one free point in each space round it instead.

use super::room::Hole;
use super::split::Split;
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::NONE;
use crate::tetrahedra::reconnect::Region;

/// How many steps the search takes that does without new points.
pub(super) const STEPS: u32 = 200;
/// The largest star that is searched.
pub(super) const MOST_SEARCHED: usize = 20;

impl Work {
    /// Undoes a split whose parts are not divided further: its facets become whole again, and the point
    /// gives way to one free point in each space between them (\[GBS03\], \[Si15\] sec. 4). False, with
    /// the point where it was, where doubles leave no room for such points.
    pub(crate) fn suppress(&mut self, split: &Split) -> bool {
        let parts = self.parts(split);
        if parts.len() != split.parts {
            return false;
        }
        let s = split.vertex;
        self.shed_edges(s, false);
        let star = self.mesh.star(s);
        let sectors = self.sectors(s, &star, split);
        self.make_whole(split, &parts);
        let mut wholes = Vec::new();
        let mut edges = Vec::new();
        for &([a, b, c], ..) in &split.facets {
            wholes.push([a, b, c]);
            edges.extend([[a, b], [b, c], [c, a]]);
        }
        let region = Region::of(&self.mesh, &star);
        let done = (region.vertices.len() <= MOST_SEARCHED
            && self.reconnect(&region, &edges, &wholes, Some(s), STEPS))
            || self.put_points_beside(s, &star, &sectors);
        if !done {
            self.part_again(split, &parts);
            return false;
        }
        self.mesh.at[s as usize] = NONE;
        for corners in wholes {
            self.hold_whole(corners);
        }
        true
    }

    /// The facets that the split made, as far as they are whole.
    fn parts(&self, split: &Split) -> Vec<u32> {
        let mut parts = Vec::new();
        for &(corners, input, _) in &split.facets {
            for corner in corners {
                let [a, b, c] = corners.map(|v| if v == corner { split.vertex } else { v });
                let part = self.must.facet(a, b, c);
                parts.extend(part.filter(|&f| self.must.facets[f as usize].input == input));
            }
        }
        parts
    }

    /// Puts the undivided facets back in the place of their parts.
    fn make_whole(&mut self, split: &Split, parts: &[u32]) {
        for &facet in parts {
            self.must.remove(facet);
        }
        for &(corners, input, copies) in &split.facets {
            let id = self.must.add(corners, input);
            self.must.facets[id as usize].copies = copies;
        }
    }

    /// Takes [`make_whole`](Self::make_whole) back.
    fn part_again(&mut self, split: &Split, parts: &[u32]) {
        for &([a, b, c], ..) in &split.facets {
            if let Some(whole) = self.must.facet(a, b, c) {
                self.must.remove(whole);
            }
        }
        for &part in parts {
            let old = self.must.facets[part as usize].clone();
            let id = self.must.add(old.corners, old.input);
            self.must.facets[id as usize].copies = old.copies;
            self.hold_whole(old.corners);
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
    pub(super) fn put_points_beside(&mut self, s: u32, star: &[u32], sectors: &[Hole]) -> bool {
        let points = self.mesh.points.len();
        let mut old = star.to_vec();
        let mut new = Vec::new();
        for sector in sectors {
            let mut hole = sector.clone();
            let Some(place) = self.make_room(s, &mut hole, &old) else {
                self.drop_points(points);
                return false;
            };
            old.extend(hole.own.iter().filter(|t| !sector.own.contains(t)));
            let vertex = self.mesh.add_point(place);
            new.extend(hole.filled(vertex));
        }
        if self.tears(&old, &new, Some(s)) || !self.exchange(&old, &new) {
            self.drop_points(points);
            return false;
        }
        true
    }

    /// The spaces round `s` between its facets.
    fn sectors(&self, s: u32, star: &[u32], split: &Split) -> Vec<Hole> {
        self.spaces(s, star, |corners, sector| {
            let [a, b, c] = corners;
            let facet = self.must.facet(a, b, c);
            if let Some(facet) = facet {
                self.note_whole(facet, corners, split, sector);
            }
            facet.is_some()
        })
    }

    /// The spaces round `s` between walls: `is_wall` says of a face at `s` whether it is of one, and notes
    /// what stands in its place.
    pub(super) fn spaces(
        &self,
        s: u32,
        star: &[u32],
        mut is_wall: impl FnMut([u32; 3], &mut Hole) -> bool,
    ) -> Vec<Hole> {
        let mut of = vec![usize::MAX; star.len()];
        let mut sectors = Vec::new();
        for first in 0..star.len() {
            if of[first] != usize::MAX {
                continue;
            }
            let id = sectors.len();
            let mut sector = Hole::default();
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
                    if is_wall(corners, &mut sector) {
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
    fn note_whole(&self, facet: u32, seen: [u32; 3], split: &Split, sector: &mut Hole) {
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
}

/// Whether two triangles have the same corners in the same cyclic order.
pub(super) fn same_turn(a: [u32; 3], [x, y, z]: [u32; 3]) -> bool {
    a == [x, y, z] || a == [y, z, x] || a == [z, x, y]
}
