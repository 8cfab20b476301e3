//! Coverage over distance, in few points.

use crate::flight::FlightRow;
use crate::run::StepRow;
use crate::table::Row;

/// Coverage is noted each time that it passes another such share.
const SHARES: f64 = 128.0;

/// What a curve needs of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passed {
    step: u64,
    distance_m: f64,
    coverage: f64,
}

impl From<&StepRow> for Passed {
    fn from(row: &StepRow) -> Self {
        Self { step: row.step, distance_m: row.distance_m, coverage: row.coverage }
    }
}

impl From<&FlightRow> for Passed {
    fn from(row: &FlightRow) -> Self {
        Self { step: row.step, distance_m: row.distance_m, coverage: row.coverage }
    }
}

/// The rows of a curve: where coverage passed another 128th, the first step and the last.
///
/// Between two points coverage rises by less than a 128th, then at once to the second.
pub(super) fn curve(map: &str, steps: &[Passed]) -> Vec<Row> {
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

    fn step(step: u64, coverage: f64) -> Passed {
        Passed { step, distance_m: step as f64, coverage }
    }

    #[test]
    fn a_long_run_has_few_points_and_keeps_its_ends() {
        let steps: Vec<Passed> =
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
