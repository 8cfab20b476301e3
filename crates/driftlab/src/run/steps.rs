//! `steps.parquet`: one row per step and map, the same bytes for the same run.

use pose::Se2;

use crate::table::{Columns, TableError};

/// What is noted of one step of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct StepRow {
    /// Step of the loop, from 0.
    pub step: u64,
    /// The map that drives.
    pub map: String,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// Simulated time: the distance at 1 m/s, seconds.
    pub sim_time_secs: f64,
    /// What the loop was doing: `reactive`, `deliberate` or `done`.
    pub state: &'static str,
    /// The true pose.
    pub world_from_body: Se2,
    /// The pose as odometry alone has it, from the true start.
    pub odom_from_body: Se2,
    /// Share of the reachable free cells that were really seen.
    pub coverage: f64,
    /// Frontier that counts, metres.
    pub frontier_open_m: f64,
    /// Frontier that does not count, metres.
    pub frontier_ignored_m: f64,
    /// Volumes or cells with frontier that counts.
    pub frontier_places: u64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// Place edges in it.
    pub place_edges: u64,
    /// Scans taken.
    pub scans: u64,
    /// Commanded motions that would have touched an obstacle.
    pub collisions: u64,
    /// Motions whose noise pushed the robot into one.
    pub bumps: u64,
}

/// The bytes of `steps.parquet`.
///
/// # Errors
/// Only for more rows than memory holds.
pub fn to_parquet(rows: &[StepRow]) -> Result<Vec<u8>, TableError> {
    let mut table = Columns::default();
    table.all_counts("step", rows.iter().map(|row| row.step));
    table.all_texts("map", rows.iter().map(|row| row.map.as_str()));
    table.all_numbers("distance_m", rows.iter().map(|row| row.distance_m));
    table.all_numbers("sim_time", rows.iter().map(|row| row.sim_time_secs));
    table.all_texts("state", rows.iter().map(|row| row.state));
    table.all_numbers("true_x_m", rows.iter().map(|row| row.world_from_body.translation.x));
    table.all_numbers("true_y_m", rows.iter().map(|row| row.world_from_body.translation.y));
    table.all_numbers("true_theta_rad", rows.iter().map(|row| row.world_from_body.angle()));
    table.all_numbers("odom_x_m", rows.iter().map(|row| row.odom_from_body.translation.x));
    table.all_numbers("odom_y_m", rows.iter().map(|row| row.odom_from_body.translation.y));
    table.all_numbers("odom_theta_rad", rows.iter().map(|row| row.odom_from_body.angle()));
    table.all_numbers("coverage", rows.iter().map(|row| row.coverage));
    table.all_numbers("frontier_open_m", rows.iter().map(|row| row.frontier_open_m));
    table.all_numbers("frontier_ignored_m", rows.iter().map(|row| row.frontier_ignored_m));
    table.all_counts("frontier_places", rows.iter().map(|row| row.frontier_places));
    table.all_counts("vertices", rows.iter().map(|row| row.vertices));
    table.all_counts("place_edges", rows.iter().map(|row| row.place_edges));
    table.all_counts("scans", rows.iter().map(|row| row.scans));
    table.all_counts("collisions", rows.iter().map(|row| row.collisions));
    table.all_counts("bumps", rows.iter().map(|row| row.bumps));
    table.into_parquet()
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};

    fn rows(count: u64) -> Vec<StepRow> {
        let row = |step: u64| StepRow {
            step,
            map: if step.is_multiple_of(2) { "relative".into() } else { "grid".into() },
            distance_m: step as f64 * 0.5,
            sim_time_secs: step as f64 * 0.5,
            state: "reactive",
            world_from_body: Se2::new(1.0, 2.0, 0.5),
            odom_from_body: Se2::identity(),
            coverage: 0.25,
            frontier_open_m: 3.0,
            frontier_ignored_m: 0.0,
            frontier_places: 4,
            vertices: step,
            place_edges: 0,
            scans: step,
            collisions: 0,
            bumps: 0,
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn the_same_rows_give_the_same_bytes_that_read_back() {
        let bytes = to_parquet(&rows(3000)).unwrap();
        assert_eq!(bytes, to_parquet(&rows(3000)).unwrap());
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), &bytes).unwrap();
        let reader = SerializedFileReader::new(file.reopen().unwrap()).unwrap();
        assert_eq!(reader.metadata().file_metadata().num_rows(), 3000);
        let row = reader.get_row_iter(None).unwrap().nth(2).unwrap().unwrap();
        let columns: Vec<String> = row.get_column_iter().map(|(name, _)| name.clone()).collect();
        assert_eq!(columns[..3], ["step", "map", "distance_m"]);
        let value = row.get_column_iter().find(|(name, _)| *name == "true_theta_rad").unwrap();
        assert_eq!(value.1.to_string(), "0.5");
    }

    #[test]
    fn no_row_is_a_table_too() {
        assert!(to_parquet(&[]).unwrap().starts_with(b"PAR1"));
    }
}
