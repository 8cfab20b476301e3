//! Points on segments and in facets, for the time being.

use crate::tetrahedra::constraints::Way;
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::Ring;
use crate::tetrahedra::predicates::{P3, orient};

/// A point that was put on a constraint, and what the constraint was before.
#[derive(Clone, Debug)]
pub(crate) struct Split {
    /// The point.
    pub(crate) vertex: u32,
    /// The facets that it divided: corners and input face, with how many copies.
    pub(crate) facets: Vec<([u32; 3], u32, u32)>,
    /// How many facets it made.
    pub(crate) parts: usize,
}

/// Nearer to an end than this share no point is put where something passes.
const NEAR_END: f64 = 1e-3;
/// Where along a segment to divide it where no place that something passes will do.
const PLACES: [f64; 9] = [0.5, 0.375, 0.625, 0.25, 0.75, 0.125, 0.875, 0.03125, 0.96875];

impl Work {
    /// Divides a missing segment by a point on it, up to rounding, and its facets with it. False, with
    /// nothing changed, where no place is found.
    pub(crate) fn split_segment(&mut self, id: u32) -> bool {
        let [a, b] = self.must.segments[id as usize].ends;
        let facets = self.must.segments[id as usize].faces.clone();
        let (p, q) = (*self.mesh.point(a), *self.mesh.point(b));
        let way = self.mesh.way(a, b);
        if way.tets.is_empty() && way.vertices.is_empty() {
            // It came in with another one.
            return true;
        }
        let start = self.with_neighbours(&way.tets);
        for t in self.passed_at(a, b, &way).into_iter().chain(PLACES) {
            let place = [0, 1, 2].map(|k| p[k] * (1.0 - t) + q[k] * t);
            if let Some(vertex) = self.insert_steiner(place, &start) {
                let mut halves = Vec::new();
                for &facet in &facets {
                    let corners = self.must.facets[facet as usize].corners;
                    let with = |from: u32| corners.map(|v| if v == from { vertex } else { v });
                    halves.push((facet, vec![with(a), with(b)]));
                }
                self.divide(vertex, halves);
                return true;
            }
        }
        false
    }

    /// Puts a point on the missing segment `a`, `b`, up to rounding, in the middle of what passes it, or at
    /// the next best place after `turn` others.
    pub(crate) fn place_on(&mut self, a: u32, b: u32, turn: usize) -> Option<u32> {
        let (p, q) = (*self.mesh.point(a), *self.mesh.point(b));
        let way = self.mesh.way(a, b);
        if way.tets.is_empty() || !way.vertices.is_empty() {
            return None;
        }
        let start = self.with_neighbours(&way.tets);
        let mut places = self.passed_at(a, b, &way);
        places.extend(PLACES);
        places.into_iter().skip(turn).find_map(|t| {
            let place = [0, 1, 2].map(|k| p[k] * (1.0 - t) + q[k] * t);
            self.insert_steiner(place, &start)
        })
    }

    /// Tetrahedra and their neighbours, ascending.
    fn with_neighbours(&self, tets: &[u32]) -> Vec<u32> {
        let mut all = tets.to_vec();
        for &t in tets {
            all.extend(self.mesh.tet(t).n.iter().map(|code| code >> 2));
        }
        all.retain(|&t| !self.mesh.tet(t).is_ghost());
        all.sort_unstable();
        all.dedup();
        all
    }

    /// At what shares of a segment something passes it, the middle one first.
    fn passed_at(&self, a: u32, b: u32, way: &Way) -> Vec<f64> {
        let (p, q) = (self.mesh.point(a), self.mesh.point(b));
        let mut shares = Vec::new();
        for &(t, f) in &way.faces {
            let [x, y, z] = self.mesh.tet(t).face(f);
            let (above, below) = (self.mesh.orient(x, y, z, a), self.mesh.orient(x, y, z, b));
            shares.push(above / (above - below));
        }
        for &(_, u, v) in &way.edges {
            // With a point off the plane of both lines the edge spans a plane that cuts the segment.
            let (u, v) = (self.mesh.point(u), self.mesh.point(v));
            let off = [u[1] - v[1] + p[0], u[2] - v[2] + p[1], u[0] - v[0] + p[2]];
            let (above, below) = (orient(u, v, &off, p), orient(u, v, &off, q));
            shares.push(above / (above - below));
        }
        shares.retain(|&t| t > 0.0 && t < 1.0);
        shares.sort_by(f64::total_cmp);
        let (mut far, mut near): (Vec<f64>, Vec<f64>) =
            shares.into_iter().partition(|&t| t > NEAR_END && t < 1.0 - NEAR_END);
        middle_first(&mut far);
        // In a layer as thin as a jitter all that passes does so next to an end.
        middle_first(&mut near);
        far.extend(near);
        far
    }

    /// Divides a missing facet by a point in it, up to rounding.
    pub(crate) fn split_facet(&mut self, id: u32) -> bool {
        let corners = self.must.facets[id as usize].corners;
        let points = corners.map(|v| *self.mesh.point(v));
        let mut tets = Vec::new();
        let mut ring = Ring::default();
        let passing = self.passing(corners);
        for &(t, u, v) in &passing {
            if self.mesh.ring(t, u, v, usize::MAX, &mut ring) {
                tets.extend_from_slice(&ring.tets);
            }
        }
        let mut places: Vec<P3> =
            passing.iter().filter_map(|&(_, u, v)| self.pierce(corners, u, v)).collect();
        for w in [[1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0]] {
            let sum: f64 = w.iter().sum();
            places.push([0, 1, 2].map(|k| (0..3).map(|i| points[i][k] * (w[i] / sum)).sum()));
        }
        let start = self.with_neighbours(&tets);
        for place in places {
            if let Some(vertex) = self.insert_steiner(place, &start) {
                let parts = corners
                    .map(|from| corners.map(|v| if v == from { vertex } else { v }))
                    .to_vec();
                self.divide(vertex, vec![(id, parts)]);
                return true;
            }
        }
        false
    }

    /// Where the edge `u`, `v` passes the plane of a triangle, about.
    fn pierce(&self, corners: [u32; 3], u: u32, v: u32) -> Option<P3> {
        let [a, b, c] = corners;
        let (above, below) = (self.mesh.orient(a, b, c, u), self.mesh.orient(a, b, c, v));
        let t = above / (above - below);
        let (p, q) = (self.mesh.point(u), self.mesh.point(v));
        (t > 0.0 && t < 1.0).then(|| [0, 1, 2].map(|k| p[k] * (1.0 - t) + q[k] * t))
    }

    fn divide(&mut self, vertex: u32, halves: Vec<(u32, Vec<[u32; 3]>)>) {
        let mut before = Vec::new();
        let parts = halves.iter().map(|half| half.1.len()).sum();
        for (facet, parts) in halves {
            let old = self.must.facets[facet as usize].clone();
            self.must.remove(facet);
            before.push((old.corners, old.input, old.copies));
            for part in parts {
                let id = self.must.add(part, old.input);
                self.must.facets[id as usize].copies = old.copies;
            }
        }
        self.splits.push(Split { vertex, facets: before, parts });
    }
}

/// Puts ascending numbers into the order of how far they are from the middle one of them.
fn middle_first(shares: &mut [f64]) {
    let middle = shares.len() / 2;
    let mut ranked: Vec<(usize, f64)> =
        shares.iter().enumerate().map(|(i, &t)| (i.abs_diff(middle), t)).collect();
    ranked.sort_by_key(|&(rank, _)| rank);
    for (share, (_, ranked)) in shares.iter_mut().zip(ranked) {
        *share = ranked;
    }
}
