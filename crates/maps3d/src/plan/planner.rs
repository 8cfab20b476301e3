//! Steps 5 to 8 in a row: search, shorten, verify, and search again where it is too narrow.

use std::cell::Cell;

use probe::{Off, Probe};
use search::Scratch;
use solid::predicates::in_envelope;
use solid::{Point3, Tetrahedra};

use super::corridor::{Corridor, Knot, length_m, of_way};
use super::events::PlanEvent;
use super::frontier::FrontierNode;
use super::graph::{DualGraph, NodeId};
use super::landmarks::Landmarks;
use super::nearest::NearestPoint;
use super::route::{Query, search};
use super::shorten::shorten;
use super::space::Space;
use crate::{Algorithm, Heuristic, Maps3dError, PlanOptions, Target};

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// From the start through the nodes to the goal, bends included.
    pub way: Vec<Knot>,
    /// Length of the way, metres, as a cost: each leg dearer than it is long by less than 2e-8 m.
    pub cost_m: f64,
    /// Length of the straight lines between the nodes of the way, metres: what the way would be if
    /// legs did not have to stay inside.
    pub straight_m: f64,
    /// The tetrahedra that are passed.
    pub corridor: Corridor,
    /// The path, with the place of each point in the corridor; the way itself where nothing was shortened.
    pub path: Vec<Knot>,
    /// Its length, metres.
    pub path_m: f64,
    /// Cone programmes that were solved.
    pub programmes: usize,
    /// Expansions of all searches.
    pub expansions: usize,
    /// Corridors that were tried.
    pub tries: usize,
    /// Whether the path keeps the radius from obstacles; false where every corridor that was tried is too
    /// narrow as far as is known: the path is the first way then.
    pub clear: bool,
    /// Distance of the path from the nearest obstacle face, metres, up to the radius.
    pub clearance_m: f64,
    /// The frontier point that it leads to, in the order of [`DualGraph::frontier`].
    pub frontier: Option<u32>,
}

impl Plan {
    /// The points of the path.
    pub fn points(&self) -> Vec<Point3> {
        self.path.iter().map(|knot| knot.at).collect()
    }
}

/// A space and its dual graph, ready for questions.
#[derive(Debug)]
pub struct Planner {
    space: Space,
    graph: DualGraph,
    options: PlanOptions,
    goals: NearestPoint,
    /// By frontier point: whether it is a goal.
    wanted: Vec<bool>,
    landmarks: Option<Landmarks>,
    scratch: Scratch<NodeId>,
}

impl Planner {
    /// Joins the tetrahedra of one or several volumes, all in one frame.
    ///
    /// # Errors
    /// [`Maps3dError`] for options out of their range and for what of a volume points at nothing.
    pub fn new(volumes: &[&Tetrahedra], options: &PlanOptions) -> Result<Self, Maps3dError> {
        Self::over(Space::new(volumes)?, options)
    }

    /// The same over a space that is known already.
    pub(crate) fn over(space: Space, options: &PlanOptions) -> Result<Self, Maps3dError> {
        let graph = DualGraph::new(&space, options)?;
        let goals = NearestPoint::new(graph.frontier().iter().map(|node| node.at).collect());
        let wanted = vec![true; graph.frontier().len()];
        let (options, landmarks, scratch) = (*options, None, Scratch::new());
        Ok(Self { space, graph, options, goals, wanted, landmarks, scratch })
    }

    /// From now on only the frontier points that `keep` wants are goals; ways may pass the others.
    pub fn set_goals(&mut self, mut keep: impl FnMut(&Space, &FrontierNode) -> bool) {
        let nodes = self.graph.frontier();
        self.wanted = nodes.iter().map(|node| keep(&self.space, node)).collect();
        let goals = nodes.iter().zip(&self.wanted).filter(|(_, wanted)| **wanted);
        self.goals = NearestPoint::new(goals.map(|(node, _)| node.at).collect());
    }

    /// The space.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// Its dual graph.
    pub fn graph(&self) -> &DualGraph {
        &self.graph
    }

    /// The options.
    pub fn options(&self) -> &PlanOptions {
        &self.options
    }

    /// Searches the same graph another way from now on.
    pub fn set_search(&mut self, algorithm: Algorithm, heuristic: Heuristic) {
        (self.options.algorithm, self.options.heuristic) = (algorithm, heuristic);
    }

    /// Finds out what the first search to a point would find out before it starts: the costs from
    /// landmarks, if these are asked for.
    pub fn prepare(&mut self) {
        let PlanOptions { algorithm, heuristic, .. } = self.options;
        if (algorithm, heuristic) == (Algorithm::Astar, Heuristic::Landmarks) {
            self.landmarks.get_or_insert_with(|| Landmarks::new(&self.graph));
        }
    }

    /// From now on paths are shortened, or not.
    pub fn set_shorten(&mut self, shorten: bool) {
        self.options.shorten = shorten;
    }

    /// Tells a probe what was joined.
    pub fn tell<P: for<'e> Probe<PlanEvent<'e>>>(&self, probe: &mut P) {
        probe.emit(PlanEvent::Joined { space: &self.space, graph: &self.graph });
    }

