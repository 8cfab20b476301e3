//! Open frontier of a region: what counts, in chains.

use std::collections::BTreeMap;

use geometry::planar::overlay::{EdgeLabel, Region, RegionEdge};
use geometry::planar::{EdgeLedger, Interval, box_gap, near_segment};
use geometry::{Point2, Vector2};

use super::Tag;

/// What counts as open frontier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenParams {
    /// Frontier nearer than this to an obstacle edge that another view saw does not count, metres.
    pub wall_closing_m: f64,
    /// Frontier that hangs together over less than this does not count, metres.
    pub sliver_m: f64,
}

impl Default for OpenParams {
    fn default() -> Self {
        Self { wall_closing_m: 0.3, sliver_m: 0.4 }
    }
}

/// An open part of one edge, in the frame of the region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPart {
    /// Where it starts.
    pub from: Point2,
    /// Where it ends; what is known lies to the left.
    pub to: Point2,
    /// The edge that it is a piece of.
    pub tag: Tag,
}

impl OpenPart {
    /// Its length, metres.
    pub fn length_m(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

/// Open parts that hang together.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenChain {
    /// The parts in boundary order.
    pub parts: Vec<OpenPart>,
    /// Their length together, metres.
    pub length_m: f64,
    /// Whether it is long enough to count.
    pub counts: bool,
}

impl OpenChain {
    /// The point at a share of the length, with the unit vector into the unknown there.
    pub fn at(&self, share: f64) -> (Point2, Vector2) {
        point_along(&self.parts, share * self.length_m)
    }
}

/// The point so far along some parts, with the unit vector into the unknown there.
pub(super) fn point_along(parts: &[OpenPart], along_m: f64) -> (Point2, Vector2) {
    let mut left_m = along_m;
    for (i, part) in parts.iter().enumerate() {
        let length_m = part.length_m();
        if left_m <= length_m || i + 1 == parts.len() {
            let share = if length_m > 0.0 { (left_m / length_m).clamp(0.0, 1.0) } else { 0.0 };
            let along = part.to - part.from;
            let normal = Vector2::new(along.y, -along.x);
            let normal = normal.try_normalize(0.0).unwrap_or_else(Vector2::zeros);
            return (part.from + along * share, normal);
        }
        left_m -= length_m;
    }
    (Point2::origin(), Vector2::zeros())
}

/// The open frontier of a region, and what does not count of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenFrontier {
    /// The chains, slivers among them.
    pub chains: Vec<OpenChain>,
    /// Frontier along walls of other views, metres.
    pub wall_m: f64,
    /// Frontier that was given up, metres.
    pub given_up_m: f64,
}

/// Why a part does not count.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Gone {
    Wall,
    GivenUp,
}

impl OpenFrontier {
    /// Reads the open frontier off a region. `given_up` are discs, centre and radius, in its frame.
    ///
    /// Cost: frontier edges times obstacle edges in the cells around them.
    pub fn of(region: &Region<Tag>, params: &OpenParams, given_up: &[(Point2, f64)]) -> Self {
        let walls = if params.wall_closing_m > 0.0 { Walls::of(region) } else { Walls::default() };
        let mut found = Self::default();
        let mut ring: Vec<(usize, OpenPart, Interval)> = Vec::new();
        let mut at = 0;
        for (index, outline) in region.rings.iter().enumerate() {
            ring.clear();
            for edge in region.edges_of(index) {
                match edge.label {
                    EdgeLabel::Frontier => {
                        found.edge(&edge, &walls, params, given_up, &mut ring);
                    }
                    // On an outline that is what was settled before.
                    EdgeLabel::Free => found.wall_m += (edge.to - edge.from).norm(),
                    EdgeLabel::Obstacle => {}
                }
            }
            found.join(&ring, outline.points.len());
            at += outline.points.len();
        }
        debug_assert_eq!(at, region.edge_count(), "every ring has as many edges as corners");
        for chain in &mut found.chains {
            chain.counts = chain.length_m >= params.sliver_m;
        }
        found
    }

    /// Adds the open parts of one edge.
    fn edge(
        &mut self,
        edge: &RegionEdge<Tag>,
        walls: &Walls,
        params: &OpenParams,
        given_up: &[(Point2, f64)],
        ring: &mut Vec<(usize, OpenPart, Interval)>,
    ) {
        let mut ledger: EdgeLedger<Gone> = EdgeLedger::new();
        let mut newly = Vec::new();
        let length_m = (edge.to - edge.from).norm();
        for (centre, radius_m) in given_up {
            if box_gap(&edge.from, &edge.to, centre, centre) > *radius_m {
                continue;
            }
            if let Some(span) = near_segment(&edge.from, &edge.to, centre, centre, *radius_m) {
                ledger.close(span, &Gone::GivenUp, &mut newly);
            }
        }
        let radius_m = params.wall_closing_m;
        for wall in walls.near(edge, radius_m) {
            let far = box_gap(&edge.from, &edge.to, &wall.from, &wall.to) >= radius_m;
            if far || wall.data.vertex == edge.data.vertex {
                continue;
            }
            if let Some(span) = near_segment(&edge.from, &edge.to, &wall.from, &wall.to, radius_m) {
                ledger.close(span, &Gone::Wall, &mut newly);
            }
        }
        for closed in ledger.closed() {
            let closed_m = closed.span.share() * length_m;
            match closed.reason {
                Gone::Wall => self.wall_m += closed_m,
                Gone::GivenUp => self.given_up_m += closed_m,
            }
        }
        let along = edge.to - edge.from;
        for span in ledger.open() {
            let (from, to) = (edge.from + along * span.from, edge.from + along * span.to);
            ring.push((edge.edge, OpenPart { from, to, tag: edge.data }, span));
        }
    }

