//! The dual graph of a triangulated region, and ways on it (\[Mos15\] 4.3.1, 4.4.1).

use geometry::Point2;
use geometry::planar::Triangulation;
use probe::VertexId;
use search::{Graph, Scratch, astar_nearest};

/// A point so near to a triangle counts as in it, metres: frontier and robot lie on the boundary.
const AT_M: f64 = 0.05;

/// The robot may stand farther out of its own map than that: poses of its views are corrected.
const START_M: f64 = 0.5;

/// A way through a side shorter than this costs as if it were as many times longer, metres.
const NARROW_M: f64 = 0.3;

/// Centres of gravity of triangles, joined over shared sides, with the goals and the start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DualGraph {
    /// The nodes: centres of triangles, then goals, then the start; in the region's frame.
    pub nodes: Vec<Point2>,
    /// Number of triangles.
    pub triangles: usize,
    /// For each node the nodes next to it, each with its cost and where the way to it bends.
    links: Vec<Vec<Link>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Link {
    to: u32,
    cost: f64,
    bend: Option<Point2>,
}

impl DualGraph {
    /// The dual graph with goals and a start joined in; what lies nowhere stays alone.
    ///
    /// Cost: triangles times goals.
    pub fn new(mesh: &Triangulation, goals: &[Point2], start: &Point2) -> Self {
        let triangles = mesh.triangles.len();
        let mut nodes: Vec<Point2> =
            (0..triangles as u32).map(|triangle| mesh.centroid(triangle)).collect();
        let mut links: Vec<Vec<Link>> = vec![Vec::new(); triangles + goals.len() + 1];
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let corners = mesh.corners(index as u32);
            for side in 0..3 {
                let Some(to) = triangle.neighbours[side] else { continue };
                let (a, b) = (corners[side], corners[(side + 1) % 3]);
                let middle = Point2::from((a.coords + b.coords) * 0.5);
                let length_m =
                    (nodes[index] - middle).norm() + (middle - nodes[to as usize]).norm();
                let narrow = (NARROW_M / (b - a).norm().max(1e-6)).max(1.0);
                links[index].push(Link { to, cost: length_m * narrow, bend: Some(middle) });
            }
        }
        // Several of them may lie at one triangle: those are joined directly, too.
        let mut at: Vec<(u32, usize)> = Vec::new();
        for (place, point) in goals.iter().chain([start]).enumerate() {
            let node = nodes.len();
            nodes.push(*point);
            let slack_m = if place == goals.len() { START_M } else { AT_M };
            let Some(triangle) = mesh.locate(point, slack_m) else { continue };
            let mut join = |a: usize, b: usize| {
                let cost = (nodes[a] - nodes[b]).norm();
                links[a].push(Link { to: b as u32, cost, bend: None });
                links[b].push(Link { to: a as u32, cost, bend: None });
            };
            join(node, triangle as usize);
            at.iter().filter(|other| other.0 == triangle).for_each(|other| join(node, other.1));
            at.push((triangle, node));
        }
        Self { nodes, triangles, links }
    }

    /// The nodes that stand for goals.
    pub fn goals(&self) -> std::ops::Range<usize> {
        self.triangles..self.nodes.len().saturating_sub(1).max(self.triangles)
    }

    /// Every link once, as straight pieces.
    pub fn pieces(&self) -> impl Iterator<Item = (Point2, Point2)> + '_ {
        self.links.iter().enumerate().flat_map(move |(from, links)| {
            links.iter().filter(move |link| from < link.to as usize).flat_map(move |link| {
                let (a, b) = (self.nodes[from], self.nodes[link.to as usize]);
                let bend = link.bend.unwrap_or(b);
                [Some((a, bend)), link.bend.map(|bend| (bend, b))].into_iter().flatten()
            })
        })
    }

    /// The way from the start to the nearest goal, A\*: points without the start, the goal last.
    pub fn way(&self, scratch: &mut Scratch<VertexId>) -> Option<Vec<Point2>> {
        let start = VertexId(self.nodes.len().checked_sub(1)? as u32);
        let goals: Vec<VertexId> = self.goals().map(|goal| VertexId(goal as u32)).collect();
        if goals.is_empty() {
            return None;
        }
        let straight = |a: VertexId, b: VertexId| {
            // A hair less than the truth, so that rounding cannot make it more.
            (self.nodes[a.0 as usize] - self.nodes[b.0 as usize]).norm() * (1.0 - 1e-12)
        };
        let found = astar_nearest(self, start, &goals, straight, scratch).ok()??;
        let mut way = Vec::new();
        for pair in found.nodes.windows(2) {
            let links = &self.links[pair[0].0 as usize];
            let link = links.iter().find(|link| link.to == pair[1].0);
            way.extend(link.and_then(|link| link.bend));
            way.push(self.nodes[pair[1].0 as usize]);
        }
        Some(way)
    }
}

impl Graph for DualGraph {
    type Node = VertexId;

    fn node_bound(&self) -> usize {
        self.nodes.len()
    }

    fn for_each_edge(&self, from: VertexId, mut visit: impl FnMut(VertexId, f64)) {
        for link in &self.links[from.0 as usize] {
            visit(VertexId(link.to), link.cost);
        }
    }
}
