//! How much odometry drifts, as recognised places tell.

use pose::Se3;
use posegraph::{PoseGraph, Scope};
use probe::{EdgeId, VertexId};

use super::RelativeMap;

/// With fewer loops nothing is known.
const LEAST_LOOPS: u32 = 3;

/// What is that many standard deviations away does not happen.
const DEVIATIONS: f64 = 2.0;

/// Sums over loops: a place edge, and another way between its ends.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Drift {
    loops: u32,
    /// Squared turns between the two ways, each over the odometry of the loop, square radians per metre.
    turns: f64,
    /// The same of the shifts, square metres per metre.
    shifts: f64,
}

impl Drift {
    /// A place edge says otherwise than a way with so much odometry did.
    fn hear(&mut self, expected: &Se3, measured: &Se3, odometry_m: f64) {
        if odometry_m > 0.0 {
            let error = expected.inverse_mul(measured);
            self.loops += 1;
            self.turns += error.rotation.angle().powi(2) / odometry_m;
            self.shifts += error.translation.norm_squared() / odometry_m;
        }
    }

    /// By how much a point may be off that lies `lever_m` from where a way with so much odometry ends, metres; without
    /// bound while too few loops were closed.
    ///
    /// The variance of odometry grows with its length (\[ISRR19\] 6.1).
    pub fn reach_m(&self, odometry_m: f64, lever_m: f64) -> f64 {
        if self.loops < LEAST_LOOPS {
            return f64::INFINITY;
        }
        let per_m = (self.shifts + self.turns * lever_m * lever_m) / f64::from(self.loops);
        DEVIATIONS * (odometry_m * per_m).sqrt()
    }
}

impl RelativeMap {
    /// Edges come to the vertex `root`: the first place edge among them that closes a loop is held against the way that
    /// was known before, over an odometry edge among them where there is one. One for each vertex: the others share
    /// their odometry with it.
    pub(super) fn hear_of_drift(
        &mut self,
        graph: &PoseGraph<Se3>,
        root: VertexId,
        edges: &[EdgeId],
    ) {
        let is_place = |id: EdgeId| self.book.is_place(id);
        let mut places = edges.iter().copied().filter(|&id| is_place(id)).peekable();
        if places.peek().is_none() {
            return;
        }
        let step = edges.iter().copied().find(|&id| !is_place(id)).map(|id| graph.edge(id));
        // The odometry edge from the root, or nowhere.
        let (start, root_from_start, step_m) = match step {
            Some(step) => {
                let (start, root_from_start) = step.from_end(root);
                (start, root_from_start, step.length_m)
            }
            None => (root, Se3::identity(), 0.0),
        };
        let mut scope = Scope::default();
        let radius_m = self.params.consolidation_radius_m;
        self.scratch.place(&self.skeleton, start, radius_m, &mut scope);
        for id in places {
            let (known, root_from_known) = graph.edge(id).from_end(root);
            if let Some(row) = scope.placed().iter().find(|row| row.vertex == known) {
                let expected = root_from_start * row.root_from_vertex;
                self.drift.hear(&expected, &root_from_known, row.odometry_m + step_m);
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    #[test]
    fn loops_that_close_bound_what_may_be_off() {
        let turned = |angle_rad: f64, x: f64| {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad);
            Se3::new(Vector3::new(x, 0.0, 0.0), turn)
        };
        let (mut exact, mut rough) = (Drift::default(), Drift::default());
        for _ in 0..3 {
            assert_eq!(exact.reach_m(1.0, 1.0), f64::INFINITY);
            exact.hear(&turned(0.3, 2.0), &turned(0.3, 2.0), 4.0);
            rough.hear(&turned(0.3, 2.0), &turned(0.5, 2.0), 4.0);
        }
        exact.hear(&turned(0.0, 0.0), &turned(1.0, 1.0), 0.0);
        assert!(exact.reach_m(9.0, 8.0) < 1e-6);
        // 0.2 rad over 4 m are 0.1 rad over 1 m; over 9 m three times as much, twice that far off, at 8 m.
        assert!((rough.reach_m(9.0, 8.0) - 2.0 * 0.3 * 8.0).abs() < 1e-9);
    }
}