    /// Whether a path may be asked for.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub fn check(&self, from: &Point3, target: &Target) -> Result<(), Maps3dError> {
        self.placed("start", from)?;
        if let Target::Point(to) = target {
            self.placed("goal", to)?;
        }
        Ok(())
    }

    /// A path, or `None` where there is none.
    ///
    /// # Errors
    /// [`Maps3dError::Outside`] where start or goal lie in no tetrahedron,
    /// [`Maps3dError::TooNear`] where an obstacle is nearer to one of them than the radius.
    pub fn plan(&mut self, from: &Point3, target: &Target) -> Result<Option<Plan>, Maps3dError> {
        self.plan_with(from, target, &mut Off)
    }

    /// [`plan`](Self::plan), watched by a probe.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub fn plan_with<P>(
        &mut self,
        from: &Point3,
        target: &Target,
        probe: &mut P,
    ) -> Result<Option<Plan>, Maps3dError>
    where
        P: for<'e> Probe<PlanEvent<'e>>,
    {
        let start = self.placed("start", from)?;
        let goal = match target {
            Target::Point(to) => Some(self.placed("goal", to)?),
            Target::Frontier => None,
        };
        let to = goal.map(|(to, _)| to);
        probe.emit(PlanEvent::Located { from: *from, to, tetrahedron: start.1 });
        if to.is_some() {
            self.prepare();
        }
        let mut blocked: Vec<u32> = Vec::new();
        let mut first: Option<Plan> = None;
        let mut expansions = 0;
        for tries in 1..=self.options.tries {
            let query = Query {
                space: &self.space,
                graph: &self.graph,
                from: start,
                to: goal,
                blocked: &blocked,
                goals: &self.goals,
                wanted: &self.wanted,
                landmarks: self.landmarks.as_ref(),
                done: Cell::new(false),
            };
            let (found, more) = search(&query, &self.options, &mut self.scratch, probe)?;
            expansions += more;
            let Some(found) = found else { break };
            let (corridor, gates, way) = of_way(&query, &found);
            if probe.on() {
                let points: Vec<Point3> = way.iter().map(|knot| knot.at).collect();
                let (corridor, cost) = (&corridor.tetrahedra[..], found.cost);
                probe.emit(PlanEvent::Routed { points: &points, corridor, cost, expansions: more });
            }
            let nodes = found.nodes.iter().map(|&node| query.at(node));
            let straight_m =
                nodes.fold((start.0, 0.0), |(at, sum), next| (next, sum + (next - at).norm())).1;
            let last = found.nodes.last().copied().filter(|&node| node != query.goal_node());
            let frontier = last.map(|node| node - self.graph.tetrahedra() as u32);
            let radius_m = self.options.radius_m;
            let mut plan = Plan {
                cost_m: found.cost,
                straight_m,
                path_m: length_m(&way),
                path: way.clone(),
                way,
                corridor,
                programmes: 0,
                expansions,
                tries,
                clear: true,
                clearance_m: radius_m,
                frontier,
            };
            let short = shorten(
                &self.space,
                &plan.corridor,
                radius_m,
                &plan.way,
                self.options.shorten,
                probe,
            );
            match short {
                Ok(short) => {
                    plan.path = short.knots;
                    plan.path_m = length_m(&plan.path);
                    plan.programmes = short.programmes;
                    return Ok(Some(finished(plan, probe)));
                }
                Err(narrow) => {
                    probe.emit(PlanEvent::Blocked {
                        at: narrow.at,
                        clearance_m: narrow.clearance_m,
                    });
                    let Some(&gate) = gates.get(narrow.gate as usize) else { break };
                    let at = blocked.partition_point(|&other| other < gate);
                    blocked.insert(at, gate);
                    first.get_or_insert(plan);
                }
            }
        }
        let Some(mut plan) = first else {
            probe.emit(PlanEvent::Unreachable { expansions });
            return Ok(None);
        };
        plan.tries = blocked.len();
        plan.expansions = expansions;
        plan.clear = false;
        plan.clearance_m = self.clearance_m(&plan.path);
        Ok(Some(finished(plan, probe)))
    }

    /// The tetrahedron of a point that lies in one, and far enough from obstacles.
    fn placed(&self, what: &'static str, at: &Point3) -> Result<(Point3, u32), Maps3dError> {
        let [x, y, z] = at.coords.into();
        let inside = in_envelope(at).then(|| self.space.locate(at)).flatten();
        let Some(tetrahedron) = inside else {
            return Err(Maps3dError::Outside { what, x, y, z });
        };
        let radius_m = self.options.radius_m;
        match self.space.obstacles().within(at, radius_m) {
            Some(distance_m) => Err(Maps3dError::TooNear { what, x, y, z, distance_m, radius_m }),
            None => Ok((*at, tetrahedron)),
        }
    }

    /// Distance of a polyline from the nearest obstacle face, metres, up to the radius.
    fn clearance_m(&self, path: &[Knot]) -> f64 {
        let radius_m = self.options.radius_m;
        let near = path.windows(2).filter_map(|pair| {
            self.space.obstacles().near_segment(&pair[0].at, &pair[1].at, radius_m)
        });
        near.map(|near| near.distance_m).fold(radius_m, f64::min)
    }
}

fn finished<P: for<'e> Probe<PlanEvent<'e>>>(plan: Plan, probe: &mut P) -> Plan {
    if probe.on() {
        let points = plan.points();
        probe.emit(PlanEvent::Finished { points: &points, length_m: plan.path_m });
    }
    plan
}
