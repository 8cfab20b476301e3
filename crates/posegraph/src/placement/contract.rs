//! Contraction: vertices leave the skeleton, and come back, without changing the ways of others.
//!
//! A vertex keeps the links that it had when it left. They lead to vertices that leave later or
//! never, so following them leads out of what has left.

use std::collections::{BTreeMap, BTreeSet};

use probe::VertexId;

use super::RelativePose;
use crate::{Link, ScopeScratch, Skeleton};

/// Ways longer than the horizon are dropped where another way is at most this many times as long.
const DETOUR: f64 = 1.5;

/// Over a retired vertex a new edge is led on to this many vertices.
const WAYS_OUT: usize = 4;

impl<P: RelativePose> Skeleton<P> {
    /// Contracts a vertex: afterwards it has no links, and its nearest neighbour stands for it.
    ///
    /// Every pair of its neighbours whose shortest way led through it, and is no longer than the
    /// horizon, gets that way as a link. Returns whether it was done: a vertex without neighbours
    /// and a vertex that is retired already are left alone.
    ///
    /// Cost: a bounded search per pair of neighbours.
    pub fn retire(&mut self, vertex: VertexId, scratch: &mut ScopeScratch) -> bool {
        if self.is_retired(vertex) {
            return false;
        }
        let mut links = std::mem::take(&mut self.nodes[vertex].links);
        if links.is_empty() {
            return false;
        }
        // The shortest of parallel links is the only one that a shortest way can use.
        links.sort_by(Link::by_length);
        let mut seen: Vec<VertexId> = Vec::with_capacity(links.len());
        links.retain(|link| {
            let first = !seen.contains(&link.to);
            seen.push(link.to);
            first
        });
        for link in &links {
            self.nodes[link.to].links.retain(|back| back.to != vertex);
        }
        // Shorter composed ways first, so that they can witness against longer ones.
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for i in 0..links.len() {
            for j in i + 1..links.len() {
                pairs.push((links[i].length_m + links[j].length_m, i, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (length_m, i, j) in pairs {
            let (x, y) = (&links[i], &links[j]);
            if !self.is_witnessed(x.to, y.to, length_m, scratch) {
                self.replace(x.to, x.back_to(vertex).then(y));
            }
        }
        self.nodes[vertex].spare = links;
        self.retired += 1;
        self.whole = false;
        true
    }

    /// Takes a retired vertex in again, with links to the nearest vertices around it.
    ///
    /// Ways between other vertices stay what they are; its own may be longer than they were.
    /// Returns whether the vertex was retired.
    ///
    /// Cost: a search through retired vertices for the nearest that are not.
    pub fn restore(&mut self, vertex: VertexId, scratch: &mut ScopeScratch) -> bool {
        if !self.is_retired(vertex) {
            return false;
        }
        let ways = self.ways_out(vertex);
        self.nodes[vertex].spare = Vec::new();
        self.retired -= 1;
        self.join(vertex, ways, scratch);
        true
    }

    /// Joins a vertex that is not retired with the nearest around one that is and stays so.
    pub(crate) fn join_retired(
        &mut self,
        from: VertexId,
        link: &Link<P>,
        scratch: &mut ScopeScratch,
    ) {
        let ways = self.ways_out(link.to).iter().map(|way| link.then(way)).collect();
        self.join(from, ways, scratch);
    }

    /// Links a vertex with the ends of these ways where there is no other way, shortest first.
    fn join(&mut self, from: VertexId, ways: Vec<Link<P>>, scratch: &mut ScopeScratch) {
        for way in ways.into_iter().filter(|way| way.to != from) {
            if !self.is_witnessed(from, way.to, way.length_m, scratch) {
                self.replace(from, way);
            }
        }
    }

    /// Whether there is another way that makes one of this length superfluous.
    fn is_witnessed(
        &self,
        a: VertexId,
        b: VertexId,
        length_m: f64,
        scratch: &mut ScopeScratch,
    ) -> bool {
        let near = length_m <= self.horizon_m;
        let bound_m = length_m * if near { self.stretch } else { DETOUR.max(self.stretch) };
        self.is_near_by_one_stop(a, b, bound_m)
            || scratch.distance_within(self, a, b, bound_m).is_some()
    }

    /// Whether one link, or two over a common neighbour, lead from `a` to `b` within a bound: what
    /// nearly every search for a witness finds, at a fraction of its cost.
    fn is_near_by_one_stop(&self, a: VertexId, b: VertexId, bound_m: f64) -> bool {
        self.links(a).iter().any(|first| {
            first.length_m <= bound_m
                && (first.to == b
                    || self.links(first.to).iter().any(|second| {
                        second.to == b && first.length_m + second.length_m <= bound_m
                    }))
        })
    }

    /// The shortest ways from a retired vertex through retired vertices to those that are not,
    /// shortest first: a few, no longer than the horizon, and the shortest at least.
    fn ways_out(&self, vertex: VertexId) -> Vec<Link<P>> {
        // For each vertex met: how far, and by which link of which retired vertex.
        let mut best: BTreeMap<VertexId, (f64, Option<(VertexId, usize)>)> = BTreeMap::new();
        // Bits of lengths that are not negative are ordered as the lengths are.
        let mut open: BTreeSet<(u64, VertexId)> = BTreeSet::new();
        best.insert(vertex, (0.0, None));
        open.insert((0, vertex));
        let mut out: Vec<VertexId> = Vec::new();
        while let Some((_, at)) = open.pop_first() {
            let far_m = best[&at].0;
            if out.len() == WAYS_OUT || (far_m > self.horizon_m && !out.is_empty()) {
                break;
            }
            if !self.is_retired(at) {
                out.push(at);
                continue;
            }
            for (i, link) in self.nodes[at].spare.iter().enumerate() {
                let length_m = far_m + link.length_m;
                match best.get(&link.to) {
                    Some(known) if known.0 <= length_m => continue,
                    Some(known) => open.remove(&(known.0.to_bits(), link.to)),
                    None => false,
                };
                open.insert((length_m.to_bits(), link.to));
                best.insert(link.to, (length_m, Some((at, i))));
            }
        }
        let way_to = |end: VertexId| {
            let mut steps: Vec<&Link<P>> = Vec::new();
            let mut at = end;
            while let Some((before, i)) = best[&at].1 {
                steps.push(&self.nodes[before].spare[i]);
                at = before;
            }
            steps.into_iter().rev().fold(Link::nowhere(vertex), |way, step| way.then(step))
        };
        out.into_iter().map(way_to).collect()
    }

    /// Adds a link and drops longer ones between the same two vertices.
    fn replace(&mut self, from: VertexId, link: Link<P>) {
        let to = link.to;
        self.nodes[from].links.retain(|known| known.to != to);
        self.nodes[to].links.retain(|known| known.to != from);
        self.connect(from, link);
    }
}
