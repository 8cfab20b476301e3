//! Where else a goal can be reached from.

use geometry::Point2;
use probe::VertexId;

use super::RelativeMap;
use crate::{Standing, Vantage};

impl RelativeMap {
    /// Asks the volumes in scope, nearest first, whether the goal lies in their view with free space
    /// around the straight way to it.
    ///
    /// What a robot sees past two corners in a staircase of corridors it cannot reach on the line of
    /// sight; a volume nearer by sees it past one corner, or none.
    pub(super) fn nearest_vantage(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Vantage> {
        self.take_scope(standing.vertex, &mut probe::Off);
        let goal_in_root = standing.vertex_from_body.transform(goal_in_body);
        let rows = self.scope.placed();
        let (row, goal_in_vertex) = rows.iter().enumerate().skip(1).find_map(|(i, row)| {
            let volume = &self.volume(row.vertex)?.volume;
            let goal = row.root_from_vertex.inverse_transform(&goal_in_root);
            let near = goal.coords.norm() <= volume.radius_m();
            let reached = near && volume.motion_clearance(&goal).keeps(clearance_m);
            reached.then_some((i, goal))
        })?;
        Some(Vantage { way: self.way_to_row(row), goal_in_vertex })
    }

    /// The vertices after the root on the way to a row of the scope, with the lengths of their links.
    fn way_to_row(&self, row: usize) -> Vec<(VertexId, f64)> {
        let rows = self.scope.placed();
        let mut way = Vec::new();
        let mut at = row;
        while let Some(parent) = rows[at].parent {
            let parent = parent as usize;
            way.push((rows[at].vertex, rows[at].distance_m - rows[parent].distance_m));
            at = parent;
        }
        way.reverse();
        way
    }
}
