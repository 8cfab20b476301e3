//! Step 5: searches over the dual graph.

use std::cell::Cell;

use probe::{Id, Probe};
use search::{
    AstarEvent, BreadthEvent, DepthEvent, DijkstraEvent, Graph, Scratch, astar_where_with,
    breadth_first_with, depth_first_with, dijkstra_nearest_with,
};
use solid::{Point3, Vector3};

use super::events::PlanEvent;
use super::graph::{DualGraph, NodeId, cost_of, estimate_of};
use super::landmarks::Landmarks;
use super::nearest::NearestPoint;
use super::space::Space;
use crate::{Algorithm, Heuristic, Maps3dError, PlanOptions};

/// A way through the nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    /// Without the start; the last is the goal, which is a frontier point or [`Query::goal_node`].
    pub nodes: Vec<u32>,
    pub cost: f64,
    pub expansions: usize,
}

/// A graph with the start, and if there is one the goal, as two more nodes.
pub(super) struct Query<'a> {
    pub space: &'a Space,
    pub graph: &'a DualGraph,
    pub from: (Point3, u32),
    pub to: Option<(Point3, u32)>,
    /// Gates that turned out too narrow, ascending.
    pub blocked: &'a [u32],
    /// The frontier points that are goals, for their nearest.
    pub goals: &'a NearestPoint,
    /// By frontier point: whether it is a goal.
    pub wanted: &'a [bool],
    pub landmarks: Option<&'a Landmarks>,
    /// Set once the goal was expanded: nothing else is of interest then.
    pub done: Cell<bool>,
}

impl Query<'_> {
    fn start_node(&self) -> u32 {
        self.graph.points().len() as u32
    }

    pub fn goal_node(&self) -> u32 {
        self.start_node() + 1
    }

    pub fn is_goal(&self, node: u32) -> bool {
        match self.to {
            Some(_) => node == self.goal_node(),
            None => {
                let point = (node as usize).checked_sub(self.graph.tetrahedra());
                point.and_then(|point| self.wanted.get(point)).is_some_and(|&wanted| wanted)
            }
        }
    }

    pub fn at(&self, node: u32) -> Point3 {
        match (node.checked_sub(self.start_node()), self.to) {
            (None, _) => self.graph.points()[node as usize],
            (Some(1), Some((to, _))) => to,
            _ => self.from.0,
        }
    }

    fn last_leg(&self, to: Point3, around: u32) -> f64 {
        cost_of((to - self.graph.points()[around as usize]).norm())
    }

    /// What is left from a node at least, as a cost.
    fn estimate(&self, node: u32, heuristic: Heuristic) -> f64 {
        let at = self.at(node);
        let distance_m = match (heuristic, self.to) {
            (Heuristic::Zero, _) => return 0.0,
            (Heuristic::Euclidean, Some((to, _))) => (to - at).norm(),
            (Heuristic::Landmarks, Some((to, around))) => {
                let straight = estimate_of((to - at).norm());
                // The last leg leads from the tetrahedron of the goal to the goal.
                return match self.landmarks.filter(|_| node < self.start_node()) {
                    Some(landmarks) => {
                        straight.max(landmarks.estimate(node, around) + self.last_leg(to, around))
                    }
                    None => straight,
                };
            }
            (Heuristic::Manhattan, Some((to, _))) => manhattan(&(to - at)),
            // The nearest by the sum of differences is at least as far as the nearest by the straight
            // distance over the square root of 3.
            (Heuristic::Manhattan, None) => self.goals.distance_m(&at) / 3.0_f64.sqrt(),
            (Heuristic::Euclidean | Heuristic::Landmarks, None) => self.goals.distance_m(&at),
        };
        estimate_of(distance_m)
    }
}

fn manhattan(difference: &Vector3) -> f64 {
    difference.abs().sum() / 3.0_f64.sqrt()
}

