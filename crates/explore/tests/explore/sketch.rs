//! A map and a robot whose answers are written down, so that only the policy is on trial.

use std::collections::VecDeque;

use explore::{Ending, ExploreParams, Explorer, Policy, RapidParams};
use geometry::{Point2, Vector2};
use maps2d::{Candidate, Clearance, ExplorationMap, Frontier, MapProbe, Route, Standing, Vantage};
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};

use super::heard::Heard;

/// A piece of frontier, in the frame of the first vertex.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    pub at: Point2,
    pub normal: Vector2,
    /// A scan that looks at it from nearer than this closes it, metres.
    pub closes_within_m: f64,
    /// With every scan it is farther along its normal by so much, metres.
    pub recedes_m: f64,
    /// With every scan it changes over to the other side of the origin.
    pub changes_sides: bool,
}

impl Spot {
    /// One that faces away from the origin and closes when it is as good as reached.
    pub fn new(x: f64, y: f64) -> Self {
        let at = Point2::new(x, y);
        Self {
            at,
            normal: at.coords.normalize(),
            closes_within_m: 0.1,
            recedes_m: 0.0,
            changes_sides: false,
        }
    }

    /// One at the origin's distance and bearing.
    pub fn towards(bearing_rad: f64, distance_m: f64) -> Self {
        let (sin, cos) = bearing_rad.sin_cos();
        Self::new(distance_m * cos, distance_m * sin)
    }
}

/// A map that is a list of spots, all in view from everywhere.
#[derive(Clone, Debug)]
pub struct Sketch {
    pub spots: Vec<Spot>,
    pub in_view: bool,
    /// Distance to obstacles of the straight motion between two points.
    pub clearance: fn(Point2, Point2) -> f64,
    /// The only detour that there is.
    pub detour: Option<Point2>,
    /// Answers to [`ExplorationMap::route`], then `None`.
    pub routes: VecDeque<Route>,
    /// Length of frontier out of view after so many scans, metres.
    pub out_of_view_m: fn(u32) -> f64,
    /// Whether its routes can leave out places that wait.
    pub by_vertex: bool,
    first_from_vertex: Vec<Se2>,
    scans: u32,
}

impl Sketch {
    pub fn new(spots: Vec<Spot>) -> Self {
        Self {
            spots,
            in_view: true,
            clearance: |_, _| 1.0,
            detour: None,
            routes: VecDeque::new(),
            // A sum that is kept up to date over a long run never has the same bits twice.
            out_of_view_m: |scans| 1e-12 * f64::from(scans),
            by_vertex: true,
            first_from_vertex: vec![Se2::identity()],
            scans: 0,
        }
    }

    fn first_from_body(&self, standing: &Standing) -> Se2 {
        let vertex = standing.vertex.0 as usize;
        let place = self.first_from_vertex.get(vertex).copied().unwrap_or_default();
        place * standing.vertex_from_body
    }
}

