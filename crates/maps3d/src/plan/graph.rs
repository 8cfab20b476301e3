//! Steps 2 and 3: the dual graph.

use std::sync::atomic::{AtomicU8, Ordering};

use probe::Id;
use solid::Point3;
use solid::predicates::{SegmentContact, segment_meets_triangle};

use super::bottleneck::{Passage, passage};
use super::frontier::{self, FrontierNode};
use super::space::{Exit, Space, middle_of};
use crate::{Maps3dError, PlanOptions};

/// Costs are whole multiples of this, metres: sums of them are exact up to 32 km.
const UNIT_M: f64 = 1.0 / (1_u64 << 38) as f64;

/// Legs are made dearer by less than this many units, each by its own: see [`tie_break`].
const TIES: u32 = 1 << 12;

/// A node of the dual graph: a tetrahedron, a point of a frontier face, the start or the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

impl Id for NodeId {
    fn from_index(index: usize) -> Self {
        Self(index as u32)
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

/// What two nodes share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    /// The way from one tetrahedron to the other; `None` inside of one.
    pub exit: Option<Exit>,
    /// Where the leg between the nodes bends; `None` where it is straight.
    pub via: Option<Point3>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub to: u32,
    pub gate: u32,
    pub cost: f64,
}

const UNKNOWN: u8 = 0;
const OPEN: u8 = 1;
const SHUT: u8 = 2;

/// Tetrahedra and frontier points, joined (\[Mos15\] 4.3, 4.4).
///
/// What holds: each leg, straight or with its bend, lies in the two closed tetrahedra, exactly; its
/// cost is its length, made dearer by up to 1.5e-8 m so that no two ways cost the same, and rounded up to a
/// multiple of 2^-38 m, so that costs add up without rounding.
#[derive(Debug)]
pub struct DualGraph {
    points: Vec<Point3>,
    tetrahedra: usize,
    frontier: Vec<FrontierNode>,
    gates: Vec<Gate>,
    starts: Vec<u32>,
    edges: Vec<Edge>,
    radius_m: f64,
    /// Per node whether an obstacle is nearer than the radius; found out when asked, and empty unless legs
    /// have to be clear.
    crowded: Vec<AtomicU8>,
    /// Per gate whether the ball passes, found out when asked for the first time.
    passages: Vec<AtomicU8>,
    /// Frontier points that were left out because no ball reaches their part of the face.
    narrow: usize,
}

impl DualGraph {
    /// Joins what can be joined. O(n) for n tetrahedra.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn new(space: &Space, options: &PlanOptions) -> Result<Self, Maps3dError> {
        options.check()?;
        let tetrahedra = space.len();
        let mut points: Vec<Point3> = (0..tetrahedra as u32).map(|t| space.middle(t)).collect();
        let mut gates = Vec::new();
        let mut pairs: Vec<(u32, Edge)> = Vec::new();
        let mut join = |a: u32, b: u32, gate: Gate, length_m: f64| {
            let gate_id = gates.len() as u32;
            let cost = cost_of(length_m) + tie_break(gate_id);
            gates.push(gate);
            pairs.push((a, Edge { to: b, gate: gate_id, cost }));
            pairs.push((b, Edge { to: a, gate: gate_id, cost }));
        };
        for t in 0..tetrahedra as u32 {
            for &(u, exit) in space.exits(t).iter().filter(|exit| exit.0 > t) {
                let ends = [points[t as usize], points[u as usize]];
                let (via, length_m) = leg(space, ends, [t, u], exit);
                join(t, u, Gate { exit: Some(exit), via }, length_m);
            }
        }
        let (frontier, narrow) = frontier::nodes(space, options);
        let first = tetrahedra as u32;
        for (i, node) in frontier.iter().enumerate() {
            let length_m = (node.at - points[node.tetrahedron as usize]).norm();
            join(first + i as u32, node.tetrahedron, Gate { exit: None, via: None }, length_m);
        }
        for (i, j) in frontier::neighbours(space, &frontier) {
            let (a, b) = (&frontier[i as usize], &frontier[j as usize]);
            let (t, u) = (a.tetrahedron, b.tetrahedron);
            let (gate, length_m) = if t == u {
                (Gate { exit: None, via: None }, (a.at - b.at).norm())
            } else if let Some(exit) = space.exit(t, u) {
                let (via, length_m) = leg(space, [a.at, b.at], [t, u], exit);
                (Gate { exit: Some(exit), via }, length_m)
            } else {
                continue;
            };
            join(first + i, first + j, gate, length_m);
        }
        points.extend(frontier.iter().map(|node| node.at));
        let mut starts = vec![0_u32; points.len() + 1];
        for (from, _) in &pairs {
            starts[*from as usize + 1] += 1;
        }
        for node in 0..points.len() {
            starts[node + 1] += starts[node];
        }
        pairs.sort_by_key(|(from, edge)| (*from, edge.to, edge.gate));
        let edges = pairs.into_iter().map(|(_, edge)| edge).collect();
        let passages = gates.iter().map(|_| AtomicU8::new(UNKNOWN)).collect();
        let PlanOptions { radius_m, clear_legs, .. } = *options;
        let asked = if clear_legs { points.len() } else { 0 };
        let crowded = (0..asked).map(|_| AtomicU8::new(UNKNOWN)).collect();
        Ok(Self {
            points,
            tetrahedra,
            frontier,
            gates,
            starts,
            edges,
            radius_m,
            crowded,
            passages,
            narrow,
        })
    }