impl Graph for Query<'_> {
    type Node = NodeId;

    fn node_bound(&self) -> usize {
        self.graph.points().len() + 2
    }

    fn for_each_edge(&self, from: NodeId, mut visit: impl FnMut(NodeId, f64)) {
        if self.done.get() {
            return;
        }
        if self.is_goal(from.0) {
            self.done.set(true);
            return;
        }
        let (start, inside) = self.from;
        let here = if from.0 == self.start_node() {
            visit(NodeId(inside), cost_of((self.graph.points()[inside as usize] - start).norm()));
            inside
        } else {
            for edge in self.graph.edges_of(from.0) {
                let shut = self.blocked.binary_search(&edge.gate).is_ok();
                if !shut && self.graph.is_passable(self.space, from.0, edge) {
                    visit(NodeId(edge.to), edge.cost);
                }
            }
            from.0
        };
        // A tetrahedron is convex: its points are joined straight.
        if let Some((to, around)) = self.to
            && here == around
        {
            visit(NodeId(self.goal_node()), cost_of((to - self.at(from.0)).norm()));
        }
    }
}

/// The way of one search, if there is one; and the expansions that it took.
pub(super) fn search<P>(
    query: &Query<'_>,
    options: &PlanOptions,
    scratch: &mut Scratch<NodeId>,
    probe: &mut P,
) -> Result<(Option<Found>, usize), Maps3dError>
where
    P: for<'e> Probe<PlanEvent<'e>>,
{
    let start = NodeId(query.start_node());
    let is_goal = |node: NodeId| query.is_goal(node.0);
    let mut relay = Relay { query, probe, last: None };
    query.done.set(false);
    match options.algorithm {
        Algorithm::Astar => {
            let estimate = |node: NodeId| query.estimate(node.0, options.heuristic);
            let route = astar_where_with(query, start, is_goal, estimate, scratch, &mut relay)
                .map_err(broken)?;
            let Some(route) = route else {
                return Ok((None, scratch.tree().len()));
            };
            let nodes = route.nodes[1..].iter().map(|node| node.0).collect();
            let found = Found { nodes, cost: route.cost, expansions: route.expanded };
            Ok((Some(found), route.expanded))
        }
        Algorithm::Dijkstra => {
            let limit = f64::INFINITY;
            let nearest = dijkstra_nearest_with(query, start, limit, is_goal, scratch, &mut relay)
                .map_err(broken)?;
            let expansions = nearest.tree.len() - usize::from(nearest.goal.is_some());
            let goal = nearest.goal.map(|goal| goal.node);
            Ok((traced(query, scratch, goal, expansions), expansions))
        }
        Algorithm::Breadth => {
            let tree = breadth_first_with(query, start, usize::MAX, scratch, &mut relay)
                .map_err(broken)?;
            let place = tree.settled().iter().position(|settled| is_goal(settled.node));
            let goal = place.map(|place| tree.settled()[place].node);
            let expansions = place.unwrap_or(tree.len());
            Ok((traced(query, scratch, goal, expansions), expansions))
        }
        Algorithm::Depth => {
            let found = depth_first_with(query, start, scratch, &mut relay).map_err(broken)?;
            let place = found.tree.settled().iter().position(|settled| is_goal(settled.node));
            let goal = place.map(|place| found.tree.settled()[place].node);
            let expansions = place.unwrap_or(found.tree.len());
            Ok((traced(query, scratch, goal, expansions), expansions))
        }
    }
}

/// The graph checks itself; a search that refuses it is a bug of ours, told as an error all the same.
fn broken(error: search::SearchError) -> Maps3dError {
    Maps3dError::Search { reason: error.to_string() }
}

/// The path to the goal, and its cost in metres, whatever the search counted.
fn traced(
    query: &Query<'_>,
    scratch: &Scratch<NodeId>,
    goal: Option<NodeId>,
    expansions: usize,
) -> Option<Found> {
    let path = scratch.tree().path_to(goal?)?;
    let nodes: Vec<u32> = path[1..].iter().map(|node| node.0).collect();
    let first = cost_of((query.at(*nodes.first()?) - query.from.0).norm());
    let legs = nodes.windows(2).map(|pair| match query.graph_edge(pair[0], pair[1]) {
        Some(cost) => cost,
        None => cost_of((query.at(pair[1]) - query.at(pair[0])).norm()),
    });
    let cost = first + legs.sum::<f64>();
    Some(Found { nodes, cost, expansions })
}

