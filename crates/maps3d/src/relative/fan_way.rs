//! The way to the nearest frontier through the fans of overlapping views.

use solid::{Point3, Tetrahedra};

use super::RelativeMap;
use super::fans::Fans;
use super::straight::{drawn_straight, is_open};
use crate::plan::{FrontierNode, polyline_m};
use crate::{Hovering, Maps3dError, PlanOptions, Planner, Target};

/// A body is no smaller than this, metres: without a radius nothing would keep a way in one volume from an
/// obstacle face of another.
pub(super) const LEAST_M: f64 = 1e-3;

/// A start so near to a volume counts as in it, metres.
pub(super) const NEAR_M: f64 = 0.1;

/// Where something is nearer to the start than the radius, a way may keep less, but this share of it.
pub(super) const LEAST_SHARE: f64 = 0.4;

/// And then this share of what the start has.
pub(super) const OF_START: f64 = 0.9;

/// How a way through fans is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FanOptions {
    /// The robot is a ball of this radius, metres.
    pub radius_m: f64,
    /// Volumes that are taken at most, the nearest along the graph first.
    pub most_volumes: usize,
    /// Paths that are planned at most, to the places that are nearest straight on first.
    pub most_plans: usize,
}

impl Default for FanOptions {
    fn default() -> Self {
        Self { radius_m: 0.1, most_volumes: 24, most_plans: 24 }
    }
}

/// A way through fans.
#[derive(Clone, Debug, PartialEq)]
pub struct FanWay {
    /// From the robot to the frontier or the place, bends included; in the frame `body`, metres.
    pub in_body: Vec<Point3>,
    /// Its length, metres.
    pub length_m: f64,
    /// Length of the planner's way through centroids, metres; `None` for a straight line, for which none was
    /// planned.
    pub centroids_m: Option<f64>,
    /// The same after the cone programme shortened it in its corridor, before bends between volumes were left out.
    pub corridor_m: Option<f64>,
    /// What it keeps from obstacle faces of all volumes, metres: the radius, or less where the robot was
    /// nearer to one to begin with.
    pub keeps_m: f64,
}

/// What a search through fans came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FanSearch {
    /// Volumes that were taken.
    pub volumes: usize,
    /// Their tetrahedra.
    pub tetrahedra: usize,
    /// Places on frontier that counted as goals.
    pub goals: usize,
    /// Paths that were planned.
    pub plans: usize,
    /// The way; `None` where there is no frontier in these volumes, or none was found that keeps clear.
    pub way: Option<FanWay>,
}

impl RelativeMap {
    /// The way of a round body to the nearest frontier, through the fans of the views in scope linked through
    /// the graph: the planner of \[Mos15\] 4.3 to 4.5 for a map that unites nothing (step 10 of the page of this map).
    ///
    /// Goals are the places of open frontier as the policy takes them, but for those that were within the radius
    /// of a camera: the body was there. Straight lines that stay inside of the volumes are taken first;
    /// otherwise the planner finds the way, which is drawn straight where the volumes allow it. All is in
    /// the frame of the vertex, so that drift counts along the graph only. The map stays as it is.
    ///
    /// Cost: O(t log t) for the t tetrahedra of at most `most_volumes` views, about 1,300 each, and that of at
    /// most `most_plans` plans, and one more.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for a radius out of its range.
    pub fn way_through_fans(
        &mut self,
        hovering: &Hovering,
        options: &FanOptions,
    ) -> Result<FanSearch, Maps3dError> {
        let fans = self.fans_around(hovering.vertex, options.most_volumes);
        let mut search = FanSearch {
            volumes: fans.volumes.len(),
            tetrahedra: fans.volumes.iter().map(|fan| fan.tetrahedra.len()).sum(),
            ..FanSearch::default()
        };
        let from = Point3::from(hovering.vertex_from_body.translation);
        let Some(mut seeker) = Seeker::new(&fans, &from, options)? else { return Ok(search) };
        let mut way = seeker.nearest(&fans, options, &mut search)?;
        for point in way.iter_mut().flat_map(|way| &mut way.in_body) {
            *point = hovering.vertex_from_body.inverse_transform(point);
        }
        search.way = way;
        self.count(&search);
        Ok(search)
    }