    /// The places of all nodes: of the tetrahedra, then of the frontier points.
    pub fn points(&self) -> &[Point3] {
        &self.points
    }

    /// How many of the nodes are tetrahedra.
    pub fn tetrahedra(&self) -> usize {
        self.tetrahedra
    }

    /// The frontier points; the first is the node after the last tetrahedron.
    pub fn frontier(&self) -> &[FrontierNode] {
        &self.frontier
    }

    /// How many frontier points a ball of the radius cannot reach, and were left out.
    pub fn narrow(&self) -> usize {
        self.narrow
    }

    /// Number of edges, each counted once.
    pub fn edge_count(&self) -> usize {
        self.edges.len() / 2
    }

    /// The ends of all edges, each once.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        (0..self.points.len() as u32).flat_map(move |from| {
            self.edges_of(from).iter().map(move |edge| [from, edge.to]).filter(|[a, b]| a < b)
        })
    }

    pub(super) fn edges_of(&self, node: u32) -> &[Edge] {
        let node = node as usize;
        &self.edges[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// The cheapest edge between two nodes.
    pub(super) fn edge(&self, from: u32, to: u32) -> Option<&Edge> {
        let between = self.edges_of(from).iter().filter(|edge| edge.to == to);
        between.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    pub(super) fn gate(&self, gate: u32) -> &Gate {
        &self.gates[gate as usize]
    }

    /// The tetrahedron that a node stands for or lies in.
    pub(super) fn tetrahedron_of(&self, node: u32) -> u32 {
        match (node as usize).checked_sub(self.tetrahedra) {
            Some(i) => self.frontier[i].tetrahedron,
            None => node,
        }
    }

    /// Whether a leg keeps the radius from obstacles.
    fn is_clear_leg(&self, space: &Space, ends: [u32; 2], via: Option<Point3>) -> bool {
        let points = ends.map(|node| self.points[node as usize]);
        let is_crowded = |node: u32, at: &Point3| {
            let known = &self.crowded[node as usize];
            if known.load(Ordering::Relaxed) == UNKNOWN {
                let is_near = space.obstacles().within(at, self.radius_m).is_some();
                known.store(if is_near { SHUT } else { OPEN }, Ordering::Relaxed);
            }
            known.load(Ordering::Relaxed) == SHUT
        };
        if ends.iter().zip(&points).any(|(&node, at)| is_crowded(node, at)) {
            return false;
        }
        let is_clear = |p: &Point3, q: &Point3| {
            p == q || space.obstacles().near_segment(p, q, self.radius_m).is_none()
        };
        match via {
            Some(via) => is_clear(&points[0], &via) && is_clear(&via, &points[1]),
            None => is_clear(&points[0], &points[1]),
        }
    }

    /// Whether the ball may pass a gate; asked once for each gate, then known.
    pub(super) fn is_passable(&self, space: &Space, from: u32, edge: &Edge) -> bool {
        if self.radius_m == 0.0 {
            return true;
        }
        let gate = edge.gate;
        let known = &self.passages[gate as usize];
        match known.load(Ordering::Relaxed) {
            UNKNOWN => {
                let Gate { exit, via } = self.gates[gate as usize];
                let open = match exit {
                    _ if !self.crowded.is_empty() => self.is_clear_leg(space, [from, edge.to], via),
                    Some(Exit::Face(corners)) => {
                        let face = space.points(corners);
                        passage(&face, self.radius_m, space.obstacles()) != Passage::Shut
                    }
                    // There is one point to change volumes at: where the ball does not fit, nothing else is tried.
                    Some(Exit::Overlap(at)) => {
                        space.obstacles().within(&at, self.radius_m).is_none()
                    }
                    None => true,
                };
                known.store(if open { OPEN } else { SHUT }, Ordering::Relaxed);
                open
            }
            known => known == OPEN,
        }
    }
}

/// What a leg costs besides its length.
///
/// Points of one frontier face lie in a row: the way from the first to the third costs the same by the second
/// as past it. Which of the two a search finds would be its own affair, and with it which corridor is tried
/// next: A* and Dijkstra's search would not end at the same. Multiplication by an odd number near the golden
/// ratio of 2^32 scatters neighbouring gates.
fn tie_break(gate: u32) -> f64 {
    f64::from(gate.wrapping_mul(0x9e37_79b1) >> 16 & (TIES - 1)) * UNIT_M
}

/// A length as a cost: rounded up.
pub(super) fn cost_of(length_m: f64) -> f64 {
    (length_m / UNIT_M).ceil() * UNIT_M
}

/// A distance as an estimate: rounded down, and by one more, because the distance itself is rounded.
pub(super) fn estimate_of(distance_m: f64) -> f64 {
    ((distance_m / UNIT_M).floor() - 1.0).max(0.0) * UNIT_M
}

/// The leg between points of two tetrahedra: where it bends, if it must, and its length, metres.
///
/// Two tetrahedra that share a face need not be convex together. Where the straight leg misses the
/// face, it bends at the point of the face, drawn in by a twentieth, next to where it misses.
fn leg(space: &Space, [a, b]: [Point3; 2], [t, u]: [u32; 2], exit: Exit) -> (Option<Point3>, f64) {
    let bent = |via: Point3| (Some(via), (via - a).norm() + (b - via).norm());
    let corners = match exit {
        Exit::Overlap(at) => return bent(at),
        Exit::Face(corners) => space.points(corners),
    };
    let [p, q, r] = &corners;
    let meets =
        |a: &Point3, b: &Point3| segment_meets_triangle(a, b, [p, q, r]) != SegmentContact::Apart;
    if meets(&a, &b) {
        return (None, (b - a).norm());
    }
    let middle = middle_of([p, q, r]);
    let normal = (q - p).cross(&(r - p));
    let (before, after) = (normal.dot(&(a - p)), normal.dot(&(b - p)));
    let share = if before == after { 0.5 } else { (before / (before - after)).clamp(0.0, 1.0) };
    let drawn = corners.map(|c| c + (middle - c) * 0.05);
    let near = solid::query::closest_on_triangle(
        &(a + (b - a) * share),
        [&drawn[0], &drawn[1], &drawn[2]],
    );
    let through = |via: &Point3| {
        (space.holds(t, via) && meets(via, &b)) || (space.holds(u, via) && meets(&a, via))
    };
    let between = |share: f64| near + (middle - near) * share;
    let floats = [0.0, 0.25, 0.5, 1.0].map(between);
    // A corner lies in both, exactly.
    let via = floats.iter().find(|via| through(via)).unwrap_or(p);
    bent(*via)
}