impl Query<'_> {
    fn graph_edge(&self, from: u32, to: u32) -> Option<f64> {
        (to < self.start_node()).then(|| self.graph.edge(from, to).map(|edge| edge.cost)).flatten()
    }
}

/// Tells the events of every search in one language.
struct Relay<'a, 'q, P> {
    query: &'a Query<'q>,
    probe: &'a mut P,
    /// The node that was settled last, for searches that tell its expansion apart.
    last: Option<(NodeId, Option<NodeId>, f64)>,
}

impl<P: for<'e> Probe<PlanEvent<'e>>> Relay<'_, '_, P> {
    fn at(&self, node: NodeId) -> Point3 {
        self.query.at(node.index() as u32)
    }

    fn opened(&mut self, from: Option<NodeId>, node: NodeId, cost: f64) {
        if self.probe.on() {
            let (at, before) = (self.at(node), from.map(|from| self.at(from)));
            self.probe.emit(PlanEvent::Opened { node, at, before, cost });
        }
    }

    fn expanded(&mut self, parent: Option<NodeId>, node: NodeId, cost: f64, estimate: f64) {
        if self.probe.on() {
            let (at, before) = (self.at(node), parent.map(|from| self.at(from)));
            self.probe.emit(PlanEvent::Expanded { node, at, before, cost, estimate });
        }
    }
}

impl<P: for<'e> Probe<PlanEvent<'e>>> Probe<AstarEvent<NodeId>> for Relay<'_, '_, P> {
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: AstarEvent<NodeId>) {
        match event {
            AstarEvent::Relaxed { from, to, cost, .. } => self.opened(Some(from), to, cost),
            AstarEvent::Expanded { node, cost, estimate, parent } => {
                self.expanded(parent, node, cost, estimate);
            }
            // A node that is opened again is told by the leg that did so; the end by `Routed`.
            AstarEvent::Reopened { .. }
            | AstarEvent::Found { .. }
            | AstarEvent::Exhausted { .. } => {}
        }
    }
}

impl<P: for<'e> Probe<PlanEvent<'e>>> Probe<DijkstraEvent<NodeId>> for Relay<'_, '_, P> {
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: DijkstraEvent<NodeId>) {
        match event {
            DijkstraEvent::Relaxed { from, to, cost, .. } => self.opened(Some(from), to, cost),
            DijkstraEvent::Settled { node, cost, parent } => self.last = Some((node, parent, cost)),
            DijkstraEvent::Expanded { .. } => {
                if let Some((node, parent, cost)) = self.last {
                    self.expanded(parent, node, cost, 0.0);
                }
            }
            DijkstraEvent::BeyondLimit { .. }
            | DijkstraEvent::Found { .. }
            | DijkstraEvent::Exhausted { .. } => {}
        }
    }
}

impl<P: for<'e> Probe<PlanEvent<'e>>> Probe<BreadthEvent<NodeId>> for Relay<'_, '_, P> {
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: BreadthEvent<NodeId>) {
        match event {
            BreadthEvent::Reached { from, node, hops } => {
                self.last = Some((node, from, hops as f64));
                self.opened(from, node, hops as f64);
            }
            BreadthEvent::Expanded { node } => {
                // Once the goal is known, what is told is the rest of its level, without legs.
                if !self.query.done.get() {
                    self.expanded(None, node, 0.0, 0.0);
                }
            }
            BreadthEvent::Exhausted { .. } => {}
        }
    }
}

impl<P: for<'e> Probe<PlanEvent<'e>>> Probe<DepthEvent<NodeId>> for Relay<'_, '_, P> {
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: DepthEvent<NodeId>) {
        if let DepthEvent::Entered { node, parent, depth } = event
            && !self.query.done.get()
        {
            self.opened(parent, node, depth as f64);
            if !self.query.is_goal(node.0) {
                self.expanded(parent, node, depth as f64, 0.0);
            }
        }
    }
}
