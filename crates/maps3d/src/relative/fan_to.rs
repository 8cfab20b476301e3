//! The way to a place near a vertex through the fans of the views between.

use nalgebra::Point3;
use probe::VertexId;

use super::RelativeMap;
use super::events::ConsolidationEvent;
use super::fan_way::{FanOptions, FanSearch, FanWay, LEAST_M, LEAST_SHARE, NEAR_M, OF_START};
use super::fans::Fans;
use super::straight::drawn_straight;
use crate::events::Relay;
use crate::plan::{nudged, polyline_m};
use crate::{Heuristic, Hovering, Map3dProbe, Maps3dError, Plan, PlanOptions, Planner, Target};

impl RelativeMap {
    /// The way of a round body from where it hovers to a place in the frame of a vertex, through the fans of the views
    /// between, linked through the graph: the planner of \[Mos15\] 4.3 to 4.5, its path shortened by the cone programme,
    /// then drawn straight from volume to volume (step 11 of the page of this map).
    ///
    /// Of the views in scope of the vertex hovered at those are taken whose vertices make the least detour along the
    /// graph. Obstacle faces of all of them are walls. All is in the frame of that vertex, so that drift counts along
    /// the graph only. Nothing is found where the vertex is out of scope, where start or goal lie in none of the volumes,
    /// or where no way keeps the radius; both may be nearer to an obstacle to begin with, and then the way keeps less.
    ///
    /// Cost: O(t log t) for the t tetrahedra of at most `most_volumes` views, about 1,300 each, and that of at most two
    /// plans.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for a radius out of its range.
    pub fn way_through_fans_to(
        &mut self,
        hovering: &Hovering,
        vertex: VertexId,
        place_in_vertex: &Point3<f64>,
        options: &FanOptions,
        probe: &mut dyn Map3dProbe,
    ) -> Result<FanSearch, Maps3dError> {
        PlanOptions { radius_m: options.radius_m, ..PlanOptions::default() }.check()?;
        let most = options.most_volumes;
        let between = self.fans_between(hovering, vertex, place_in_vertex, most, &mut *probe);
        let Some((fans, [from, to])) = between else { return Ok(FanSearch::default()) };
        let volumes = &fans.volumes[..];
        probe.emit(ConsolidationEvent::Fanned { vertex: hovering.vertex, volumes, from, to });
        let mut search = FanSearch {
            volumes: volumes.len(),
            tetrahedra: volumes.iter().map(|fan| fan.tetrahedra.len()).sum(),
            goals: 1,
            ..FanSearch::default()
        };
        let mut found = self.planned(&fans, [from, to], options.radius_m, &mut search, probe)?;
        if let Some((plan, way)) = &mut found {
            let given = &way.in_body[..];
            probe.emit(ConsolidationEvent::Planned { vertex: hovering.vertex, plan, given });
            for point in &mut way.in_body {
                *point = hovering.vertex_from_body.inverse_transform(point);
            }
        }
        search.way = found.map(|(_, way)| way);
        self.count(&search);
        Ok(search)
    }

    /// The plan between two points of some fans, and the way in their frame.
    fn planned(
        &self,
        fans: &Fans,
        ends: [Point3<f64>; 2],
        radius_m: f64,
        search: &mut FanSearch,
        probe: &mut dyn Map3dProbe,
    ) -> Result<Option<(Plan, FanWay)>, Maps3dError> {
        // Poses round, and a camera hovers at the tip of its own view.
        let holds = |at: &Point3<f64>| {
            let placed = fans.cameras();
            placed.into_iter().any(|(view, in_camera)| {
                self.views[view as usize].volume.contains(&in_camera.transform(at))
            })
        };
        let inside = |at: &Point3<f64>| nudged(at, NEAR_M, holds);
        let [from, to] = ends;
        let (Some(start), Some(goal)) = (inside(&from), inside(&to)) else { return Ok(None) };
        let space = self.space_of(fans, &[start, goal])?;
        let wanted_m = radius_m.max(LEAST_M);
        let near = |at: &Point3<f64>| space.obstacles().within(at, wanted_m);
        let near_m = [from, to, start, goal].iter().filter_map(near).min_by(f64::total_cmp);
        let keeps_m = near_m.map_or(wanted_m, |near_m| OF_START * near_m);
        let is_in = |at: &Point3<f64>| space.locate(at).is_some();
        // What holds a point to rounding need not hold it.
        if keeps_m < LEAST_SHARE * wanted_m || !is_in(&start) || !is_in(&goal) {
            return Ok(None);
        }
        search.plans += 1;
        let options = PlanOptions {
            radius_m: keeps_m,
            clear_legs: true,
            // Asked once: what landmarks take is more than they save.
            heuristic: Heuristic::Euclidean,
            ..PlanOptions::default()
        };
        let mut planner = Planner::over(space, &options)?;
        let mut heard = Relay(probe);
        planner.tell(&mut heard);
        let plan = planner.plan_with(&start, &Target::Point(goal), &mut heard)?;
        let Some(plan) = plan.filter(|plan| plan.clear) else { return Ok(None) };
        let mut path = plan.points();
        if start != from {
            path.insert(0, from);
        }
        if goal != to {
            path.push(to);
        }
        let in_body = drawn_straight(planner.space(), &path, keeps_m);
        let way = FanWay {
            length_m: polyline_m(&in_body),
            in_body,
            centroids_m: Some(plan.cost_m),
            corridor_m: Some(plan.path_m),
            keeps_m,
        };
        Ok(Some((plan, way)))
    }
}