    /// Counts what was planned.
    pub(super) fn count(&mut self, search: &FanSearch) {
        let work = &mut self.planned;
        work.tetrahedra = search.tetrahedra;
        if let Some(way) = &search.way
            && let Some(centroids_m) = way.centroids_m
        {
            work.paths += 1;
            work.paths_m += centroids_m;
            work.shortened_m += way.length_m;
        }
    }
}

/// A planner over fans, and from where.
struct Seeker {
    planner: Planner,
    start: Point3,
    keeps_m: f64,
}

impl Seeker {
    /// `None` where the start is in no volume, or too near to an obstacle.
    fn new(fans: &Fans, from: &Point3, options: &FanOptions) -> Result<Option<Self>, Maps3dError> {
        let volumes: Vec<&Tetrahedra> = fans.volumes.iter().collect();
        let planner = |radius_m: f64| {
            Planner::new(&volumes, &PlanOptions { radius_m, ..PlanOptions::default() })
        };
        let is_small = (0.0..LEAST_M).contains(&options.radius_m);
        let mut keeps_m = if is_small { LEAST_M } else { options.radius_m };
        let mut made = planner(keeps_m)?;
        let Some(start) = made.space().entry(from, NEAR_M) else { return Ok(None) };
        if let Some(distance_m) = made.space().obstacles().within(&start, keeps_m) {
            if OF_START * distance_m < LEAST_SHARE * keeps_m {
                return Ok(None);
            }
            keeps_m = OF_START * distance_m;
            made = planner(keeps_m)?;
        }
        Ok(Some(Self { planner: made, start, keeps_m }))
    }

    /// The shortest way that was found to any goal, in the frame of the volumes.
    fn nearest(
        &mut self,
        fans: &Fans,
        options: &FanOptions,
        search: &mut FanSearch,
    ) -> Result<Option<FanWay>, Maps3dError> {
        let is_body = |at: &Point3| {
            fans.lenses.iter().chain([&self.start]).any(|l| (at - l).norm() <= options.radius_m)
        };
        let nodes = self.planner.graph().frontier();
        let counts: Vec<bool> = nodes.iter().map(|node| !is_body(&node.at)).collect();
        let far = |node: &FrontierNode| (node.at - self.start).norm();
        let mut goals: Vec<(f64, usize)> =
            (0..nodes.len()).filter(|&i| counts[i]).map(|i| (far(&nodes[i]), i)).collect();
        goals.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        search.goals = goals.len();
        let mut best: Option<FanWay> = None;
        for &(straight_m, node) in &goals {
            // No way is shorter than a straight line, and the goals are in their order.
            if best.as_ref().is_some_and(|way| way.length_m <= straight_m) {
                break;
            }
            let at = self.planner.graph().frontier()[node].at;
            if is_open(self.planner.space(), &self.start, &at, self.keeps_m) {
                let (in_body, keeps_m) = (vec![self.start, at], self.keeps_m);
                best = Some(FanWay {
                    in_body,
                    length_m: straight_m,
                    centroids_m: None,
                    corridor_m: None,
                    keeps_m,
                });
                break;
            }
            if search.plans < options.most_plans {
                search.plans += 1;
                let found = self.planned(&Target::Point(at));
                best = [best, found]
                    .into_iter()
                    .flatten()
                    .min_by(|a, b| a.length_m.total_cmp(&b.length_m));
            }
        }
        if best.is_none() && goals.len() > search.plans {
            search.plans += 1;
            let tried: Vec<usize> =
                goals.iter().take(options.most_plans).map(|goal| goal.1).collect();
            let mut number = 0..;
            self.planner.set_goals(|_, _| {
                number.next().is_some_and(|i: usize| counts[i] && !tried.contains(&i))
            });
            best = self.planned(&Target::Frontier);
        }
        Ok(best)
    }

    /// A planned way that keeps clear, drawn straight.
    fn planned(&mut self, target: &Target) -> Option<FanWay> {
        // A goal that an obstacle of another volume is too near to is none.
        let plan =
            self.planner.plan(&self.start, target).ok().flatten().filter(|plan| plan.clear)?;
        let (space, keeps_m) = (self.planner.space(), self.keeps_m);
        let in_body = drawn_straight(space, &plan.points(), keeps_m);
        let length_m = polyline_m(&in_body);
        let (centroids_m, corridor_m) = (Some(plan.cost_m), Some(plan.path_m));
        Some(FanWay { in_body, length_m, centroids_m, corridor_m, keeps_m })
    }
}
