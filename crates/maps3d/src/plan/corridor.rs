//! Step 6: the tetrahedra of a way, and the exact walk through them.

use solid::Point3;
use solid::predicates::{SegmentContact, segment_meets_triangle};

use super::graph::Gate;
use super::route::{Found, Query};
use super::space::{Exit, Space};

/// A row of tetrahedra, each joined to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Corridor {
    /// The tetrahedra.
    pub tetrahedra: Vec<u32>,
    /// How one gets from each to the next.
    pub exits: Vec<Exit>,
}

/// The corridor of a way; its gates as the graph counts them; and the way through nodes and bends, each
/// with its place.
pub(super) fn of_way(query: &Query<'_>, found: &Found) -> (Corridor, Vec<u32>, Vec<Knot>) {
    let (start, first) = query.from;
    let mut corridor = Corridor { tetrahedra: vec![first], exits: Vec::new() };
    let mut gates = Vec::new();
    let mut knots = vec![Knot { place: 0, at: start }];
    let mut before: Option<u32> = None;
    for &node in &found.nodes {
        let edge = before
            .filter(|_| node != query.goal_node())
            .and_then(|before| query.graph.edge(before, node));
        if let Some(edge) = edge {
            let Gate { exit, via } = *query.graph.gate(edge.gate);
            if let Some(exit) = exit {
                corridor.exits.push(exit);
                corridor.tetrahedra.push(query.graph.tetrahedron_of(node));
                gates.push(edge.gate);
                let place = 2 * corridor.exits.len() as u32 - 1;
                knots.extend(via.map(|at| Knot { place, at }));
            }
        }
        knots.push(Knot { place: 2 * corridor.exits.len() as u32, at: query.at(node) });
        before = Some(node);
    }
    (corridor, gates, knots)
}

/// A point of a polyline through a corridor.
///
/// Place 2 i is inside of the tetrahedron i of the corridor; place 2 i + 1 is on the way from that to
/// the next, in one of them or both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Where in the corridor.
    pub place: u32,
    /// The point.
    pub at: Point3,
}

impl Corridor {
    /// The first gate that a polyline misses, with its knot after which it does; `None` where it stays
    /// inside. Exact.
    ///
    /// A polyline from a tetrahedron to a later one stays inside of the corridor if each of its points
    /// lies in the closed tetrahedron that it is said to be in, and each segment meets all the closed
    /// faces between the tetrahedra of its ends: between two faces it is inside of the tetrahedron
    /// that has both, which is convex. Where volumes overlap, a knot must lie in both tetrahedra.
    pub fn leaves(&self, space: &Space, knots: &[Knot]) -> Option<Miss> {
        let last = 2 * self.exits.len() as u32;
        let mut inside = Vec::with_capacity(knots.len());
        for (i, knot) in knots.iter().enumerate() {
            match self.held(space, knot) {
                Some(range) => inside.push(range),
                None => return Some(Miss { knot: i, gate: knot.place / 2 }),
            }
        }
        let ends = [knots.first(), knots.last()].map(|knot| knot.map(|knot| knot.place));
        if ends != [Some(0), Some(last)] {
            return Some(Miss { knot: 0, gate: 0 });
        }
        for (i, pair) in knots.windows(2).enumerate() {
            if pair[1].place < pair[0].place {
                return Some(Miss { knot: i, gate: pair[1].place / 2 });
            }
            for gate in inside[i].1..inside[i + 1].0 {
                if !self.meets(space, gate, &pair[0].at, &pair[1].at) {
                    return Some(Miss { knot: i, gate });
                }
            }
        }
        None
    }

    /// The first and the last of the tetrahedra next to a knot's place that hold it.
    fn held(&self, space: &Space, knot: &Knot) -> Option<(u32, u32)> {
        let (first, odd) = (knot.place / 2, knot.place % 2 == 1);
        let holds =
            |i: u32| self.tetrahedra.get(i as usize).is_some_and(|&t| space.holds(t, &knot.at));
        if !odd {
            return holds(first).then_some((first, first));
        }
        match (holds(first), holds(first + 1)) {
            (true, true) => Some((first, first + 1)),
            (true, false) => Some((first, first)),
            (false, true) => Some((first + 1, first + 1)),
            (false, false) => None,
        }
    }

    /// Whether a segment meets the face of a gate; an overlap is met by knots only.
    pub(super) fn meets(&self, space: &Space, gate: u32, from: &Point3, to: &Point3) -> bool {
        match self.exits[gate as usize] {
            Exit::Face(corners) => {
                let [a, b, c] = space.points(corners);
                segment_meets_triangle(from, to, [&a, &b, &c]) != SegmentContact::Apart
            }
            Exit::Overlap(_) => false,
        }
    }
}

/// Where a polyline leaves its corridor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Miss {
    /// The knot at the start of the segment, or the one that is outside.
    pub knot: usize,
    /// The gate that is missed.
    pub gate: u32,
}

/// Length of a polyline, metres.
pub(crate) fn polyline_m(points: &[Point3]) -> f64 {
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The same of knots.
pub(super) fn length_m(knots: &[Knot]) -> f64 {
    knots.windows(2).map(|pair| (pair[1].at - pair[0].at).norm()).sum()
}