    /// Joins the open parts of one ring of `count` edges into chains.
    fn join(&mut self, parts: &[(usize, OpenPart, Interval)], count: usize) {
        let follows = |a: &(usize, OpenPart, Interval), b: &(usize, OpenPart, Interval)| {
            (a.0 + 1) % count == b.0 && a.2.to >= 1.0 && b.2.from <= 0.0
        };
        let first = self.chains.len();
        for (i, part) in parts.iter().enumerate() {
            let joins = i > 0 && follows(&parts[i - 1], part);
            match self.chains.last_mut() {
                Some(chain) if joins => chain.parts.push(part.1),
                _ => self.chains.push(OpenChain {
                    parts: vec![part.1],
                    length_m: 0.0,
                    counts: false,
                }),
            }
        }
        // The ring closes: the last chain may run on into the first.
        if let (Some(head), Some(tail)) = (parts.first(), parts.last())
            && self.chains.len() > first + 1
            && follows(tail, head)
        {
            let start = self.chains.remove(first);
            if let Some(last) = self.chains.last_mut() {
                last.parts.extend(start.parts);
            }
        }
        for chain in &mut self.chains[first..] {
            chain.length_m = chain.parts.iter().map(OpenPart::length_m).sum();
        }
    }

    /// The chains that count.
    pub fn counting(&self) -> impl Iterator<Item = &OpenChain> {
        self.chains.iter().filter(|chain| chain.counts)
    }

    /// What is left, in the words of the trait.
    pub fn summary(&self) -> crate::Frontier {
        let slivers: f64 =
            self.chains.iter().filter(|chain| !chain.counts).map(|chain| chain.length_m).sum();
        crate::Frontier {
            // The sum of nothing is -0.
            open_m: 0.0 + self.counting().map(|chain| chain.length_m).sum::<f64>(),
            ignored_m: slivers + self.wall_m + self.given_up_m,
            places: self.counting().count(),
        }
    }
}

/// Side of the cells by which walls are found, metres.
const BUCKET_M: f64 = 1.0;

/// Obstacle edges by the cells that they may reach.
#[derive(Default)]
struct Walls {
    edges: Vec<RegionEdge<Tag>>,
    /// The edges whose box touches a cell, ascending.
    buckets: BTreeMap<(i64, i64), Vec<u32>>,
    /// Edges whose box touches too many cells.
    large: Vec<u32>,
}

impl Walls {
    fn of(region: &Region<Tag>) -> Self {
        let edges: Vec<RegionEdge<Tag>> =
            region.edges().filter(|edge| edge.label == EdgeLabel::Obstacle).collect();
        let mut buckets: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
        let mut large = Vec::new();
        for (number, edge) in edges.iter().enumerate() {
            match cells_around(&edge.from, &edge.to, 0.0) {
                Some(cells) => {
                    cells.for_each(|cell| buckets.entry(cell).or_default().push(number as u32))
                }
                None => large.push(number as u32),
            }
        }
        Self { edges, buckets, large }
    }

    /// Those that may come within a radius of an edge, in the order of the region.
    fn near(
        &self,
        edge: &RegionEdge<Tag>,
        radius_m: f64,
    ) -> impl Iterator<Item = &RegionEdge<Tag>> {
        let mut numbers: Vec<u32> = match cells_around(&edge.from, &edge.to, radius_m) {
            Some(cells) => {
                let found = cells.filter_map(|cell| self.buckets.get(&cell)).flatten();
                found.chain(&self.large).copied().collect()
            }
            None => (0..self.edges.len() as u32).collect(),
        };
        numbers.sort_unstable();
        numbers.dedup();
        numbers.into_iter().map(|number| &self.edges[number as usize])
    }
}

/// A box that touches more cells than this along one axis is not looked up by them.
const MOST_CELLS: f64 = 64.0;

/// The cells that the box around a segment touches, widened by a margin; `None` for too many, and for
/// what is too far out to count cells.
fn cells_around(
    from: &Point2,
    to: &Point2,
    margin_m: f64,
) -> Option<impl Iterator<Item = (i64, i64)>> {
    let (low, high) = (from.inf(to), from.sup(to));
    let index = |metres: f64| (metres / BUCKET_M).floor();
    let span = |low: f64, high: f64| {
        let (first, last) = (index(low - margin_m), index(high + margin_m));
        let counts = last - first < MOST_CELLS && first.abs().max(last.abs()) < 1e15;
        counts.then_some(first as i64..=last as i64)
    };
    let (columns, rows) = (span(low.x, high.x)?, span(low.y, high.y)?);
    Some(columns.flat_map(move |column| rows.clone().map(move |row| (column, row))))
}