impl ExplorationMap for Sketch {
    fn kind(&self) -> &'static str {
        "sketch"
    }

    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], _probe: &mut dyn MapProbe) {
        for (id, edge) in graph.edges() {
            if edges.contains(&id) {
                let from = self.first_from_vertex[edge.a.0 as usize];
                self.first_from_vertex.push(from * edge.a_from_b);
            }
        }
    }

    fn edge_withdrawn(&mut self, _graph: &PoseGraph, _edge: EdgeId, _probe: &mut dyn MapProbe) {}

    fn poses_reestimated(&mut self, _map_from_vertex: &[Se2], _probe: &mut dyn MapProbe) {}

    fn scanned(&mut self, standing: &Standing, _scan: &Scan, _probe: &mut dyn MapProbe) {
        self.scans += 1;
        let first_from_body = self.first_from_body(standing);
        self.spots.retain(|spot| {
            let in_body = first_from_body.inverse_transform(&spot.at);
            let distance_m = in_body.coords.norm();
            let ahead = distance_m < 0.1 || in_body.y.atan2(in_body.x).abs() < 0.2;
            !(ahead && distance_m < spot.closes_within_m)
        });
        for spot in &mut self.spots {
            spot.at += spot.normal * spot.recedes_m;
            if spot.changes_sides {
                spot.at = -spot.at;
            }
        }
    }

    fn frontier(&self) -> Frontier {
        let places = self.spots.len();
        let open_m = places as f64 + (self.out_of_view_m)(self.scans);
        Frontier { open_m, ignored_m: 0.0, places }
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
        let first_from_body = self.first_from_body(standing);
        let seen = self.spots.iter().filter(|_| self.in_view).enumerate();
        out.extend(seen.map(|(tag, spot)| Candidate {
            goals_in_body: [first_from_body.inverse_transform(&spot.at); 3],
            normal_in_body: first_from_body.rotation.inverse() * spot.normal,
            length_m: 1.0,
            turn_only: false,
            tag: tag as u64,
        }));
    }

    fn around(&mut self, _standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        let first_from_body = self.first_from_body(standing);
        let from = first_from_body.transform(&Point2::origin());
        let least_m = (self.clearance)(from, first_from_body.transform(to_in_body));
        // It starts far from everything, so nothing is forgiven for the sake of leaving.
        Clearance { at_start_m: 9.0, along_m: least_m, after_m: least_m, at_end_m: least_m }
    }

    fn route(&mut self, _standing: &Standing, _clearance_m: f64) -> Option<Route> {
        self.routes.pop_front()
    }

    fn has_frontier_by_vertex(&self) -> bool {
        self.by_vertex
    }

    fn frontier_at(&self, _vertex: VertexId) -> f64 {
        self.spots.len() as f64
    }

    /// Ways over cells lead round corners already.
    fn vantage(&mut self, _: &Standing, _: &Point2, _: f64) -> Option<Vantage> {
        None
    }

    fn detour(&self, standing: &Standing, _goal: &Point2, _clearance_m: f64) -> Option<Point2> {
        let stop = self.detour?;
        Some(self.first_from_body(standing).inverse_transform(&stop))
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        _everywhere: bool,
        _probe: &mut dyn MapProbe,
    ) {
        let goal = self.first_from_body(standing).transform(goal_in_body);
        self.spots.retain(|spot| (spot.at - goal).norm() > radius_m);
    }

    fn bytes(&self) -> usize {
        0
    }
}

/// What the policy had the robot do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    Turn(f64),
    Forward(f64),
    Repeat(VertexId),
    Scan,
}

/// A robot without noise that sees nothing and writes down what it is told to do.
#[derive(Clone, Debug, Default)]
pub struct Puppet {
    pub commands: Vec<Command>,
}

impl Puppet {
    pub fn forwards(&self) -> Vec<f64> {
        let forward = |command: &Command| match command {
            Command::Forward(distance_m) => Some(*distance_m),
            _ => None,
        };
        self.commands.iter().filter_map(forward).collect()
    }
}

impl Robot for Puppet {
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        self.commands.push(Command::Turn(angle_rad));
        Odometry { before_from_after: Se2::from_angle(angle_rad), distance_m: 0.0, snapped: None }
    }

    fn forward(&mut self, distance_m: f64) -> Odometry {
        self.commands.push(Command::Forward(distance_m));
        Odometry { before_from_after: Se2::new(distance_m, 0.0, 0.0), distance_m, snapped: None }
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        self.commands.push(Command::Repeat(to));
        Repeated { vertex: to, vertex_from_body: Se2::identity(), distance_m: length_m }
    }

    fn scan(&mut self) -> Scan {
        self.commands.push(Command::Scan);
        Scan::new(0.0, 1.0, Vec::new(), 5.0)
    }

    fn mark(&mut self, _vertex: VertexId) {}

    fn recognize(&mut self) -> Vec<PlaceMatch> {
        Vec::new()
    }
}

/// A finished run over a sketch.
pub struct Played {
    pub ending: Option<Ending>,
    pub robot: Puppet,
    pub heard: Heard,
    pub explorer: Explorer,
}

/// Plays at most 2,000 steps; a run that has not ended by then has no ending.
pub fn play(map: Sketch, params: RapidParams) -> Played {
    let params = ExploreParams { policy: Policy::Rapid(params), ..ExploreParams::default() };
    let mut explorer = Explorer::new(vec![Box::new(map)], params);
    let (mut robot, mut heard) = (Puppet::default(), Heard::default());
    let mut ending = None;
    for _ in 0..2_000 {
        ending = explorer.step(&mut robot, &mut heard).ending;
        if ending.is_some() {
            break;
        }
    }
    Played { ending, robot, heard, explorer }
}
