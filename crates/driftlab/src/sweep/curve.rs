//! Coverage over distance, in few points.

use crate::run::StepRow;
use crate::table::Row;

/// Coverage is noted each time that it passes another such share.
const SHARES: f64 = 128.0;

/// The rows of a curve: where coverage passed another 128th, the first step and the last.
///
/// Between two points coverage rises by less than a 128th, then at once to the second.
pub(super) fn curve(map: &str, steps: &[StepRow]) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut noted = f64::NEG_INFINITY;
    for (at, step) in steps.iter().enumerate() {
        let share = (step.coverage * SHARES).floor();
        if share > noted || at + 1 == steps.len() {
            noted = share;
            rows.push(vec![
                ("map".to_owned(), map.into()),
                ("step".to_owned(), step.step.into()),
                ("distance_m".to_owned(), step.distance_m.into()),
                ("coverage".to_owned(), step.coverage.into()),
            ]);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Cell;
    use pose::Se2;

    fn step(step: u64, coverage: f64) -> StepRow {
        StepRow {
            step,
            map: "grid".into(),
            distance_m: step as f64,
            sim_time_secs: step as f64,
            state: "reactive",
            world_from_body: Se2::identity(),
            odom_from_body: Se2::identity(),
            coverage,
            frontier_open_m: 0.0,
            frontier_ignored_m: 0.0,
            frontier_places: 0,
            vertices: 0,
            place_edges: 0,
            scans: 0,
            collisions: 0,
            bumps: 0,
        }
    }

    #[test]
    fn a_long_run_has_few_points_and_keeps_its_ends() {
        let steps: Vec<StepRow> =
            (0..=10_000).map(|at| step(at, (at as f64 / 8000.0).min(1.0))).collect();
        let rows = curve("grid", &steps);
        assert_eq!(rows.len(), 130);
        let distance = |row: &Row| row[2].1.number();
        assert_eq!(rows.first().and_then(distance), Some(0.0));
        assert_eq!(rows[128][3].1, Cell::Number(1.0));
        assert_eq!(distance(&rows[128]), Some(8000.0));
        assert_eq!(rows.last().and_then(distance), Some(10_000.0));
        assert_eq!(curve("grid", &[]), Vec::<Row>::new());
        assert_eq!(curve("grid", &steps[..1]).len(), 1);
    }
}
